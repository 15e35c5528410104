# What every target of this project is compiled with.
include(GNUInstallDirs)

add_library(thermedge_settings INTERFACE)
target_compile_features(thermedge_settings INTERFACE cxx_std_20)
# -ffp-contract=off: a fused multiply-add rounds once where two operations round twice, so results
# would differ between CPUs.
target_compile_options(thermedge_settings INTERFACE
  -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # GCC 12 sees overlaps in std::string that are none (its bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${THERMEDGE_WERROR}>:-Werror>)
if(THERMEDGE_SANITIZE)
  target_compile_options(thermedge_settings INTERFACE
    -fsanitize=${THERMEDGE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(thermedge_settings INTERFACE -fsanitize=${THERMEDGE_SANITIZE})
endif()

# thermedge_library(NAME SOURCES ... [PUBLIC libs ...] [PRIVATE libs ...])
# One layer of the library. What it may use is what it links: lower layers only.
function(thermedge_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:thermedge_settings> ${ARG_PRIVATE})
  add_library(thermedge::${name} ALIAS ${name})
endfunction()
