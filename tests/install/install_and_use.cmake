# usage: cmake -DBUILD_DIR=... -DWORK_DIR=... -P install_and_use.cmake; see CMakeLists.txt.
set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})

function(run_or_stop)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE output)
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(configure_and_build source name)
  set(flags "")
  if(SANITIZE)
    set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
  endif()
  run_or_stop(${CMAKE_COMMAND} -S ${source} -B ${WORK_DIR}/${name} -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Release
    ${flags} ${ARGN})
  run_or_stop(${CMAKE_COMMAND} --build ${WORK_DIR}/${name})
endfunction()

run_or_stop(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} --component base)
configure_and_build(${CMAKE_CURRENT_LIST_DIR}/base_alone base_alone)
run_or_stop(${WORK_DIR}/base_alone/base_alone)
if(NOT output STREQUAL "${VERSION}: 1 edge\n")
  message(FATAL_ERROR "base_alone printed '${output}'")
endif()

run_or_stop(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} --component io)
configure_and_build(${EXAMPLES} examples)
string(REPEAT "1000 1000 1000 1000 1000 1000 1000 1000 " 4 dark)
string(REPEAT "3000 3000 3000 3000 3000 3000 3000 3000 " 4 bright)
string(REPEAT "${dark}${bright}\n" 64 rows)
file(WRITE ${WORK_DIR}/frame.pgm "P2\n64 64\n65535\n${rows}")
run_or_stop(${WORK_DIR}/examples/detect ${WORK_DIR}/frame.pgm)
if(NOT output MATCHES "^edge 0: [0-9]+ px, [0-9]+ counts of contrast, open\n$")
  message(FATAL_ERROR "the example printed '${output}'")
endif()
