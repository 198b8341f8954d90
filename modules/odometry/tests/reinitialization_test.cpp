// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "reinitialization.h"

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
constexpr std::int64_t kSecond = 1'000'000'000;

double carriedStd(std::int64_t start_ns)
{
  Reinitialization reinitialization{OdometryOptions{}};
  FilterState state;
  state.x.v = {4.0, 0.0, 0.0};
  const std::string why = reinitialization.decideAt({10 * kSecond, 11 * kSecond, false}, state);
  EXPECT_NE(why.find("1.00 s without inertial samples"), std::string::npos) << why;
  EXPECT_TRUE(reinitialization.pending());
  const CarriedPose carried = reinitialization.takeCarried(start_ns);
  EXPECT_FALSE(reinitialization.pending());
  return std::sqrt(carried.P(kPosition, kPosition));
}

// The gap took one second, but scans and inertial data made no start for three more.
TEST(Reinitialization, TheCarriedPoseIsAsUncertainAsTheTimeUntilTheStart)
{
  EXPECT_NEAR(carriedStd(11 * kSecond), 0.5, 1e-6);
  EXPECT_NEAR(carriedStd(14 * kSecond), 8.0, 1e-6);
}
}  // namespace
}  // namespace fastlio
