# mrpt_fastlio: compiler settings shared by all targets, as the interface library
# fastlio_compiler_options.
# SPDX-License-Identifier: BSD-3-Clause
add_library(fastlio_compiler_options INTERFACE)
target_compile_features(fastlio_compiler_options INTERFACE cxx_std_17)
target_compile_options(fastlio_compiler_options INTERFACE -Wall -Wextra -Wconversion -Wshadow)
# MRPT's macros put __FILE__ into the binaries; what is installed must not depend on where it was built.
target_compile_options(fastlio_compiler_options INTERFACE -ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
# Nobody reads errno after std::sqrt() or the exception flags of the processor. Without them, loops over points
# become vector instructions, with the same results.
target_compile_options(fastlio_compiler_options INTERFACE -fno-math-errno -fno-trapping-math)
# Nobody replaces single functions of our libraries by others, so they may be inlined within a library.
target_compile_options(fastlio_compiler_options INTERFACE -fno-semantic-interposition)
# GCC collects its garbage rarely: a tenth of the time of units that are full of Eigen's templates. With this
# the largest takes about 1 GB.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(fastlio_compiler_options INTERFACE "SHELL:--param ggc-min-heapsize=786432")
endif()
if(MRPT_FASTLIO_WERROR)
  target_compile_options(fastlio_compiler_options INTERFACE -Werror)
endif()
# MRPT's libraries, built for the baseline of x86-64, share Eigen's inline functions with ours, and so do programs that
# use our libraries: all have to agree on how memory is aligned and released. With AVX, Eigen releases memory in another
# way than malloc() gives it, whatever EIGEN_MAX_ALIGN_BYTES says. So Eigen does not see AVX; the compiler uses it all
# the same.
set(FASTLIO_EIGEN_AS_BASELINE -U__AVX__ -U__AVX2__ -U__AVX512F__ -U__AVX512DQ__ -U__FMA__)
if(MRPT_FASTLIO_NATIVE)
  target_compile_options(fastlio_compiler_options INTERFACE -march=native ${FASTLIO_EIGEN_AS_BASELINE})
  # GCC's flow analysis warns inside of its own AVX-512 header (GCC bug 105593) and of Eigen's AVX2 loads
  # that it cannot see to be unreachable. Which of these come depends on the processor, so that a build could
  # fail on one machine only; the builds for the baseline keep all of them.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(fastlio_compiler_options INTERFACE -Wno-maybe-uninitialized
      -Wno-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
endif()
if(MRPT_FASTLIO_SANITIZE)
  target_compile_options(fastlio_compiler_options INTERFACE
    -fsanitize=${MRPT_FASTLIO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    # What is suppressed at runtime (cmake/ubsan.supp) must be able to go on; the rest halts all the same.
    -fsanitize-recover=alignment)
  target_link_options(fastlio_compiler_options INTERFACE -fsanitize=${MRPT_FASTLIO_SANITIZE})
  # With the address sanitizer Eigen would have its own way, too, which MRPT's libraries do not know of.
  target_compile_definitions(fastlio_compiler_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
  # With sanitizers GCC finds uninitialised members where there are none (in <regex>, for one).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(fastlio_compiler_options INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# Reading Eigen and GoogleTest takes a good part of the time of most units.
option(MRPT_FASTLIO_PRECOMPILE "Precompile the headers that most units read" ON)
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  if(MRPT_FASTLIO_PRECOMPILE)
    # The cache takes units that read a precompiled header only when it may trust that header: it does not see which
    # macros and times the header depends on.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
  endif()
endif()
