// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mapping/map_report.h>

#include <gtest/gtest.h>

namespace fastlio
{
/** The odometries of two sessions have no world in common: there is no before. */
TEST(ClosureAgreement, BetweenSessionsHasNoBefore)
{
  MappingResult result;
  result.submaps.resize(2);
  result.submaps[1].session = 1;
  result.estimate.nodes.resize(2);
  Closure closure;
  closure.a = 0;
  closure.b = 1;
  closure.verdict = ClosureVerdict::Accepted;
  result.closures = {closure};
  ASSERT_EQ(agreements(result).size(), 1U);
  EXPECT_FALSE(agreements(result).front().before);
  result.submaps[1].session = 0;
  EXPECT_TRUE(agreements(result).front().before);
}

}  // namespace fastlio
