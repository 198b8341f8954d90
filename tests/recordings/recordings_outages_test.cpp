// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Stretches of the recordings are removed: fastlio-replay ends right, or does not end with 0.

#include "process.h"
#include "recordings_folder.h"
#include "repeats.h"
#include <fastlio/compat/register_classes.h>
#include <fastlio/evaluation/association.h>
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/math/time.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/conversions.h>

#include <gtest/gtest.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;

struct Outage
{
  bool lidar = false, imu = false;
  double length_s = 0.0;
};

std::string nameOf(const Outage& outage)
{
  return std::string(outage.lidar ? "no scans " : "") + (outage.imu ? "no inertial data " : "") +
         std::to_string(outage.length_s) + " s";
}

/** Copies a recording without what the outage takes away from a second on.
 * \return the length of the recording [s] */
double copyWithout(
    const std::string& from, const std::string& to, const Outage& outage, double begin_s)
{
  registerBridgeClasses();
  RawlogSource source({from});
  mrpt::io::CFileOutputStream out(to);
  auto archive = mrpt::serialization::archiveFrom(out);
  std::optional<std::int64_t> first_ns;
  double t = 0.0;
  while (const auto observation = source.next())
  {
    const std::int64_t stamp_ns = toNanoseconds(observation->timestamp);
    if (!first_ns) first_ns = stamp_ns;
    t = toSeconds(stamp_ns - *first_ns);
    const bool is_imu =
        dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get()) != nullptr;
    const bool gone = is_imu ? outage.imu : outage.lidar;
    if (gone && t >= begin_s && t < begin_s + outage.length_s) continue;
    archive << *observation;
  }
  return t;
}

/** Largest position error over its standard deviation, of errors above 0.3 m; both trajectories
 * begin at the same pose. */
double worstSigmas(const std::string& covariance_csv, const std::string& truth_tum)
{
  const AssociatedTrajectories both =
      associate(readCovarianceCsv(covariance_csv), readTum(truth_tum), {});
  const Pose world =
      both.estimate.front().T_world_body * both.reference.front().T_world_body.inverse();
  double worst = 0.0;
  for (std::size_t i = 0; i < both.estimate.size(); ++i)
  {
    const Pose truth = world * both.reference[i].T_world_body;
    const double error = (both.estimate[i].T_world_body.p - truth.p).norm();
    const double std = std::sqrt(both.covariances[i].diagonal().tail<3>().sum());
    if (error > 0.3) worst = std::max(worst, error / std);
  }
  return worst;
}
}  // namespace

class OutageOfARecording : public ::testing::TestWithParam<std::string>
{
};

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(OutageOfARecording);

TEST_P(OutageOfARecording, EndsRightOrNotWithZero)
{
  const bool every = everything();
  const std::vector<Outage> sample{{true, false, 5.0}, {false, true, 0.2}, {true, true, 5.0}};
  const std::vector<Outage> all{{true, false, 1.0},  {true, false, 2.0},  {true, false, 5.0},
                                {true, false, 10.0}, {true, false, 20.0}, {true, false, 30.0},
                                {false, true, 0.2},  {false, true, 0.4},  {false, true, 1.0},
                                {false, true, 5.0},  {true, true, 1.0},   {true, true, 5.0}};
  const ScratchFolder scratch(GetParam() + "-outages");
  const fs::path folder = MRPT_FASTLIO_RECORDINGS_DIR;
  const std::string truth = (folder / (GetParam() + ".gt.tum")).string();
  const std::string copy = scratch.file("copy.rawlog"), out = scratch.file("out");
  const double length =
      copyWithout((folder / (GetParam() + ".rawlog")).string(), copy, Outage{}, 0.0);
  for (const Outage& outage : every ? all : sample)
    for (double begin = 3.0; begin + outage.length_s + 1.0 < length; begin += every ? 1.0 : 40.0)
    {
      copyWithout((folder / (GetParam() + ".rawlog")).string(), copy, outage, begin);
      fs::remove_all(out);
      const ProcessResult end = Process(
                                    {FASTLIO_REPLAY_PROGRAM, "--input-rawlog", copy, "--output-dir",
                                     out, "--frame", "imu", "--threads", "1"},
                                    scratch.file("log"))
                                    .wait();
      if (end.exit_status != 0) continue;
      EXPECT_LT(worstSigmas((fs::path(out) / "covariance.csv").string(), truth), 5.0)
          << nameOf(outage) << " from " << begin << " s on";
    }
}

// Outages after which the odometry went on from a wrong pose and called it good: 101.6 m at a
// standard deviation of 0.26 m on a walk of 20 m, and others.
struct Example
{
  const char* recording;
  Outage outage;
  double begin_s;
};

class ExampleOfAnOutage : public ::testing::TestWithParam<Example>
{
};

TEST_P(ExampleOfAnOutage, EndsRightOrNotWithZero)
{
  const auto& [recording, outage, begin] = GetParam();
  const fs::path folder = MRPT_FASTLIO_RECORDINGS_DIR;
  const std::string original = (folder / (std::string(recording) + ".rawlog")).string();
  if (folder.empty() || !fs::exists(original)) GTEST_SKIP() << "needs " << recording;
  const ScratchFolder scratch(std::string(recording) + "-example");
  copyWithout(original, scratch.file("copy.rawlog"), outage, begin);
  const std::string out = scratch.file("out");
  const ProcessResult end =
      Process(
          {FASTLIO_REPLAY_PROGRAM, "--input-rawlog", scratch.file("copy.rawlog"), "--output-dir",
           out, "--frame", "imu", "--threads", "1"},
          scratch.file("log"))
          .wait();
  // Whatever the program says: no pose is off by more than the covariance says.
  EXPECT_TRUE(end.exit_status == 0 || end.exit_status == 4 || end.exit_status == 6);
  const std::string truth = (folder / (std::string(recording) + ".gt.tum")).string();
  EXPECT_LT(worstSigmas((fs::path(out) / "covariance.csv").string(), truth), 5.0);
}

INSTANTIATE_TEST_SUITE_P(
    Of, ExampleOfAnOutage,
    ::testing::Values(
        Example{"office_vlp16", {true, false, 5.0}, 8.0},
        Example{"office_vlp16", {true, false, 10.0}, 15.0},
        Example{"euroc_v102", {true, false, 10.0}, 15.0},
        Example{"euroc_v102", {true, false, 10.0}, 8.0}),
    [](const auto& instance)
    {
      return instance.param.recording + std::string("From") +
             std::to_string(static_cast<int>(instance.param.begin_s));
    });

INSTANTIATE_TEST_SUITE_P(
    Of, OutageOfARecording, ::testing::ValuesIn(recordingNames()),
    [](const auto& instance) { return instance.param; });

}  // namespace fastlio::testing
