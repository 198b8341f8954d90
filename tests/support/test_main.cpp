// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The main function of all test programs. Where tests were skipped the status says so, and CTest
// lists them: what did not run has not passed.

#include <gtest/gtest.h>

namespace
{
constexpr int kSkipped = 77;  // SKIP_RETURN_CODE of cmake/list_test_suites.cmake
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  const int status = RUN_ALL_TESTS();
  const int skipped = testing::UnitTest::GetInstance()->skipped_test_count();
  return status == 0 && skipped > 0 ? kSkipped : status;
}
