// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The inertial samples that the odometry hands on: as the filter uses them.

#include "odometry_runs.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
/** What is handed on of a recording. \param before_scans whether each scan's samples have come when
 * its result does */
struct HandedOn
{
  std::vector<ImuSample> samples;
  bool before_scans = true;

  HandedOn(const OdometryOptions& options, const RoomRecording& recording)
  {
    Odometry odometry(options);
    odometry.setSampleCallback([this](const ImuSample& sample) { samples.push_back(sample); });
    const auto check = [this](const Results& results)
    {
      if (!results.empty() && results.back().status == ScanStatus::Tracking)
        before_scans = before_scans && samples.back().stamp_ns >= results.back().stamp_ns;
    };
    Results results;
    std::size_t next = 0;
    for (const LidarScan& scan : recording.scans)
    {
      for (; next < recording.imu.size() && recording.imu[next].stamp_ns <= spanOf(scan).end_ns;
           ++next)
        odometry.addImu(recording.imu[next]);
      odometry.addScan(scan);
      drain(odometry, results);
      check(results);
    }
    for (; next < recording.imu.size(); ++next)
      odometry.addImu(recording.imu[next]);
    finish(odometry, results);
    check(results);
  }
};
}  // namespace

TEST(SampleCallback, CleanSamplesAreHandedOnAsTheyCame)
{
  const RoomRecording recording = recordRoom(3.0);
  const HandedOn handed(roomParameters(), recording);
  ASSERT_EQ(handed.samples.size(), recording.imu.size());
  for (std::size_t i = 0; i < recording.imu.size(); ++i)
  {
    ASSERT_EQ(handed.samples[i].stamp_ns, recording.imu[i].stamp_ns);
    ASSERT_EQ(handed.samples[i].accel, recording.imu[i].accel);
    ASSERT_EQ(handed.samples[i].gyro, recording.imu[i].gyro);
  }
  EXPECT_TRUE(handed.before_scans);
}

/** Of an accelerometer that measures in g, with the sign of the acceleration of free fall. */
TEST(SampleCallback, UnitAndSignAreThoseOfTheFilter)
{
  const RoomRecording recording = recordRoom(3.0);
  RoomRecording raw = recording;
  for (ImuSample& sample : raw.imu)
    sample.accel /= -9.80665;
  OdometryOptions options = roomParameters();
  options.imu.invert_acceleration = true;
  const HandedOn handed(options, raw);
  ASSERT_EQ(handed.samples.size(), recording.imu.size());
  for (std::size_t i = 0; i < recording.imu.size(); ++i)
    ASSERT_LT((handed.samples[i].accel - recording.imu[i].accel).norm(), 1e-9);
  EXPECT_TRUE(handed.before_scans);
}

TEST(SampleCallback, SamplesThatAreDroppedAreNotHandedOn)
{
  const RoomRecording recording = recordRoom(3.0);
  RoomRecording raw = recording;
  raw.imu[300].accel = {0.0, 2000.0, 0.0};  // no platform does that
  raw.imu.insert(raw.imu.begin() + 400, raw.imu[390]);
  const HandedOn handed(roomParameters(), raw);
  EXPECT_EQ(handed.samples.size(), recording.imu.size() - 1);
  std::int64_t last_ns = 0;
  for (const ImuSample& sample : handed.samples)
  {
    EXPECT_LT(sample.accel.norm(), 100.0);
    EXPECT_GT(sample.stamp_ns, last_ns);
    last_ns = sample.stamp_ns;
  }
}
