# `cmake --install` and find_package(thermedge): targets thermedge::thermedge (the detector),
# thermedge::thermedge_io (files) and thermedge::thermedge_sim (scenes).
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/thermedge)
install(TARGETS thermedge thermedge_io thermedge_sim
  EXPORT thermedgeTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/thermedge sim/include/thermedge DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT thermedgeTargets NAMESPACE thermedge:: DESTINATION ${package_dir})
configure_package_config_file(cmake/thermedgeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/thermedgeConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/thermedgeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/thermedgeConfig.cmake
  ${PROJECT_BINARY_DIR}/thermedgeConfigVersion.cmake DESTINATION ${package_dir})
