// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Sessions of rigs whose LiDARs are mounted otherwise than the recordings say.

#include "map_fixture.h"
#include <fastlio/evaluation/consistency.h>
#include <fastlio/evaluation/trajectory_io.h>

#include <cstdio>
#include <string>

namespace fastlio::testing
{
namespace
{
class MapOfRigs : public Map
{
 protected:
  /** By sensors without other errors than the pose of the LiDAR. */
  static SimulationSettings wronglyMounted(SimulationSettings settings)
  {
    settings = withSetting(settings, "lidar.pose_rotation_std", "0.3");
    return withSetting(settings, "lidar.pose_position_std", "0.01");
  }

  /** The poses of the second session in the map of the first one. Both recordings have the same
   * stamps, so those of the second one become later. */
  [[nodiscard]] Consistency consistencyOfSecond(const std::string& map) const
  {
    constexpr std::int64_t kDayNs = 86'400'000'000'000;
    const auto joined = [&](const std::string& first, const std::string& second)
    {
      Trajectory all = readTrajectory(first);
      const Trajectory later = readTrajectory(second);
      for (std::size_t i = 0; i < later.poses.size(); ++i)
      {
        all.poses.push_back(later.poses[i]);
        all.poses.back().stamp_ns += kDayNs;
        if (later.hasCovariances()) all.covariances.push_back(later.covariances[i]);
      }
      return all;
    };
    const std::string folder = folder_.file(map) + "/covariance.recording";
    const auto pairs = associate(
        joined(folder + ".csv", folder + "-2.csv"),
        joined(
            folder_.file("first") + "/ground_truth.tum",
            folder_.file("second") + "/ground_truth.tum"),
        {});
    Consistency result = consistency(pairs, NeesAlignment::First).value();
    const std::int64_t begin = pairs.estimate.front().stamp_ns + kDayNs / 2;
    std::vector<double> rotation, position;
    for (const NeesSample& sample : result.samples)
    {
      if (sample.stamp_ns < begin) continue;
      rotation.push_back(sample.rotation);
      position.push_back(sample.position);
    }
    result.rotation = summarizeNees(rotation, 3);
    result.position = summarizeNees(position, 3);
    return result;
  }

  /** Maps both; the first one makes the map. */
  ProcessResult mapped(
      const std::string& name, const std::string& first, const std::string& second,
      std::vector<std::string> options = {})
  {
    std::vector<std::string> arguments{first,      second,       "-o",      folder_.file(name),
                                       "--export", "covariance", "--frame", "imu"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments);
  }
};

TEST_F(MapOfRigs, ASecondRigIsNotTooSure)
{
  SimulationSettings same_way = walk(25.0);  // it looks where the first pose does, for a while
  same_way.seed = 9;
  const std::string first = record("first", wronglyMounted(walk(45.0))),
                    second = record("second", wronglyMounted(same_way));
  const ProcessResult result = mapped("both", first, second);
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const Consistency others = consistencyOfSecond("both");
  // Both recordings tell the same pose of the LiDAR by the same labels, so this is believed.
  ASSERT_EQ(mapped("same", first, second, {"--same-rig"}).exit_status, 0);
  const Consistency same = consistencyOfSecond("same");
  std::printf(
      "NEES of attitude and position: %.1f, %.1f; as one rig %.1f, %.1f\n", others.rotation.mean,
      others.position.mean, same.rotation.mean, same.position.mean);
  EXPECT_LT(others.rotation.mean, 9.0);
  EXPECT_LT(others.position.mean, 9.0);
  EXPECT_GT(same.rotation.mean, 2.0 * others.rotation.mean);
}

TEST_F(MapOfRigs, SaysWhichSessionsAreOfOneRig)
{
  SimulationSettings elsewhere = anotherDay(25.0);
  elsewhere.lidar.T_imu_lidar.p.x() += 0.01;
  const std::string first = record("first", walk(45.0)), again = record("again", anotherDay(25.0)),
                    other = record("other", elsewhere);
  const ProcessResult result =
      run({first, again, other, "-o", folder_.file("map"), "--same-rig", "--export", "trajectory"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const auto sessions = summaryOf("map")["sessions"];
  EXPECT_EQ(sessions[0]["rig"], 0);
  EXPECT_EQ(sessions[1]["rig"], 0);
  EXPECT_EQ(sessions[2]["rig"], 2);
  EXPECT_NE(
      result.output.find("recording-3: its sensors are not those of recording"), std::string::npos)
      << result.output;
}
}  // namespace
}  // namespace fastlio::testing
