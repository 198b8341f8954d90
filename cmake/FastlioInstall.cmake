# mrpt_fastlio: what `cmake --install` puts where, find_package() and packages.
# SPDX-License-Identifier: BSD-3-Clause
#
# Components: runtime (programs, shared libraries, parameters), dev (headers, CMake files), plugin.
include(CMakePackageConfigHelpers)

set(FASTLIO_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/mrpt_fastlio)

# Found relative to the program or library itself, so that an installed tree may be moved. The build tree is laid out
# alike and what is installed has the same RUNPATH there: one that CMake changes when it installs would end in an empty
# element in the build tree, which stands for the current directory, whose libraries would be loaded.
file(RELATIVE_PATH bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set(FASTLIO_PROGRAM_DIR ${PROJECT_BINARY_DIR}/bin)
get_filename_component(FASTLIO_LIBRARY_DIR ${FASTLIO_PROGRAM_DIR}/${bin_to_lib} ABSOLUTE)
set(FASTLIO_OWN_RPATH OFF)
if(MRPT_FASTLIO_INSTALL AND NOT CMAKE_INSTALL_RPATH)
  set(FASTLIO_OWN_RPATH ON)
  set(CMAKE_INSTALL_RPATH "$ORIGIN" "$ORIGIN/${bin_to_lib}")
  set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
endif()

# fastlio_lay_out(TARGET): puts TARGET where the installed tree has it.
function(fastlio_lay_out TARGET)
  if(FASTLIO_OWN_RPATH)
    set_target_properties(${TARGET} PROPERTIES BUILD_WITH_INSTALL_RPATH ON
      LIBRARY_OUTPUT_DIRECTORY ${FASTLIO_LIBRARY_DIR} RUNTIME_OUTPUT_DIRECTORY ${FASTLIO_PROGRAM_DIR})
  endif()
endfunction()

# fastlio_install_module(TARGET): library, headers under include/ and the export.
function(fastlio_install_module TARGET)
  if(NOT MRPT_FASTLIO_INSTALL)
    return()
  endif()
  fastlio_lay_out(${TARGET})
  install(TARGETS ${TARGET} EXPORT mrpt_fastlioTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT dev)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
endfunction()

# fastlio_install_program(TARGET): program and, where help2man is, its manual page. The build tree has a link to it in
# its own folder.
function(fastlio_install_program TARGET)
  if(NOT MRPT_FASTLIO_INSTALL)
    return()
  endif()
  fastlio_lay_out(${TARGET})
  if(FASTLIO_OWN_RPATH)
    add_custom_command(TARGET ${TARGET} POST_BUILD
      COMMAND ${CMAKE_COMMAND} -E create_symlink $<TARGET_FILE:${TARGET}> ${CMAKE_CURRENT_BINARY_DIR}/${TARGET}
      VERBATIM)
  endif()
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
  foreach(program fastlio-sim fastlio-eval fastlio-info fastlio-calibrate fastlio-import fastlio-tune fastlio-map)
    install(FILES cmake/bash_completion RENAME ${program} COMPONENT runtime
      DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  endforeach()
  foreach(component runtime dev plugin)
    install(FILES LICENSE RENAME copyright COMPONENT ${component}
      DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${FASTLIO_DEB_${component}})
  endforeach()
endfunction()
