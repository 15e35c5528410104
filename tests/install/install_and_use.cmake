# usage: cmake -DBUILD_DIR=... -DWORK_DIR=... [-DSOURCE_DIR=...] -P install_and_use.cmake; see
# CMakeLists.txt. With SOURCE_DIR the bare detector is built in BUILD_DIR first.
set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${prefix} ${WORK_DIR}/base_alone ${WORK_DIR}/examples)

function(run_or_stop)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE output)
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(configure_and_build source build)
  set(flags "")
  if(SANITIZE)
    set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
  endif()
  run_or_stop(${CMAKE_COMMAND} -S ${source} -B ${build} -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${prefix} ${flags} ${ARGN})
  run_or_stop(${CMAKE_COMMAND} --build ${build})
endfunction()

# Of a shared library that is not where the loader looks, who links it must say the folder.
function(check_base_alone program)
  run_or_stop(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${library_folder} ${program})
  if(NOT output STREQUAL "${VERSION}: 1 edge\n")
    message(FATAL_ERROR "base_alone printed '${output}'")
  endif()
endfunction()

if(SOURCE_DIR)
  configure_and_build(${SOURCE_DIR} ${BUILD_DIR} -DCMAKE_BUILD_TYPE=Debug
    -DBUILD_SHARED_LIBS=ON -DTHERMEDGE_WITH_TBB=OFF
    -DTHERMEDGE_BUILD_IO=OFF -DTHERMEDGE_BUILD_SIM=OFF)
endif()
run_or_stop(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} --component base)
file(GLOB_RECURSE pc_file ${prefix}/thermedge.pc)
cmake_path(GET pc_file PARENT_PATH pc_folder)
cmake_path(GET pc_folder PARENT_PATH library_folder)
configure_and_build(${CMAKE_CURRENT_LIST_DIR}/base_alone ${WORK_DIR}/base_alone
  -DCMAKE_BUILD_TYPE=Release)
check_base_alone(${WORK_DIR}/base_alone/base_alone)

# The same program by pkg-config.
run_or_stop(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pc_folder}
  pkg-config --cflags --libs thermedge)
separate_arguments(flags UNIX_COMMAND "${output}")
if(SANITIZE)
  list(APPEND flags -fsanitize=${SANITIZE})
endif()
run_or_stop(${COMPILER} -std=c++20 ${CMAKE_CURRENT_LIST_DIR}/base_alone/main.cpp ${flags}
  -o ${WORK_DIR}/base_alone/by_pkg_config)
check_base_alone(${WORK_DIR}/base_alone/by_pkg_config)

if(SOURCE_DIR)
  return()
endif()
run_or_stop(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} --component io)
configure_and_build(${EXAMPLES} ${WORK_DIR}/examples -DCMAKE_BUILD_TYPE=Release)
string(REPEAT "1000 1000 1000 1000 1000 1000 1000 1000 " 4 dark)
string(REPEAT "3000 3000 3000 3000 3000 3000 3000 3000 " 4 bright)
string(REPEAT "${dark}${bright}\n" 64 rows)
file(WRITE ${WORK_DIR}/frame.pgm "P2\n64 64\n65535\n${rows}")
run_or_stop(${WORK_DIR}/examples/detect ${WORK_DIR}/frame.pgm)
if(NOT output MATCHES "^edge 0: [0-9]+ px, [0-9]+ counts of contrast, open\n$")
  message(FATAL_ERROR "the example printed '${output}'")
endif()

# The program with its pages and completions.
if(PROGRAM)
  run_or_stop(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} --component program)
  run_or_stop(${prefix}/bin/thermedge --version)
  foreach(page man/man1/thermedge.1 man/man1/thermedge-detect.1
      bash-completion/completions/thermedge zsh/site-functions/_thermedge
      fish/vendor_completions.d/thermedge.fish)
    if(NOT EXISTS ${prefix}/share/${page})
      message(FATAL_ERROR "share/${page} was not installed")
    endif()
  endforeach()
endif()
