// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file inputs_test.cpp The same motion recorded in the formats of different drivers, through the
 * program: the format does not matter, and what is missing costs what it must. */

#include "process.h"
#include "temporary_folder.h"
#include <fastlio/evaluation/evaluate.h>
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>

namespace fastlio::testing
{
namespace
{
using Overrides = std::vector<std::pair<std::string, std::string>>;

/** Rotation up to 250 deg/s: without motion compensation the scans are useless. */
SimulationSettings shaken(const Overrides& overrides)
{
  SimulationSettings settings = defaultSettings("shake");
  settings.duration = 9.0;
  settings = withSetting(settings, "speed", "0.3");
  settings = withSetting(settings, "lidar.columns", "512");
  settings = withSetting(settings, "lidar.lines", "16");
  for (const auto& [key, value] : overrides)
    settings = withSetting(settings, key, value);
  return settings;
}

class Inputs : public ::testing::Test
{
 protected:
  RecordingFiles record(const SimulationSettings& settings, const std::string& name)
  {
    return writeRecording(Simulation(settings), folder_.file(name));
  }

  /** APE [m] of a run; fails when the program does. */
  double apeOf(const std::string& rawlog, const std::string& truth, const std::string& yaml = {})
  {
    const std::string config = folder_.file("c.yaml");
    std::ofstream(config) << "lidar:\n  min_range: 0.5\n" << yaml;
    const std::string tum = folder_.file("estimate.tum");
    const auto end = Process(
                         {FASTLIO_REPLAY_PROGRAM, "-c", config, "--input-rawlog", rawlog,
                          "--output-tum-path", tum, "--frame", "imu"},
                         folder_.file("log.txt"))
                         .wait();
    output_ = end.output;
    const bool is_expected = end.exit_status == 0 || (may_be_degraded_ && end.exit_status == 6);
    EXPECT_TRUE(is_expected) << end.exit_status << "\n" << output_;
    if (!is_expected) return 1e9;
    return evaluate(readTum(tum), readTum(truth)).ape.translation.rmse;
  }

  double apeOf(const Overrides& overrides, const std::string& yaml = {})
  {
    const RecordingFiles files = record(shaken(overrides), "recording");
    return apeOf(files.rawlog, files.ground_truth, yaml);
  }

  TemporaryFolder folder_;
  std::string output_;
  bool may_be_degraded_ = false;
};

/** Both recordings in one, the clouds of the second under another label. */
void merge(const std::string& first, const std::string& second, const std::string& to)
{
  RawlogSource front({first}), rear({second});
  mrpt::io::CFileGZOutputStream file(to);
  auto archive = mrpt::serialization::archiveFrom(file);
  auto next = rear.next();
  while (const auto observation = front.next())
  {
    for (; next && next->timestamp <= observation->timestamp; next = rear.next())
      if (std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(next))
      {
        next->sensorLabel = "rear";
        archive << *next;
      }
    archive << *observation;
  }
}
}  // namespace

TEST_F(Inputs, FormatOfTheTimesDoesNotMatter)
{
  const double native = apeOf(Overrides{});
  EXPECT_LT(native, 0.02);
  for (const auto& [unit, reference] :
       {std::pair{"ns", "start"},
        {"us", "middle"},
        {"ms", "end"},
        {"s", "absolute"},
        {"ns", "absolute"}})
  {
    const double ape = apeOf(
        {{"lidar.cloud", "generic"},
         {"lidar.point_time_unit", unit},
         {"lidar.point_time_reference", reference}});
    EXPECT_NEAR(ape, native, 0.002) << unit << ' ' << reference << "\n" << output_;
  }
}

TEST_F(Inputs, TimesFromTheAzimuthAreNearlyAsGoodAsRecordedOnes)
{
  const double recorded = apeOf(Overrides{});
  const double synthetic = apeOf({{"lidar.cloud", "xyzi"}});
  EXPECT_NE(output_.find("times are made from the azimuth"), std::string::npos) << output_;
  EXPECT_LT(synthetic, recorded + 0.01);
  may_be_degraded_ = true;  // scans that are not deskewed contradict the inertial data
  const double none = apeOf({{"lidar.cloud", "xyzi"}}, "input:\n  missing_point_times: none\n");
  EXPECT_NE(output_.find("see different motions"), std::string::npos) << output_;
  EXPECT_GT(none, 2.0 * synthetic);
  RecordProperty("ape_recorded", std::to_string(recorded));
  RecordProperty("ape_synthetic", std::to_string(synthetic));
  RecordProperty("ape_none", std::to_string(none));
  std::cout << "APE [m]: times recorded " << recorded << ", from the azimuth " << synthetic
            << ", none " << none << '\n';
}

TEST_F(Inputs, TwoLidarsSeeMoreThanOne)
{
  // Narrow fields of view, forward and backward; the rear one's clock is 20 ms ahead. From this
  // place on no direction stays unconstrained, which would leave the result to chance.
  SimulationSettings settings = withSetting(defaultSettings("office"), "path_start", "20");
  settings.duration = 14.0;
  for (const auto& [key, value] : Overrides{
           {"lidar.kind", "livox"}, {"lidar.point_rate", "60000"}, {"lidar.pose", "0.1,0,0,0,0,0"}})
    settings = withSetting(settings, key, value);
  const RecordingFiles front = record(settings, "front");
  for (const auto& [key, value] :
       Overrides{{"lidar.pose", "-0.1,0,0,180,0,0"}, {"lidar.time_offset", "0.02"}})
    settings = withSetting(settings, key, value);
  const RecordingFiles rear = record(settings, "rear");
  const std::string both = folder_.file("both.rawlog");
  merge(front.rawlog, rear.rawlog, both);
  const double one = apeOf(both, front.ground_truth, "input:\n  lidar_sensor_label: lidar\n");
  EXPECT_NE(output_.find("LiDAR 'rear' is not used"), std::string::npos) << output_;
  const double two =
      apeOf(both, front.ground_truth, "lidar_2:\n  sensor_label: rear\n  time_offset: -0.02\n");
  EXPECT_LT(two, 0.03);
  EXPECT_LT(two, one);
  std::cout << "APE [m]: front LiDAR " << one << ", both " << two << '\n';
}

}  // namespace fastlio::testing
