# `cpack` in a build: one Debian package of all that is installed (program, libraries, headers, man page, completions).
set(CPACK_PACKAGE_VENDOR "the unsnarl authors")
set(CPACK_PACKAGE_CONTACT "the unsnarl authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};unsnarl;unsnarl;/")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What find_package(unsnarl) asks for; the program and the C interface do without.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "libtbb-dev, libfmt-dev, libpng-dev, libgif-dev, zlib1g-dev, libpugixml-dev, libzip-dev, libmpfr-dev, libgmp-dev")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
include(CPack)
