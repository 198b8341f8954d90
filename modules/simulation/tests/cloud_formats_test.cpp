// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Clouds in every format go back to the same points at the same times, found from the data alone.

#include "short_simulation.h"
#include <fastlio/lidar/point_time.h>
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/point_cloud_conversion.h>
#include <fastlio/simulation/observations.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cmath>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservationPointCloud;

SimulationSettings settingsOf(const char* cloud, const char* unit, const char* reference)
{
  SimulationSettings s = defaultSettings("shake");
  s.duration = 4.0;
  s = withSetting(s, "lidar.columns", "128");
  s = withSetting(s, "lidar.lines", "8");
  s = withSetting(s, "lidar.cloud", cloud);
  s = withSetting(s, "lidar.point_time_unit", unit);
  return withSetting(s, "lidar.point_time_reference", reference);
}

CObservationPointCloud::Ptr cloudOf(const Simulation& simulation, std::size_t index)
{
  auto cloud =
      std::dynamic_pointer_cast<CObservationPointCloud>(toLidarObservation(simulation, index));
  EXPECT_TRUE(cloud);
  return cloud;
}

PointTimeFinding findingOf(const Simulation& simulation)
{
  std::vector<PointTimeSample> samples;
  for (std::size_t i = 0; i < 10; ++i)
  {
    const auto observation = cloudOf(simulation, i);
    const CloudColumns columns = readColumns(*observation->pointcloud);
    samples.push_back(sampleOf(
        toNanoseconds(observation->timestamp), columns.time, columns.single_precision_time));
  }
  return findPointTimes(samples);
}

/** Largest difference of a point's time from the truth [s]. */
double worstTime(const Simulation& simulation, const PointTimeReading& reading)
{
  const auto observation = cloudOf(simulation, 3);
  const std::int64_t stamp_ns = toNanoseconds(observation->timestamp);
  const CloudConversion cloud =
      toTimedPoints(readColumns(*observation->pointcloud), stamp_ns, {reading, {}});
  const LidarScan truth = simulation.scan(3);
  EXPECT_EQ(cloud.points.size(), truth.points.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    worst = std::max(
        worst, std::abs(static_cast<double>(
                   stamp_ns + cloud.points.time_offset_ns[i] - truth.stamp_ns -
                   truth.points.time_offset_ns[i])));
  return worst * 1e-9;
}
}  // namespace

TEST(CloudFormats, EveryUnitAndReferenceIsFoundAndRead)
{
  for (const char* cloud : {"xyzirt", "generic"})
    for (const char* unit : {"s", "ms", "us", "ns"})
      for (const char* reference : {"start", "middle", "end", "absolute"})
      {
        const std::string what = std::string(cloud) + " " + unit + " " + reference;
        const bool date = std::string(reference) == "absolute";
        const Simulation simulation(settingsOf(cloud, unit, reference));
        const PointTimeFinding finding = findingOf(simulation);
        if (date && std::string(cloud) == "xyzirt")
        {
          EXPECT_EQ(finding.verdict, PointTimeVerdict::Unusable) << what << finding.evidence;
          continue;
        }
        ASSERT_EQ(finding.verdict, PointTimeVerdict::Found) << what << ": " << finding.evidence;
        EXPECT_STREQ(nameOf(finding.reading.unit), unit) << what;
        EXPECT_STREQ(nameOf(finding.reading.reference), date ? "absolute" : "stamp") << what;
        EXPECT_LT(worstTime(simulation, finding.reading), 1e-6) << what;
      }
}

TEST(CloudFormats, CloudsWithoutTimesHaveNone)
{
  const Simulation simulation(settingsOf("xyzi", "s", "start"));
  EXPECT_EQ(findingOf(simulation).verdict, PointTimeVerdict::Absent);
  const auto observation = cloudOf(simulation, 0);
  EXPECT_EQ(
      readColumns(*observation->pointcloud).intensity.size(), observation->pointcloud->size());
}

TEST(CloudFormats, PacketsAreOnlyWrittenNatively)
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 3.0;
  EXPECT_FALSE(std::dynamic_pointer_cast<CObservationPointCloud>(
      toLidarObservation(Simulation(settings), 0)));
  settings.lidar.cloud = LidarCloud::Xyzirt;
  EXPECT_TRUE(cloudOf(Simulation(settings), 0));
}

}  // namespace fastlio
