// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "built_map.h"
#include "simulated_observations.h"
#include <fastlio/evaluation/evaluate.h>
#include <fastlio/loops/CMetricMapBuilderLoops.h>
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/run/scan_in_world.h>
#include <fastlio/scenarios/realistic.h>
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <utility>
#include <vector>

namespace fastlio
{
namespace
{
/** Around a block and on along the street where it began, fast and with few beams. */
const Simulation& ride()
{
  static const Simulation simulation = []
  {
    SimulationSettings settings = realistic(defaultSettings("town"));
    settings.seed = 1;
    settings.speed = 4.0;
    settings.lidar.stride = 16;
    // So that something is to be corrected.
    settings.lidar.beam.laser_elevation_std *= 3.0;
    return Simulation(withSetting(settings, "world.length", "600"));
  }();
  return simulation;
}

const std::vector<mrpt::obs::CObservation::Ptr>& rideObservations()
{
  static const auto all = testing::observationsOf(ride());
  return all;
}

Config rideConfig()
{
  Config config = matchingConfig(ride().settings());
  config.exporters.keyframe_distance = 10.0;
  return config;
}

/** As a stack drives a builder: sensory frames through the base class. \param ask whether it looks
 * at pose and maps on the way */
void drive(mrpt::slam::CMetricMapBuilder& builder, bool ask)
{
  mrpt::obs::CActionCollection no_action;
  mrpt::obs::CSensoryFrame frame;
  std::size_t frames = 0;
  for (const auto& observation : rideObservations())
  {
    frame.insert(observation);
    if (frame.size() < 20) continue;
    builder.processActionObservation(no_action, frame);
    frame.clear();
    if (!ask || ++frames % 100 != 0) continue;
    EXPECT_NE(builder.getCurrentPoseEstimation(), nullptr);
    mrpt::maps::CSimpleMap views;
    builder.getCurrentlyBuiltMap(views);
    EXPECT_EQ(views.size(), builder.getCurrentlyBuiltMapSize());
  }
  builder.processActionObservation(no_action, frame);
}

struct Driven
{
  CMetricMapBuilderLoops builder{rideConfig()};

  Driven() { drive(builder, true); }
};

const CMetricMapBuilderLoops& driven()
{
  static const Driven all;
  return all.builder;
}

mrpt::maps::CSimpleMap viewsOf(const mrpt::slam::CMetricMapBuilder& builder)
{
  mrpt::maps::CSimpleMap views;
  builder.getCurrentlyBuiltMap(views);
  return views;
}

/** When the scan was made, by the clock of the poses. */
std::int64_t stampOf(const mrpt::maps::CSimpleMap& views, std::size_t i)
{
  const auto raw_ns = toNanoseconds((*keyFrame(views, i).frame->begin())->timestamp);
  return driven().odometry().poseTimeOf(raw_ns);
}

/** Error of poses at the key frames when heading and place are aligned; rms [m]. The vehicle is
 * where the IMU is. */
double levelError(
    const mrpt::maps::CSimpleMap& views, const std::function<Pose(std::size_t)>& poseOf)
{
  Trajectory estimate, truth;
  estimate.source = "estimate";
  truth.source = "truth";
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    estimate.poses.push_back({stampOf(views, i), poseOf(i)});
    truth.poses.push_back({stampOf(views, i), ride().truth(stampOf(views, i)).T_world_imu});
  }
  EvaluationOptions options;
  options.alignment = Alignment::Yaw;
  return evaluate(estimate, truth, options).ape.translation.rmse;
}
}  // namespace

TEST(MetricMapBuilderLoops, ClosuresCorrectPosesAndViews)
{
  const CMetricMapBuilderLoops& builder = driven();
  ASSERT_GT(builder.closures(), 2U);
  const auto views = viewsOf(builder);
  ASSERT_GT(views.size(), 10U);
  const double before = levelError(
      views, [&](std::size_t i)
      { return builder.odometry().track().at(stampOf(views, i))->T_world_body; });
  const double after = levelError(
      views, [&](std::size_t i) { return toPose(keyFrame(views, i).pose->getMeanVal()); });
  std::printf(
      "%zu closures; error %.3f m by the odometry, %.3f m in the map\n", builder.closures(), before,
      after);
  EXPECT_LT(after, 0.5 * before);
}

/** The points of the last key frame are in the map where its corrected pose has them. */
TEST(MetricMapBuilderLoops, TheMetricMapIsTheCorrectedOne)
{
  const CMetricMapBuilderLoops& builder = driven();
  const auto views = viewsOf(builder);
  const auto& map = *metricMapOf(builder).mapByClass<mrpt::maps::CSimplePointsMap>();
  const std::size_t last = views.size() - 1;
  const KeyFrameView view = keyFrame(views, last);
  const auto scan = builder.odometry().decode(**view.frame->begin());
  ASSERT_TRUE(scan);
  const auto& track = builder.odometry().track();
  const TrackedPose odometry = *track.at(stampOf(views, last));
  const Pose T_map_world = toPose(view.pose->getMeanVal()) * odometry.T_world_body.inverse();
  EXPECT_GT(T_map_world.p.norm() + logSO3(T_map_world.R).norm(), 0.01);
  const OutputPoints points = scanInWorld(*scan, track);
  std::size_t near = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p =
        T_map_world * Vec3(
                          static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
                          static_cast<double>(points.z[i]));
    float squared = 1.0F, x = 0, y = 0, z = 0;
    map.kdTreeClosestPoint3D(
        static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), x, y, z,
        squared);
    near += squared < 0.11F * 0.11F ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(near), 0.98 * static_cast<double>(points.size()));
}

TEST(MetricMapBuilderLoops, ThePoseIsThatOfTheCorrectedMap)
{
  const CMetricMapBuilderLoops& builder = driven();
  const auto pdf = std::dynamic_pointer_cast<mrpt::poses::CPose3DPDFGaussian>(
      builder.getCurrentPoseEstimation());
  ASSERT_TRUE(pdf);
  const auto views = viewsOf(builder);
  const TrackedPose& end = builder.odometry().track().poses().back();
  // From the last key frame on, the motion is that of the odometry.
  const std::size_t last = views.size() - 1;
  const Pose key = toPose(keyFrame(views, last).pose->getMeanVal());
  const Pose motion = builder.odometry().track().at(stampOf(views, last))->T_world_body.inverse() *
                      end.T_world_body;
  EXPECT_LT((toPose(pdf->mean).p - (key * motion).p).norm(), 0.02);
  for (int i = 0; i < 6; ++i)
    EXPECT_GT(pdf->cov(i, i), 0.0);
}

/** Whoever asked for maps on the way has the same map in the end: that of all submaps at once. */
TEST(MetricMapBuilderLoops, StepByStepIsAsAllAtOnce)
{
  const MappingResult step_by_step = driven().mapping();
  Mapper mapper;
  for (const Submap& submap : step_by_step.submaps)
    mapper.add(submap);
  const MappingResult at_once = std::move(mapper).result();
  ASSERT_EQ(step_by_step.closures.size(), at_once.closures.size());
  for (std::size_t i = 0; i < at_once.closures.size(); ++i)
    EXPECT_EQ(step_by_step.closures[i].reason, at_once.closures[i].reason);
  ASSERT_EQ(step_by_step.estimate.nodes.size(), at_once.estimate.nodes.size());
  for (std::size_t i = 0; i < at_once.estimate.nodes.size(); ++i)
  {
    EXPECT_EQ(step_by_step.estimate.nodes[i].p, at_once.estimate.nodes[i].p);
    EXPECT_EQ(step_by_step.estimate.nodes[i].R, at_once.estimate.nodes[i].R);
    EXPECT_EQ(step_by_step.estimate.covariances[i], at_once.estimate.covariances[i]);
  }
}

/** Without a loop, everything is as of the builder without closures, to the bit. */
TEST(MetricMapBuilderLoops, WithoutAClosureItIsTheOdometry)
{
  CMetricMapBuilderLoops loops{rideConfig()};
  CMetricMapBuilderLIO plain{rideConfig()};
  for (std::size_t i = 0; i < 600; ++i)
    for (CMetricMapBuilderLIO* builder : {static_cast<CMetricMapBuilderLIO*>(&loops), &plain})
      builder->processObservation(rideObservations().at(i));
  EXPECT_EQ(loops.closures(), 0U);
  const auto a = viewsOf(loops), b = viewsOf(plain);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 0U);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(
        keyFrame(a, i).pose->getMeanVal().asTPose(), keyFrame(b, i).pose->getMeanVal().asTPose());
  loops.initialize();
  EXPECT_EQ(loops.getCurrentlyBuiltMapSize(), 0U);
  EXPECT_TRUE(loops.mapping().submaps.empty());
}

}  // namespace fastlio
