// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// A program that is compiled without the libraries' machine-dependent flags, as a user's may be:
// it must see the same types and get the same results.

#include "odometry_runs.h"
#include "public_types.h"

#include <gtest/gtest.h>

std::vector<fastlio::testing::TypeLayout> fastlio::testing::baselineLayouts()
{
  return FASTLIO_PUBLIC_LAYOUTS;
}

namespace fastlio::testing
{
namespace
{
TEST(BaselineConsumer, SeesTheTypesAsTheLibrariesDo)
{
  const auto native = nativeLayouts(), baseline = baselineLayouts();
  ASSERT_EQ(native.size(), baseline.size());
  for (std::size_t i = 0; i < native.size(); ++i)
  {
    EXPECT_EQ(native[i].size, baseline[i].size) << native[i].name;
    EXPECT_EQ(native[i].alignment, baseline[i].alignment) << native[i].name;
    // The alignment of operator new of C++14 and of MRPT's containers.
    EXPECT_LE(baseline[i].alignment, alignof(std::max_align_t)) << native[i].name;
  }
}

TEST(BaselineConsumer, RunsTheOdometry)
{
  const RoomRecording recording = recordRoom();
  const Results results = runInOrder(roomParameters(), recording);
  ASSERT_GT(results.size(), 30U);
  for (const PoseError& error : poseErrors(results, recording))
    EXPECT_LT(error.position.norm(), 0.05);
}

TEST(BaselineConsumer, OwnsMapsAndTheirContents)
{
  CVoxelPlanesMap map;
  WorldPoints points;
  points.resize(1000);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points.x[i] = 0.05F * static_cast<float>(i % 30);
    points.y[i] = 0.05F * static_cast<float>(i / 30);
    points.z[i] = 0.2F;
  }
  map.insertPoints(points, {0.0, 0.0, 2.0});
  const CVoxelPlanesMap copy(map);
  const std::vector<VoxelPlane> planes = copy.planes().bestPlanes();
  ASSERT_FALSE(planes.empty());
  for (const VoxelPlane& plane : planes)
    EXPECT_NEAR(std::abs(plane.nz), 1.0F, 1e-4F);
}
}  // namespace
}  // namespace fastlio::testing
