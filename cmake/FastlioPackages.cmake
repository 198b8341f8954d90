# mrpt_fastlio: Debian packages by CPack (`make packages`): runtime, dev, plugin.
# SPDX-License-Identifier: BSD-3-Clause
set(FASTLIO_DEB_runtime mrpt-fastlio)
set(FASTLIO_DEB_dev libmrpt-fastlio-dev)
set(FASTLIO_DEB_plugin mrpt-fastlio-plugin)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME mrpt-fastlio)
set(CPACK_PACKAGE_CONTACT "mrpt_fastlio developers <mrpt_fastlio@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime dev plugin)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
# Where the plugin's dependencies on the runtime package's libraries are looked up.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${FASTLIO_LIBRARY_DIR})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${FASTLIO_DEB_runtime})
set(CPACK_DEBIAN_DEV_PACKAGE_NAME ${FASTLIO_DEB_dev})
set(CPACK_DEBIAN_PLUGIN_PACKAGE_NAME ${FASTLIO_DEB_plugin})
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "${FASTLIO_DEB_runtime} (= ${PROJECT_VERSION}), libmrpt-maps-dev, libmrpt-slam-dev, libeigen3-dev, nlohmann-json3-dev")
# PNGs of fastlio-eval.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "librsvg2-bin")
set(CPACK_DEBIAN_PLUGIN_PACKAGE_DEPENDS "${FASTLIO_DEB_runtime} (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
  "Programs (fastlio-replay, fastlio-sim, fastlio-eval, fastlio-info, fastlio-calibrate, fastlio-import, fastlio-tune, fastlio-map), shared libraries and parameter files.")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Headers and CMake files to link the modules.")
set(CPACK_COMPONENT_PLUGIN_DESCRIPTION "Module that MRPT programs load: map and odometry classes.")
include(CPack)
