# mrpt_fastlio: the entries of CTest for a GoogleTest program.
# SPDX-License-Identifier: BSD-3-Clause
#
# cmake -D PROGRAM=... -D MODULE=... -D TIMEOUT=... -D OUTPUT=... -P list_test_suites.cmake
#
# Writes what CTest runs of a GoogleTest program: an entry per test suite, named module.suite. A process per suite: its
# tests share what the suite sets up, and the libraries are loaded once.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
if(NOT suites)
  message(FATAL_ERROR "${PROGRAM} lists no test suite:\n${listed}")
endif()
set(entries "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n|\\.$" "" suite "${suite}")
  string(APPEND entries
    "add_test([[${MODULE}.${suite}]] [[${PROGRAM}]] [[--gtest_filter=${suite}.*]])\n"
    "set_tests_properties([[${MODULE}.${suite}]] PROPERTIES TIMEOUT ${TIMEOUT} SKIP_RETURN_CODE 77)\n")
endforeach()
file(WRITE ${OUTPUT} "${entries}")
