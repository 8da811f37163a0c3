# `cmake --install` installs the program, the library for find_package(pahrender) and the schema of
# the scene language.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set_target_properties(pah_io PROPERTIES EXPORT_NAME io)
install(TARGETS pahrender)
install(TARGETS pahrender_pictures DESTINATION ${CMAKE_INSTALL_LIBDIR}/pahrender)
file(RELATIVE_PATH from_program ${CMAKE_INSTALL_FULL_BINDIR}
  ${CMAKE_INSTALL_FULL_LIBDIR}/pahrender)
set_target_properties(pahrender PROPERTIES
  BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN;$ORIGIN/${from_program}")
install(TARGETS pah pah_io EXPORT pahrenderTargets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/pah DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/scenes/pahrender.schema.json
        DESTINATION ${CMAKE_INSTALL_DATADIR}/pahrender)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/pahrender)
install(EXPORT pahrenderTargets NAMESPACE pah:: DESTINATION ${package_folder})
configure_package_config_file(pahrenderConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/pahrenderConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/pahrenderConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pahrenderConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/pahrenderConfigVersion.cmake
        DESTINATION ${package_folder})
