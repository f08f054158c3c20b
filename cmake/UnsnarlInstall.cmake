# `cmake --install` gives a relocatable package. Component unsnarl: what is used; unsnarl_dev: what programs are built with,
# by find_package(unsnarl) or pkg-config.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/unsnarl)
set(doc_dir ${CMAKE_INSTALL_DATADIR}/doc/unsnarl)
set(exports core)
install(TARGETS unsnarl_core EXPORT core_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT unsnarl_dev)
if(UNSNARL_BUILD_IO)
  list(APPEND exports unsnarl unsnarl_c)
  install(TARGETS unsnarl EXPORT unsnarl_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT unsnarl_dev)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/unsnarl ${UNSNARL_GENERATED_INCLUDE_DIR}/unsnarl
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT unsnarl_dev FILES_MATCHING PATTERN "*.h")

# An export each: a program in C needs none of what the static libraries are linked with, nor the core what the rest is.
foreach(export IN LISTS exports)
  install(EXPORT ${export}_targets NAMESPACE unsnarl:: FILE ${export}-targets.cmake DESTINATION ${package_dir}
          COMPONENT unsnarl_dev)
endforeach()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/unsnarl-config.cmake.in
  ${PROJECT_BINARY_DIR}/unsnarl-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/unsnarl-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/unsnarl-config.cmake ${PROJECT_BINARY_DIR}/unsnarl-config-version.cmake
        DESTINATION ${package_dir} COMPONENT unsnarl_dev)

list(TRANSFORM UNSNARL_LINKED_LIBRARIES PREPEND -l OUTPUT_VARIABLE linked)
list(JOIN linked " " UNSNARL_LINK_FLAGS)
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH UNSNARL_PREFIX_FROM_PC /${pkgconfig_dir} /)
set(UNSNARL_ARCHIVES "-lunsnarl_core")
set(pc_files unsnarl.pc)
if(UNSNARL_BUILD_IO)
  set(UNSNARL_ARCHIVES "-lunsnarl -lunsnarl_core")
  list(APPEND pc_files unsnarl_c.pc)
endif()
foreach(file IN LISTS pc_files)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${file}.in ${PROJECT_BINARY_DIR}/${file} @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${file} DESTINATION ${pkgconfig_dir} COMPONENT unsnarl_dev)
endforeach()

# Laid out as in the source tree, so that the pages' links hold.
install(FILES LICENSE NOTICE README.md CHANGELOG.md CITATION.cff SECURITY.md DESTINATION ${doc_dir} COMPONENT unsnarl OPTIONAL)
install(DIRECTORY docs DESTINATION ${doc_dir} COMPONENT unsnarl OPTIONAL PATTERN images EXCLUDE)
install(DIRECTORY examples DESTINATION ${doc_dir} COMPONENT unsnarl_dev OPTIONAL PATTERN __pycache__ EXCLUDE)
