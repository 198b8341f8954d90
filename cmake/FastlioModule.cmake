# mrpt_fastlio: functions that add modules and tests.
# SPDX-License-Identifier: BSD-3-Clause

# What is tested is optimised as ever; the tests themselves had better be built soon.
set(FASTLIO_TEST_OPTIONS $<$<NOT:$<CONFIG:Debug>>:-O1>)
if(MRPT_FASTLIO_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Files of a unit are included; that their fixtures are in anonymous namespaces is no fault.
  list(APPEND FASTLIO_TEST_OPTIONS -Wno-subobject-linkage)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # With -O1 GCC 14 does not see that the value of an empty std::optional is not moved. The sanitizers watch the tests.
  list(APPEND FASTLIO_TEST_OPTIONS -Wno-maybe-uninitialized)
endif()

# The headers that most units read, precompiled once for libraries and once for tests, whose flags differ.
if(MRPT_FASTLIO_PRECOMPILE)
  find_package(Eigen3 REQUIRED NO_MODULE)
  file(WRITE ${PROJECT_BINARY_DIR}/precompiled.cpp "int main() { return 0; }\n")
  add_library(fastlio_precompiled_library OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
  add_executable(fastlio_precompiled_test ${PROJECT_BINARY_DIR}/precompiled.cpp)
  target_compile_options(fastlio_precompiled_test PRIVATE ${FASTLIO_TEST_OPTIONS})
  foreach(target fastlio_precompiled_library fastlio_precompiled_test)
    target_link_libraries(${target} PRIVATE fastlio_compiler_options Eigen3::Eigen)
    target_precompile_headers(${target} PRIVATE <Eigen/Cholesky> <Eigen/Core> <Eigen/Eigenvalues>
      <Eigen/Geometry> <Eigen/LU> <algorithm> <array> <cmath> <filesystem> <fstream> <functional>
      <map> <memory> <optional> <sstream> <string> <vector>)
  endforeach()
  if(BUILD_TESTING)
    find_package(GTest REQUIRED)
    target_link_libraries(fastlio_precompiled_test PRIVATE GTest::gtest)
    target_precompile_headers(fastlio_precompiled_test PRIVATE <gtest/gtest.h>)
  endif()
endif()

# fastlio_precompile(TARGET KIND): TARGET reads the headers of KIND (library, test) precompiled.
function(fastlio_precompile TARGET KIND)
  if(MRPT_FASTLIO_PRECOMPILE)
    target_precompile_headers(${TARGET} REUSE_FROM fastlio_precompiled_${KIND})
  endif()
endfunction()

# fastlio_unity(TARGET SIZE): the sources of TARGET are compiled as few units of SIZE files, which read each header once.
function(fastlio_unity TARGET SIZE)
  set_target_properties(${TARGET} PROPERTIES
    UNITY_BUILD ${MRPT_FASTLIO_UNITY} UNITY_BUILD_BATCH_SIZE ${SIZE})
endfunction()

# fastlio_add_module(NAME [PUBLIC ...] [PRIVATE ...] [TEST_LINK ...] [ALLOCATION_TESTS ...])
# A shared library mrpt_fastlio::NAME (file libmrpt_fastlio_NAME.so) of all sources in src/ and, when tests
# are built, one GoogleTest program test_NAME of all sources in tests/ but those named by ALLOCATION_TESTS. These
# replace the global operator new, and are a program of their own, test_NAME_allocations.
function(fastlio_add_module NAME)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE;TEST_LINK;ALLOCATION_TESTS" ${ARGN})
  set(target mrpt_fastlio_${NAME})
  file(GLOB sources CONFIGURE_DEPENDS src/*.cpp src/*/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS include/fastlio/${NAME}/*.h)
  if(sources)
    add_library(${target} SHARED ${sources} ${headers})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:fastlio_compiler_options>)
    fastlio_precompile(${target} library)
    fastlio_unity(${target} 12)
    set_target_properties(${target} PROPERTIES
      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(mrpt_fastlio::${NAME} ALIAS ${target})
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} ${scope} ${ARG_PUBLIC})
  target_compile_features(${target} ${scope} cxx_std_17)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${NAME})
  fastlio_install_module(${target})
  file(GLOB tests CONFIGURE_DEPENDS tests/*.cpp)
  list(TRANSFORM ARG_ALLOCATION_TESTS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/tests/)
  list(REMOVE_ITEM tests ${ARG_ALLOCATION_TESTS})
  if(BUILD_TESTING AND tests)
    fastlio_add_test(test_${NAME} SOURCES ${tests} LINK mrpt_fastlio::${NAME} ${ARG_TEST_LINK})
    # Tests see what is not public, too.
    target_include_directories(test_${NAME} PRIVATE src)
  endif()
  if(BUILD_TESTING AND ARG_ALLOCATION_TESTS)
    fastlio_add_test(test_${NAME}_allocations
      SOURCES ${ARG_ALLOCATION_TESTS} ${PROJECT_SOURCE_DIR}/tests/support/allocation_counter.cpp
      LINK mrpt_fastlio::${NAME} ${ARG_TEST_LINK})
  endif()
endfunction()

# Sanitizers slow programs down by a factor of ten or so; what they need in the environment is in the test
# presets.
set(FASTLIO_TEST_TIMEOUT 600)
# The cost of tests that take a minute: CTest starts them first, so that no core waits for them at the end.
set(FASTLIO_LONG_TEST 100)
if(MRPT_FASTLIO_SANITIZE)
  set(FASTLIO_TEST_TIMEOUT 3600)
endif()

# fastlio_list_test_suites(NAME): each test suite of a GoogleTest program becomes an entry of CTest.
function(fastlio_list_test_suites NAME)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${NAME}_suites.cmake)
  string(REGEX REPLACE "^test_" "" module ${NAME})
  add_custom_command(TARGET ${NAME} POST_BUILD BYPRODUCTS ${list} VERBATIM
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${NAME}> -D MODULE=${module} -D TIMEOUT=${FASTLIO_TEST_TIMEOUT}
      -D OUTPUT=${list} -P ${PROJECT_SOURCE_DIR}/cmake/list_test_suites.cmake)
  # A program that was not built has an entry that fails.
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${NAME}_include.cmake)
  file(WRITE ${include} "if(EXISTS [[${list}]])\n  include([[${list}]])\nelse()\n  add_test(${module}.NOT_BUILT ${NAME})\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()

# fastlio_add_test(NAME SOURCES ... [LINK ...]): a GoogleTest program.
function(fastlio_add_test NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${NAME} ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE ${ARG_LINK} fastlio_compiler_options GTest::gtest
    fastlio_test_main)
  target_include_directories(${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  target_compile_options(${NAME} PRIVATE ${FASTLIO_TEST_OPTIONS})
  fastlio_precompile(${NAME} test)
  fastlio_unity(${NAME} 9)
  fastlio_list_test_suites(${NAME})
endfunction()
