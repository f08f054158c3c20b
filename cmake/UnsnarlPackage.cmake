# `cpack` in a build: one Debian package of all that is installed (program, libraries, headers, man page, completions).
set(CPACK_PACKAGE_VENDOR "the unsnarl authors")
set(CPACK_PACKAGE_CONTACT "the unsnarl authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "removes self-intersections from surface meshes")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Takes a surface mesh that runs through itself and gives back the same mesh,
moved as little as possible, with no self-intersection left: same vertices,
faces and attributes, certified by exact arithmetic on the file that was
written. Holds the program and the libraries for C and C++.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};unsnarl;unsnarl;/")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/finish_debian_package.cmake)
# What find_package(unsnarl) asks for; the program and the C interface do without.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "libtbb-dev, libfmt-dev, libpng-dev, libgif-dev, zlib1g-dev, libpugixml-dev, libzip-dev, libmpfr-dev, libgmp-dev")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
include(CPack)
