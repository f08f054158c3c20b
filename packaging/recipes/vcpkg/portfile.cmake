set(VCPKG_POLICY_DLLS_IN_STATIC_LIBRARY enabled)  # libunsnarl_c, the library for C, is always shared

vcpkg_download_distfile(archive
  URLS "@HOMEPAGE@/releases/download/v@VERSION@/unsnarl-@VERSION@.tar.gz"
  FILENAME "unsnarl-@VERSION@.tar.gz"
  SHA512 @SHA512@)
vcpkg_extract_source_archive(source ARCHIVE "${archive}")
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES tools UNSNARL_BUILD_APPS)
vcpkg_cmake_configure(SOURCE_PATH "${source}" OPTIONS ${features} -DUNSNARL_BUILD_TESTS=OFF)
vcpkg_cmake_install()
if("tools" IN_LIST FEATURES)
  vcpkg_copy_tools(TOOL_NAMES unsnarl AUTO_CLEAN)
endif()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/unsnarl)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${source}/LICENSE" "${source}/NOTICE")
