# An overlay port: it builds the checkout of isostep that it stands in. vcpkg install isostep --overlay-ports=DIRECTORY of
# this port's folder.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS
  FEATURES
    c ISOSTEP_C
    threads ISOSTEP_THREADS
    transport ISOSTEP_TRANSPORT)
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    ${FEATURE_OPTIONS}
    -DISOSTEP_TOOL=OFF
    -DISOSTEP_PROVER=OFF
    -DISOSTEP_TESTS=OFF
    -DISOSTEP_EXAMPLES=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME isostep CONFIG_PATH lib/cmake/isostep)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
