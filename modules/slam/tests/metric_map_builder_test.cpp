// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "built_map.h"
#include "walk.h"
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/math/time.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/slam/CMetricMapBuilderLIO.h>

#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <cmath>

namespace fastlio
{
namespace
{
using testing::observations;
using testing::walk;

mrpt::maps::TSetOfMetricMapInitializers threeMaps()
{
  mrpt::maps::TSetOfMetricMapInitializers maps;
  mrpt::maps::CSimplePointsMap::TMapDefinition points;
  points.insertionOpts.minDistBetweenLaserPoints = 0.05F;
  maps.push_back(points);
  mrpt::maps::COccupancyGridMap2D::TMapDefinition grid;
  grid.resolution = 0.1F;
  grid.insertionOpts.maxDistanceInsertion = 20.0F;
  maps.push_back(grid);
  maps.push_back(CVoxelPlanesMap::TMapDefinition());
  return maps;
}

/** As a stack drives a builder: through the base class, one sensory frame after the other. */
void drive(mrpt::slam::CMetricMapBuilder& builder)
{
  mrpt::obs::CActionCollection no_action;
  mrpt::obs::CSensoryFrame frame;
  for (const auto& observation : observations())
  {
    frame.insert(observation);
    if (frame.size() < 7) continue;
    builder.processActionObservation(no_action, frame);
    frame.clear();
  }
  builder.processActionObservation(no_action, frame);
}

class Builder : public ::testing::Test
{
 protected:
  static CMetricMapBuilderLIO& driven()
  {
    static CMetricMapBuilderLIO builder(matchingConfig(walk().settings()), threeMaps());
    static const bool done = (drive(builder), true);
    EXPECT_TRUE(done);
    return builder;
  }
};

TEST_F(Builder, ReportsTheWayOnTheGroundFromTheStart)
{
  const mrpt::slam::CMetricMapBuilder& builder = driven();
  const auto pdf = std::dynamic_pointer_cast<mrpt::poses::CPose3DPDFGaussian>(
      builder.getCurrentPoseEstimation());
  ASSERT_TRUE(pdf);
  const std::int64_t end_ns = driven().odometry().track().poses().back().stamp_ns;
  const std::int64_t begin_ns = driven().odometry().track().poses().front().stamp_ns;
  const double true_way =
      (walk().truth(end_ns).T_world_imu.p - walk().truth(begin_ns).T_world_imu.p).norm();
  EXPECT_GT(true_way, 1.0);
  EXPECT_NEAR(pdf->mean.norm(), true_way, 0.1);
  for (int i = 0; i < 6; ++i)
    EXPECT_GT(pdf->cov(i, i), 0.0);
}

TEST_F(Builder, FillsEveryMapThatIsAskedFor)
{
  const auto& maps = metricMapOf(driven()).maps;
  ASSERT_EQ(maps.size(), 3U);
  const auto points =
      std::dynamic_pointer_cast<mrpt::maps::CSimplePointsMap>(mrpt::maps::CMetricMap::Ptr(maps[0]));
  ASSERT_TRUE(points);
  EXPECT_GT(points->size(), 5000U);
  const auto grid = std::dynamic_pointer_cast<mrpt::maps::COccupancyGridMap2D>(
      mrpt::maps::CMetricMap::Ptr(maps[1]));
  ASSERT_TRUE(grid);
  std::size_t free_cells = 0, walls = 0;
  for (const auto cell : grid->getRawMap())
  {
    const float p = mrpt::maps::COccupancyGridMap2D::l2p(cell);
    free_cells += p > 0.7F ? 1 : 0;
    walls += p < 0.3F ? 1 : 0;
  }
  EXPECT_GT(free_cells, 2000U);
  EXPECT_GT(walls, 100U);
  const auto planes =
      std::dynamic_pointer_cast<CVoxelPlanesMap>(mrpt::maps::CMetricMap::Ptr(maps[2]));
  ASSERT_TRUE(planes);
  EXPECT_FALSE(planes->isEmpty());
}

TEST_F(Builder, KeepsViewsByTheRules)
{
  mrpt::maps::CSimpleMap views;
  driven().getCurrentlyBuiltMap(views);
  EXPECT_EQ(views.size(), driven().getCurrentlyBuiltMapSize());
  ASSERT_GE(views.size(), 3U);
  for (std::size_t i = 1; i < views.size(); ++i)
  {
    const Pose a = toPose(keyFrame(views, i - 1).pose->getMeanVal());
    const Pose b = toPose(keyFrame(views, i).pose->getMeanVal());
    const double turned = logSO3(a.R.transpose() * b.R).norm();
    EXPECT_TRUE((a.p - b.p).norm() >= 0.999 || turned >= 0.348) << i;
  }
}

// A scan was made at its stamp less the offset of its clock, which nobody but the odometry knows.
TEST(BuilderClock, ViewsAreWhereTheirScansWereMade)
{
  constexpr double kLate = 0.05;  // [s]
  SimulationSettings settings = walk().settings();
  settings.lidar.stride = 4;
  settings.lidar.time_offset = kLate;
  const Simulation late(settings);
  Config config = matchingConfig(settings);
  config.odometry.lidar.time_offset = 0.0;
  CMetricMapBuilderLIO builder(config, threeMaps());
  for (const auto& observation : testing::observationsOf(late))
    builder.processObservation(observation);
  mrpt::maps::CSimpleMap views;
  builder.getCurrentlyBuiltMap(views);
  ASSERT_GT(views.size(), 4U);
  const Vec3 start = late.motion().pose(0.0).p;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    const KeyFrameView view = keyFrame(views, i);
    const double stamp =
        toSeconds(toNanoseconds((*view.frame->begin())->timestamp) - settings.start_ns);
    if (stamp < 4.0) continue;  // the offset has not been found yet
    const Vec3 made = late.motion().pose(stamp - kLate).p - start;
    const double distance = view.pose->getMeanVal().norm();
    EXPECT_NEAR(distance, made.norm(), 0.012) << stamp;
  }
}

TEST(BuilderStart, BeginsAtTheGivenPoseAndKeepsTheGivenMap)
{
  CMetricMapBuilderLIO builder(matchingConfig(walk().settings()));
  mrpt::maps::CSimpleMap given;
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(observations().front());
  insertKeyFrame(given, mrpt::poses::CPose3DPDFGaussian(), frame, {});
  const mrpt::poses::CPosePDFGaussian x0(mrpt::poses::CPose2D(10.0, -5.0, 1.0));
  builder.initialize(given, &x0);
  EXPECT_EQ(builder.getCurrentlyBuiltMapSize(), 1U);
  EXPECT_NEAR(builder.getCurrentPoseEstimation()->getMeanVal().x(), 10.0, 1e-9);
  for (std::size_t i = 0; i < 700; ++i)
    builder.processObservation(observations()[i]);
  const auto pose = builder.getCurrentPoseEstimation()->getMeanVal();
  EXPECT_NEAR(pose.x(), 10.0, 1.5);
  EXPECT_NEAR(pose.y(), -5.0, 1.5);
  builder.clear();  // of the base class: starts anew at the origin
  EXPECT_EQ(builder.getCurrentlyBuiltMapSize(), 0U);
}

TEST(BuilderStart, DoesNotGrowMapsWhenUpdatingIsOff)
{
  CMetricMapBuilderLIO builder(matchingConfig(walk().settings()));
  builder.enableMapUpdating(false);
  drive(builder);
  EXPECT_EQ(builder.getCurrentlyBuiltMapSize(), 0U);
  EXPECT_GT(builder.odometry().track().poses().size(), 50U);
}

}  // namespace
}  // namespace fastlio
