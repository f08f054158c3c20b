# `cmake --install` gives a relocatable package: find_package(unsnarl) brings the target unsnarl::unsnarl.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/unsnarl)
install(TARGETS unsnarl EXPORT unsnarl_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT unsnarl)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/unsnarl ${UNSNARL_GENERATED_INCLUDE_DIR}/unsnarl
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT unsnarl FILES_MATCHING PATTERN "*.h")
install(EXPORT unsnarl_targets NAMESPACE unsnarl:: FILE unsnarl-targets.cmake DESTINATION ${package_dir} COMPONENT unsnarl)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/unsnarl-config.cmake.in
  ${PROJECT_BINARY_DIR}/unsnarl-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/unsnarl-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/unsnarl-config.cmake ${PROJECT_BINARY_DIR}/unsnarl-config-version.cmake
        DESTINATION ${package_dir} COMPONENT unsnarl)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/unsnarl COMPONENT unsnarl)
