// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mapping/map_report.h>

#include <gtest/gtest.h>

#include <memory>

namespace fastlio
{
namespace
{
/** Two submaps with a plane each, and a closure between them. */
MappingResult twoSubmaps()
{
  const auto store = std::make_shared<SubmapStore>();
  MappingResult result;
  result.submaps.resize(2);
  for (Submap& submap : result.submaps)
    submap.surfaces = StoredSurfaces(store, {{VoxelPlane{}}, {0.01F}});
  result.estimate.nodes.resize(2);
  Closure closure;
  closure.a = 0;
  closure.b = 1;
  closure.verdict = ClosureVerdict::Accepted;
  result.closures = {closure};
  return result;
}
}  // namespace

/** The odometries of two sessions have no world in common: there is no before. */
TEST(ClosureAgreement, BetweenSessionsHasNoBefore)
{
  MappingResult result = twoSubmaps();
  result.submaps[1].session = 1;
  ASSERT_EQ(agreements(result).size(), 1U);
  EXPECT_FALSE(agreements(result).front().before);
  result.submaps[1].session = 0;
  EXPECT_TRUE(agreements(result).front().before);
}

/** Surfaces that are lost are not 0 m apart. */
TEST(ClosureAgreement, IsNotKnownOfSurfacesThatAreLost)
{
  MappingResult result = twoSubmaps();
  result.submaps[0].surfaces = {};
  EXPECT_TRUE(agreements(result).empty());
}

}  // namespace fastlio
