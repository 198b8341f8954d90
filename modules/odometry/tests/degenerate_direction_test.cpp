// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// For a while nothing shows where the platform is along one axis. Then it comes into view.

#include "odometry_runs.h"
#include <fastlio/matching/degeneracy.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace fastlio::testing
{
namespace
{
// Of the standard deviation along x. A fifth of it goes; a half goes where scans that share the
// error count as independent.
constexpr double kKept = 0.67;

constexpr double kSkew = 0.008;  // [rad]

/** The room's walls across x are at -6 m and 7 m. */
bool isOnAnEndWall(const Vec3& p)
{
  return p.x() < -5.8 || p.x() > 6.8;
}

double secondsSinceStart(std::int64_t stamp_ns)
{
  return static_cast<double>(stamp_ns - kRecordingStart) * 1e-9;
}

/** The room without the walls across x for some time: a corridor whose ends cannot be seen. */
RoomRecording corridorBetween(double begin_s, double end_s)
{
  RoomRecording recording = recordRoom(13.0);
  for (LidarScan& scan : recording.scans)
  {
    const double t = secondsSinceStart(scan.stamp_ns);
    if (t < begin_s || t >= end_s) continue;
    const PointColumns all = scan.points;
    scan.points = {};
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      const Pose T_world_lidar =
          recording.truthAt(scan.stamp_ns + all.time_offset_ns[i]) * scan.T_imu_lidar;
      if (isOnAnEndWall(T_world_lidar * Vec3(all.x[i], all.y[i], all.z[i]))) continue;
      scan.points.push_back(
          all.x[i], all.y[i], all.z[i], all.intensity[i], all.time_offset_ns[i], all.ring[i]);
    }
  }
  return recording;
}

double stdAlongX(const ScanResult& result)
{
  return std::sqrt(result.filter.P(kPosition, kPosition));
}

class DegenerateDirection : public ::testing::TestWithParam<double>
{
};

// The scans that add the end walls are all wrong by the same along x. The second one shows the
// velocity, so the position becomes more certain once; so it does when the direction is weak no
// more, as the covariance of the few planes that show a weak one is a bound. Scans after that show
// where the platform is in the map, and never where the map is in the world.
TEST_P(DegenerateDirection, IsNoMoreCertainTheLongerItsEndIsSeen)
{
  const RoomRecording recording = corridorBetween(0.0, GetParam());
  const Results results = runInOrder(roomParameters(), recording);
  const auto errors = poseErrors(results, recording);
  ASSERT_EQ(errors.size(), results.size());
  const auto in_view = [&](const ScanResult& r)
  {
    return secondsSinceStart(r.begin_ns) >= GetParam() &&
           r.statistics.constraints.unconstrained == 0 && !isWeak(r.statistics.constraints, 0);
  };
  const auto seen = std::find_if(results.begin(), results.end(), in_view);
  ASSERT_GT(results.end() - seen, 20);
  ASSERT_TRUE(std::any_of(
      results.begin(), seen,
      [](const ScanResult& r) { return r.statistics.constraints.unconstrained == 1; }))
      << "nothing was degenerate";
  for (auto r = seen; r != results.end(); ++r)
  {
    const double error = errors[static_cast<std::size_t>(r - results.begin())].position.x();
    const double t = secondsSinceStart(r->stamp_ns);
    EXPECT_EQ(r->status, ScanStatus::Tracking) << t;
    EXPECT_GT(stdAlongX(*r), kKept * stdAlongX(*seen)) << t;
    EXPECT_LT(std::abs(error), 3.0 * stdAlongX(*r)) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(CorridorsOfSeconds, DegenerateDirection, ::testing::Values(6.0, 7.0));

// The accelerometer is mounted askew, so the position drifts while the end walls are out of view.
// They come back outside the gate of what the filter itself is uncertain about.
TEST(OpenDirection, IsFoundAgainWithinTheWholeCovariance)
{
  constexpr double kHidden = 2.0, kShown = 8.0;  // [s]
  RoomRecording recording = corridorBetween(kHidden, kShown);
  for (ImuSample& sample : recording.imu)
    sample.accel.x() += kSkew * sample.accel.z();
  // The filter is sure of the bias, but the mounting is known to a few mrad only.
  OdometryOptions options = roomParameters();
  options.initialization.accel_bias_std = 0.002;
  const Results results = runInOrder(options, recording);
  const auto errors = poseErrors(results, recording);
  ASSERT_EQ(errors.size(), results.size());
  double drift = 0.0, later = 0.0;
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    const double t = secondsSinceStart(results[i].begin_ns), x = std::abs(errors[i].position.x());
    if (t < kShown) drift = x;
    if (t > kShown + 1.0) later = std::max(later, x);
  }
  EXPECT_GT(drift, 0.15);
  EXPECT_LT(later, 0.05);
}

}  // namespace
}  // namespace fastlio::testing
