# mrpt_fastlio: what `cmake --install` puts where, find_package() and packages.
# SPDX-License-Identifier: BSD-3-Clause
#
# Components: runtime (programs, shared libraries, parameters), dev (headers, CMake files), plugin.
include(CMakePackageConfigHelpers)

set(FASTLIO_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/mrpt_fastlio)

# Found relative to the program or library itself, so that an installed tree may be moved.
if(NOT CMAKE_INSTALL_RPATH)
  file(RELATIVE_PATH bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set(CMAKE_INSTALL_RPATH "$ORIGIN" "$ORIGIN/${bin_to_lib}")
endif()

# fastlio_install_module(TARGET): library, headers under include/ and the export.
function(fastlio_install_module TARGET)
  install(TARGETS ${TARGET} EXPORT mrpt_fastlioTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT dev)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
endfunction()

# fastlio_install_program(TARGET): program and, where help2man is, its manual page.
function(fastlio_install_program TARGET)
  install(TARGETS ${TARGET} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
  find_program(HELP2MAN_PROGRAM help2man)
  if(NOT HELP2MAN_PROGRAM)
    return()
  endif()
  set(page ${CMAKE_CURRENT_BINARY_DIR}/${TARGET}.1)
  add_custom_command(OUTPUT ${page}
    COMMAND ${HELP2MAN_PROGRAM} --no-info --section=1 --source="${PROJECT_NAME} ${PROJECT_VERSION}"
      --version-string=${PROJECT_VERSION} --output=${page} $<TARGET_FILE:${TARGET}>
    DEPENDS ${TARGET} VERBATIM)
  add_custom_target(${TARGET}-man ALL DEPENDS ${page})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime)
endfunction()

# fastlio_install_package(): once, after all modules.
function(fastlio_install_package)
  install(EXPORT mrpt_fastlioTargets NAMESPACE mrpt_fastlio:: DESTINATION ${FASTLIO_CMAKE_DIR}
    COMPONENT dev)
  configure_package_config_file(cmake/mrpt_fastlioConfig.cmake.in
    ${PROJECT_BINARY_DIR}/mrpt_fastlioConfig.cmake INSTALL_DESTINATION ${FASTLIO_CMAKE_DIR})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/mrpt_fastlioConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/mrpt_fastlioConfig.cmake
      ${PROJECT_BINARY_DIR}/mrpt_fastlioConfigVersion.cmake
    DESTINATION ${FASTLIO_CMAKE_DIR} COMPONENT dev)
  install(DIRECTORY params DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME} COMPONENT runtime)
  install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME} COMPONENT runtime)
  install(FILES cmake/bash_completion RENAME fastlio-replay COMPONENT runtime
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  foreach(program fastlio-sim fastlio-eval fastlio-info)
    install(FILES cmake/bash_completion RENAME ${program} COMPONENT runtime
      DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  endforeach()
  foreach(component runtime dev plugin)
    install(FILES LICENSE RENAME copyright COMPONENT ${component}
      DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${FASTLIO_DEB_${component}})
  endforeach()
endfunction()
