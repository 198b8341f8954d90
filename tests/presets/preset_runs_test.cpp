// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file preset_runs_test.cpp Every file in params/ on a simulated recording of the sensor that it
 * is for: field of view, ranges, noise, place of the IMU and the format of its driver. */

#include "process.h"
#include "temporary_folder.h"
#include <fastlio/evaluation/evaluate.h>
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/math/angles.h>
#include <fastlio/scenarios/scenario.h>
#include <fastlio/simulation/recording.h>
#include <fastlio/survey/lidar_models.h>

#include <gtest/gtest.h>

#include <map>
#include <ostream>

namespace fastlio
{
/** The name of a test in lists. */
std::ostream& operator<<(std::ostream& out, const Preset& preset)
{
  return out << preset.name;
}
}  // namespace fastlio

namespace fastlio::testing
{
namespace
{
constexpr int kLines = 32;  // of a sensor that exists with several numbers of them

bool isOf(const Preset& preset, std::string_view maker)
{
  return preset.name.substr(0, maker.size()) == maker;
}

/** In which form the maker's driver writes scans. */
void writeAsTheDriver(const Preset& preset, LidarSettings& lidar)
{
  if (preset.name == "velodyne_vlp16") return;  // raw packets
  lidar.cloud = LidarCloud::Generic;
  lidar.time_unit = CloudTimeUnit::Nanoseconds;
  if (!isOf(preset, "hesai") && !isOf(preset, "robosense")) return;
  lidar.time_unit = CloudTimeUnit::Seconds;
  lidar.time_reference = CloudTimeReference::Absolute;
}

/** The Mid-360's pattern, which does not repeat, is stood in for by lines over its field of view.
 */
LidarSettings sensorOf(const Preset& preset)
{
  LidarSettings lidar;
  lidar.kind = preset.name == "velodyne_vlp16" ? LidarKind::Vlp16
               : preset.full_circle            ? LidarKind::Os64
                                               : LidarKind::Livox;
  lidar.lines = preset.lines > 0 ? preset.lines : kLines;
  lidar.columns = 512;
  lidar.vertical_fov = (preset.highest - preset.lowest) * kRadPerDeg;
  lidar.elevation = 0.5 * (preset.highest + preset.lowest) * kRadPerDeg;
  lidar.point_rate = 100e3;
  lidar.min_range = preset.min_range;
  lidar.max_range = preset.max_range;
  lidar.range_noise = preset.range_noise;
  if (preset.imu) lidar.T_imu_lidar.p = -*preset.imu;
  writeAsTheDriver(preset, lidar);
  return lidar;
}

SimulationSettings recordingOf(const Preset& preset)
{
  SimulationSettings settings = defaultSettings("campus");
  settings.duration = 12.0;
  settings.lidar = sensorOf(preset);
  return settings;
}
}  // namespace

class PresetRuns : public ::testing::TestWithParam<Preset>
{
 protected:
  /** That of a preset, simulated for the first test that asks. */
  static RecordingFiles recordingFor(const Preset& preset)
  {
    static const TemporaryFolder folder;
    static std::map<std::string, RecordingFiles> made;
    const std::string name(preset.name);
    if (made.count(name) == 0)
      made[name] = writeRecording(Simulation(recordingOf(preset)), folder.file(name));
    return made[name];
  }

  ProcessResult run(std::vector<std::string> command)
  {
    return Process(command, folder_.file("log.txt")).wait();
  }

  TemporaryFolder folder_;
};

TEST_P(PresetRuns, KeepTheirSensorOnTrack)
{
  const RecordingFiles files = recordingFor(GetParam());
  const std::string tum = folder_.file("estimate.tum");
  const std::string yaml =
      std::string(FASTLIO_PARAMS_DIR "/") + std::string(GetParam().name) + ".yaml";
  const ProcessResult replay = run(
      {FASTLIO_REPLAY_PROGRAM, "-c", yaml, "--input-rawlog", files.rawlog, "--output-tum-path", tum,
       "--frame", "imu"});
  ASSERT_EQ(replay.exit_status, 0) << replay.output;
  const double ape = evaluate(readTum(tum), readTum(files.ground_truth)).ape.translation.rmse;
  EXPECT_LT(ape, 0.006) << replay.output;  // 0.001 to 0.0022 m were seen
  std::cout << GetParam().name << ": APE " << ape << " m\n";
}

TEST_P(PresetRuns, AreNotWarnedAboutOnTheirSensor)
{
  const RecordingFiles files = recordingFor(GetParam());
  const ProcessResult info = run({FASTLIO_INFO_PROGRAM, files.rawlog, "--no-motion"});
  EXPECT_EQ(info.exit_status, 0) << info.output;
  // Of LiDARs without a built-in IMU nobody has said where they are.
  const std::string poses = "WARNING: The recording has no sensor poses";
  const std::size_t first = info.output.find("WARNING: ");
  EXPECT_TRUE(first == std::string::npos || first == info.output.find(poses)) << info.output;
  EXPECT_EQ(
      info.output.find("WARNING: ", first == std::string::npos ? 0 : first + 1), std::string::npos)
      << info.output;
  EXPECT_NE(info.output.find("fastlio-replay can run on this"), std::string::npos) << info.output;
}

INSTANTIATE_TEST_SUITE_P(
    Preset, PresetRuns, ::testing::ValuesIn(presetTable()),
    [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace fastlio::testing
