# install and find_package(penumbra): the libraries, their headers and a package configuration.
include(CMakePackageConfigHelpers)
get_property(libraries GLOBAL PROPERTY PENUMBRA_LIBRARIES)
install(TARGETS penumbra_options ${libraries} EXPORT penumbra_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT penumbra_targets NAMESPACE penumbra::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/penumbra)
configure_package_config_file(cmake/penumbraConfig.cmake.in
    ${PROJECT_BINARY_DIR}/penumbraConfig.cmake
    INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/penumbra)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/penumbraConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/penumbraConfig.cmake ${PROJECT_BINARY_DIR}/penumbraConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/penumbra)
