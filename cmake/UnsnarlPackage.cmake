# `cpack` in a build: two Debian packages. unsnarl is what is used: program, C library, man page, completions, pages of
# docs/. libunsnarl-dev is what programs are built with, and depends on what they are linked with.
set(CPACK_PACKAGE_VERSION ${UNSNARL_VERSION})
string(REPLACE ".dev" "~dev" CPACK_DEBIAN_PACKAGE_VERSION ${UNSNARL_VERSION})  # older than the release, for dpkg
set(CPACK_PACKAGE_VENDOR "the unsnarl authors")
set(CPACK_PACKAGE_CONTACT "the unsnarl authors")
set(CPACK_PACKAGE_HOMEPAGE_URL "${PROJECT_HOMEPAGE_URL}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "removes self-intersections from surface meshes")
set(CPACK_DEBIAN_UNSNARL_DESCRIPTION
"Moves the vertices of a surface mesh as little as possible until it has no
self-intersections. Faces and attributes stay the same. The written file is
read back and checked with exact arithmetic. Contains the program and the
library for C.")
set(CPACK_DEBIAN_UNSNARL_DEV_DESCRIPTION
"The libraries of unsnarl for programs in C++ (static) and C (shared):
headers, examples, and files for find_package of CMake and for pkg-config.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};unsnarl;ALL;/")
set(CPACK_COMPONENTS_ALL unsnarl unsnarl_dev)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_UNSNARL_PACKAGE_NAME unsnarl)
set(CPACK_DEBIAN_UNSNARL_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_UNSNARL_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_UNSNARL_DEV_PACKAGE_NAME libunsnarl-dev)
set(CPACK_DEBIAN_UNSNARL_DEV_PACKAGE_SECTION libdevel)
list(JOIN UNSNARL_LINKED_DEBIAN ", " linked)
set(CPACK_DEBIAN_UNSNARL_DEV_PACKAGE_DEPENDS "unsnarl (= ${CPACK_DEBIAN_PACKAGE_VERSION}), ${linked}")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/finish_debian_package.cmake)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
include(CPack)
