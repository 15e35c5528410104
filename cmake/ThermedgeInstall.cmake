# `cmake --install` and find_package(thermedge COMPONENTS ...). A component is one library with its
# headers: base (thermedge::thermedge, the detector), io, sim and eval (thermedge::thermedge_io and
# so on). `cmake --install DIR --component base` installs one alone.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/thermedge)

function(thermedge_install_component component target)
  install(TARGETS ${target} EXPORT thermedge_${component}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
      NAMELINK_COMPONENT ${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component})
  install(EXPORT thermedge_${component} NAMESPACE thermedge:: DESTINATION ${package_dir}
    FILE thermedge_${component}.cmake COMPONENT ${component})
endfunction()

thermedge_install_component(base thermedge)
install(DIRECTORY include/thermedge DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT base
  PATTERN io EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/include/thermedge/version.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/thermedge COMPONENT base)
if(TARGET thermedge_io)
  thermedge_install_component(io thermedge_io)
  install(DIRECTORY include/thermedge/io DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/thermedge
    COMPONENT io)
endif()
foreach(component sim eval)
  if(TARGET thermedge_${component})
    thermedge_install_component(${component} thermedge_${component})
    install(DIRECTORY ${component}/include/thermedge DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
      COMPONENT ${component})
  endif()
endforeach()

configure_package_config_file(cmake/thermedgeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/thermedgeConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/thermedgeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/thermedgeConfig.cmake
  ${PROJECT_BINARY_DIR}/thermedgeConfigVersion.cmake DESTINATION ${package_dir} COMPONENT base)

# Who links the static library links what it needs, too.
set(pc_requires libhwy)
if(THERMEDGE_WITH_TBB)
  string(APPEND pc_requires " tbb")
endif()
set(requires_key Requires)
if(BUILD_SHARED_LIBS)
  set(requires_key Requires.private)
endif()
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/thermedge.pc.in ${PROJECT_BINARY_DIR}/thermedge.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/thermedge.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT base)
