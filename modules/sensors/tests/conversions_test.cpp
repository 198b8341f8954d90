// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Times, poses, inertial samples and clouds.

#include "test_files.h"
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/imu_conversion.h>
#include <fastlio/sensors/point_cloud_conversion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
}  // namespace

TEST(Conversions, TimeIsExactTo100Ns)
{
  for (const std::int64_t ns : {0LL, 1'700'000'000'123'456'700LL, -1'000'000'100LL})
    EXPECT_EQ(toNanoseconds(toMrptTime(ns)), ns);
  EXPECT_EQ(toNanoseconds(toMrptTime(1'700'000'000'000'000'049)), 1'700'000'000'000'000'000);
  EXPECT_EQ(toNanoseconds(toMrptTime(1'700'000'000'000'000'051)), 1'700'000'000'000'000'100);
  EXPECT_DOUBLE_EQ(mrpt::Clock::toDouble(toMrptTime(1'500'000'000'500'000'000)), 1500000000.5);
}

TEST(Conversions, AbsurdStampsAreLimited)
{
  const auto first = toNanoseconds(mrpt::Clock::time_point::min());
  const auto last = toNanoseconds(mrpt::Clock::time_point::max());
  EXPECT_LT(first, 0);
  EXPECT_GT(last, 0);
  EXPECT_EQ(last - first, 2 * last);  // no overflow
  EXPECT_EQ(toNanoseconds(INVALID_TIMESTAMP), first);
}

TEST(Conversions, PosesKeepTheirMeaning)
{
  const mrpt::poses::CPose3D theirs(1, 2, 3, 0.3, -0.2, 0.1);
  const Pose ours = toPose(theirs);
  const auto point = theirs.composePoint(mrpt::math::TPoint3D(4, 5, 6));
  EXPECT_TRUE((ours * Vec3(4, 5, 6)).isApprox(Vec3(point.x, point.y, point.z), 1e-12));
  const auto back = toMrptPose(ours);
  EXPECT_NEAR(back.yaw(), 0.3, 1e-12);
  EXPECT_NEAR(back.pitch(), -0.2, 1e-12);
  EXPECT_NEAR(back.roll(), 0.1, 1e-12);
  EXPECT_EQ(back.z(), 3);
}

TEST(Imu, ChannelsGoToTheirAxes)
{
  const auto imu = imuAt(1.5);
  imu->set(mrpt::obs::IMU_X_VEL, 99);
  const auto conversion = toImuSample(*imu);
  ASSERT_TRUE(conversion.sample);
  EXPECT_EQ(conversion.sample->stamp_ns, kStart + 1'500'000'000);
  EXPECT_EQ(conversion.sample->gyro, Vec3(0.01, 0.02, 0.03));
  EXPECT_EQ(conversion.sample->accel, Vec3(0.1, 0.2, 9.81));
}

TEST(Imu, DefectsAreDistinguished)
{
  auto imu = imuAt(0);
  imu->dataIsPresent[mrpt::obs::IMU_Z_ACC] = false;
  EXPECT_EQ(toImuSample(*imu).defect, ImuDefect::NoAcceleration);
  imu = imuAt(0);
  imu->dataIsPresent[mrpt::obs::IMU_WX] = false;
  EXPECT_EQ(toImuSample(*imu).defect, ImuDefect::NoAngularRate);
  imu = imuAt(0);
  imu->set(mrpt::obs::IMU_WY, NAN);
  EXPECT_EQ(toImuSample(*imu).defect, ImuDefect::NotFinite);
  imu = imuAt(0);
  imu->set(mrpt::obs::IMU_X_ACC, INFINITY);
  EXPECT_EQ(toImuSample(*imu).defect, ImuDefect::NotFinite);
  imu = imuAt(0);
  imu->timestamp = INVALID_TIMESTAMP;
  EXPECT_EQ(toImuSample(*imu).defect, ImuDefect::NoStamp);
  EXPECT_FALSE(toImuSample(*imu).sample);
}

// Found by fuzzing: an archive fills bools with whatever bytes the file has.
TEST(Imu, AByteThatIsNoBoolIsNoChannel)
{
  const auto imu = imuAt(0);
  ASSERT_TRUE(toImuSample(*imu).sample);
  const std::uint8_t byte = 38;
  std::memcpy(&imu->dataIsPresent.at(mrpt::obs::IMU_Y_ACC), &byte, sizeof(byte));
  EXPECT_EQ(toImuSample(*imu).defect, ImuDefect::NoAcceleration);
}

TEST(PointCloud, TimesOfEitherSignBecomeNanoseconds)
{
  const auto result = toTimedPoints({{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, 10}, {-0.05F, 0.05F}}, 0);
  EXPECT_EQ(result.times, PointTimes::PerPoint);
  EXPECT_NEAR(result.points.time_offset_ns[0], -50'000'000, 2);
  EXPECT_NEAR(result.points.time_offset_ns[1], 50'000'000, 2);
  EXPECT_EQ(result.points.x, (std::vector<float>{1, 2}));
  EXPECT_EQ(result.points.intensity, (std::vector<float>{7, 8}));
  EXPECT_EQ(result.points.ring, (std::vector<std::uint16_t>{9, 10}));
}

TEST(PointCloud, InvalidPointsAreDropped)
{
  const auto result = toTimedPoints(
      {{1, kNan, 0, 1, 1, 1},
       {1, 1, 0, INFINITY, 1, 0},
       {1, 1, 0, 1, 1, 0},
       {},
       {},
       {0, 0, 0, 0, kNan, 0.1F}},
      0);
  EXPECT_EQ(result.dropped_invalid, 4U);
  EXPECT_EQ(result.points.size(), 2U);
  EXPECT_EQ(result.times, PointTimes::PerPoint);
}

TEST(PointCloud, MissingAndUnusableTimesAreReported)
{
  EXPECT_EQ(toTimedPoints({{1}, {2}, {3}, {}, {}, {}}, 0).times, PointTimes::Absent);
  // Absolute seconds, milliseconds.
  for (const float t : {1.7e9F, 50.0F, -3.0F, INFINITY})
  {
    const auto result = toTimedPoints({{1, 1}, {2, 2}, {3, 3}, {}, {}, {0, t}}, 0);
    EXPECT_EQ(result.times, PointTimes::Unusable);
    EXPECT_EQ(result.points.size(), 2U);
    EXPECT_EQ(result.points.time_offset_ns, (std::vector<std::int32_t>{0, 0}));
  }
  EXPECT_EQ(toTimedPoints({}, 0).points.size(), 0U);
}

TEST(PointCloud, SinglePointsOfAnImpossibleTimeAreDropped)
{
  constexpr std::size_t kPoints = 29'000;
  CloudColumns cloud;
  for (std::size_t i = 0; i < kPoints; ++i)
    cloud.time.push_back(0.1 * static_cast<double>(i) / kPoints);
  cloud.x = cloud.y = cloud.z = std::vector<float>(kPoints, 1.0F);
  cloud.time[17] = 1e9;
  cloud.time[1000] = -2.1;
  cloud.time.back() = std::numeric_limits<double>::infinity();
  for (const auto reference : {PointTimeReference::Stamp, PointTimeReference::Start})
  {
    CloudTiming timing;
    timing.reading->reference = reference;
    const auto result = toTimedPoints(cloud, 0, timing);
    EXPECT_EQ(result.times, PointTimes::PerPoint);
    EXPECT_EQ(result.dropped_invalid, 3U);
    ASSERT_EQ(result.points.size(), kPoints - 3);
    EXPECT_EQ(result.points.time_offset_ns[16], std::lround(1e9 * cloud.time[16]));
    EXPECT_EQ(result.points.time_offset_ns[17], std::lround(1e9 * cloud.time[18]));
  }
  // One in ten: the field means something else.
  for (std::size_t i = 0; i < kPoints; i += 10)
    cloud.time[i] = 50.0;
  const auto result = toTimedPoints(cloud, 0);
  EXPECT_EQ(result.times, PointTimes::Unusable);
  EXPECT_EQ(result.dropped_invalid, 0U);
  EXPECT_EQ(result.points.size(), kPoints);
}

TEST(PointCloud, TimesAreRoundedAndWhatIsUnusableIsLeftOut)
{
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  CloudColumns cloud;
  for (const double time :
       {0.0, 0.5e-9, -0.5e-9, 1.5e-9, -2.5e-9, 0.1, -0.05, 1.999999999, -1.9999999985, 3.3e-7})
  {
    const auto i = static_cast<float>(cloud.size());
    cloud.ring.insert(cloud.ring.end(), 3, static_cast<std::uint16_t>(cloud.size()));
    cloud.x.insert(cloud.x.end(), {i, 0.0F, kNan});  // a point, no echo, damage
    cloud.y.insert(cloud.y.end(), {i + 0.5F, 0.0F, 1.0F});
    cloud.z.insert(cloud.z.end(), {i + 0.25F, 0.0F, 1.0F});
    cloud.intensity.insert(cloud.intensity.end(), {i, 1.0F, 1.0F});
    cloud.time.insert(cloud.time.end(), 3, time);
  }
  const CloudConversion result = toTimedPoints(cloud, 0);
  ASSERT_EQ(result.points.size(), 10U);
  EXPECT_EQ(result.dropped_invalid, 20U);
  for (std::size_t i = 0; i < 10; ++i)
  {
    EXPECT_EQ(result.points.x[i], cloud.x[3 * i]);
    EXPECT_EQ(result.points.z[i], cloud.z[3 * i]);
    EXPECT_EQ(result.points.intensity[i], cloud.intensity[3 * i]);
    EXPECT_EQ(result.points.ring[i], cloud.ring[3 * i]);
    EXPECT_EQ(result.points.time_offset_ns[i], std::lround(1e9 * cloud.time[3 * i])) << i;
  }
}
