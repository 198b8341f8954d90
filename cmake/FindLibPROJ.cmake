# mrpt_fastlio: finds PROJ, whose CMake package has other names in other versions: LibPROJ::proj.
# SPDX-License-Identifier: BSD-3-Clause
find_path(LIBPROJ_INCLUDE_DIR proj.h)
find_library(LIBPROJ_LIBRARY proj)
mark_as_advanced(LIBPROJ_INCLUDE_DIR LIBPROJ_LIBRARY)
if(LIBPROJ_INCLUDE_DIR)
  foreach(part MAJOR MINOR PATCH)
    file(STRINGS ${LIBPROJ_INCLUDE_DIR}/proj.h line REGEX "^#define PROJ_VERSION_${part} ")
    string(REGEX REPLACE "[^0-9]" "" LIBPROJ_${part} "${line}")
  endforeach()
  set(LibPROJ_VERSION ${LIBPROJ_MAJOR}.${LIBPROJ_MINOR}.${LIBPROJ_PATCH})
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LibPROJ
  REQUIRED_VARS LIBPROJ_LIBRARY LIBPROJ_INCLUDE_DIR VERSION_VAR LibPROJ_VERSION)
if(LibPROJ_FOUND AND NOT TARGET LibPROJ::proj)
  add_library(LibPROJ::proj UNKNOWN IMPORTED)
  set_target_properties(LibPROJ::proj PROPERTIES
    IMPORTED_LOCATION "${LIBPROJ_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${LIBPROJ_INCLUDE_DIR}")
endif()
