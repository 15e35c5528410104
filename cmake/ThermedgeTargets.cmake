# What every target of this project is compiled with, and how rooms and libraries are made.
include(GNUInstallDirs)

add_library(thermedge_settings INTERFACE)
target_compile_features(thermedge_settings INTERFACE cxx_std_20)
# -ffp-contract=off: a fused multiply-add rounds once where two operations round twice, so results
# would differ between CPUs.
target_compile_options(thermedge_settings INTERFACE
  -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # GCC 12 reports overlaps in std::string that are none (its bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # In place of clang-tidy's bugprone-reserved-identifier, which costs a tenth of its time.
  $<$<CXX_COMPILER_ID:Clang>:-Wreserved-identifier -Wreserved-macro-identifier>
  $<$<BOOL:${THERMEDGE_WERROR}>:-Werror>)
if(THERMEDGE_SANITIZE)
  target_compile_options(thermedge_settings INTERFACE
    -fsanitize=${THERMEDGE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(thermedge_settings INTERFACE -fsanitize=${THERMEDGE_SANITIZE})
endif()

# thermedge_part(NAME KIND room|library|program|tests FOLDER folder [INCLUDE folder]
#                [PRIVATE folder] [SOURCES files...] [HEADERS files...] [ROOMS parts...]
#                [LIBRARIES libs...])
# Notes what tests/rooms checks the sources against, lowest part first. HEADERS are the part's
# public headers, below INCLUDE/thermedge; PRIVATE is the folder that its private headers are named
# from, by default FOLDER; ROOMS are the parts whose private headers it may include; LIBRARIES are
# the libraries of this project whose public headers it may include.
function(thermedge_part name)
  cmake_parse_arguments(ARG "" "KIND;FOLDER;INCLUDE;PRIVATE"
    "SOURCES;HEADERS;ROOMS;LIBRARIES" ${ARGN})
  if(NOT ARG_PRIVATE)
    set(ARG_PRIVATE ${ARG_FOLDER})
  endif()
  set_property(GLOBAL APPEND PROPERTY THERMEDGE_PARTS ${name})
  foreach(key KIND FOLDER INCLUDE PRIVATE SOURCES HEADERS ROOMS LIBRARIES)
    set_property(GLOBAL PROPERTY THERMEDGE_PART_${name}_${key} "${ARG_${key}}")
  endforeach()
endfunction()

# Writes the parts noted so far as JSON; folders are relative to the repository, sources to their
# part's folder.
function(thermedge_write_parts file)
  get_property(parts GLOBAL PROPERTY THERMEDGE_PARTS)
  set(entries "")
  foreach(part IN LISTS parts)
    set(fields "\"name\": \"${part}\"")
    foreach(key KIND FOLDER INCLUDE PRIVATE SOURCES HEADERS ROOMS LIBRARIES)
      get_property(values GLOBAL PROPERTY THERMEDGE_PART_${part}_${key})
      string(TOLOWER ${key} field)
      if(NOT key MATCHES "^(KIND|FOLDER|INCLUDE|PRIVATE)$")
        list(TRANSFORM values REPLACE "^(.+)$" "\"\\1\"")
        list(JOIN values ", " values)
        string(APPEND fields ",\n  \"${field}\": [${values}]")
      else()
        string(APPEND fields ",\n  \"${field}\": \"${values}\"")
      endif()
    endforeach()
    list(APPEND entries "{${fields}}")
  endforeach()
  list(JOIN entries ",\n" entries)
  file(WRITE ${file} "[${entries}]\n")
endfunction()

# thermedge_room(NAME SOURCES files... HEADERS files... [ROOMS rooms...] [LIBRARIES libs...])
# A room is a folder of src/ with one object library. Its include path is the public headers, its
# own folder, and the folders of the rooms that it names; these name theirs for themselves. HEADERS
# are the public headers that the room owns, below include/thermedge/. The list of rooms is what
# tests/rooms checks the sources against.
function(thermedge_room room)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;ROOMS;LIBRARIES" ${ARGN})
  set(target thermedge_room_${room})
  add_library(${target} OBJECT ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC
    ${PROJECT_SOURCE_DIR}/include ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${target} PUBLIC tl::expected
    PRIVATE thermedge_settings ${ARG_LIBRARIES})
  list(TRANSFORM ARG_ROOMS PREPEND thermedge_room_ OUTPUT_VARIABLE rooms)
  target_link_libraries(${target} PRIVATE ${rooms})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  set_property(GLOBAL APPEND PROPERTY THERMEDGE_ROOMS ${room})
  thermedge_part(${room} KIND room FOLDER src/${room} INCLUDE include
    SOURCES ${ARG_SOURCES} HEADERS ${ARG_HEADERS} ROOMS ${ARG_ROOMS})
endfunction()

# thermedge_library(NAME SOURCES files... [HEADERS files...] [ROOMS rooms...] [PUBLIC libs...]
#                   [PRIVATE libs...] [INCLUDE folder] [STATIC])
# A library that is shared or static as BUILD_SHARED_LIBS says, or always static. ROOMS are those
# whose private headers it may include; INCLUDE holds its public headers where they are not in
# include/.
function(thermedge_library name)
  cmake_parse_arguments(ARG "STATIC" "INCLUDE" "SOURCES;HEADERS;ROOMS;PUBLIC;PRIVATE" ${ARGN})
  set(kind "")
  if(ARG_STATIC)
    set(kind STATIC)
  endif()
  add_library(${name} ${kind} ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  if(ARG_INCLUDE)
    target_include_directories(${name} PUBLIC
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/${ARG_INCLUDE}>)
  endif()
  foreach(room IN LISTS ARG_ROOMS)
    target_include_directories(${name} PRIVATE
      $<TARGET_PROPERTY:thermedge_room_${room},INTERFACE_INCLUDE_DIRECTORIES>)
  endforeach()
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES
    POSITION_INDEPENDENT_CODE ON
    INSTALL_RPATH $ORIGIN
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:thermedge_settings> ${ARG_PRIVATE})
  add_library(thermedge::${name} ALIAS ${name})
  if(name MATCHES "^thermedge_(.*)$")
    set(part ${CMAKE_MATCH_1})
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    set(include include)
    set(private ${folder})
    if(ARG_INCLUDE)
      set(include ${folder}/${ARG_INCLUDE})
      set(private ${folder}/src)
    endif()
    thermedge_part(${part} KIND library FOLDER ${folder} INCLUDE ${include} PRIVATE ${private}
      SOURCES ${ARG_SOURCES} HEADERS ${ARG_HEADERS} ROOMS ${ARG_ROOMS}
      LIBRARIES ${ARG_PUBLIC} ${ARG_PRIVATE})
  endif()
endfunction()
