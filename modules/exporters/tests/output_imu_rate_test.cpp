// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "output_test_support.h"
#include <fastlio/exporters/standard_exporters.h>

namespace fastlio
{
namespace
{
using testing::dataLinesOf;
using testing::madeUpResult;
using testing::split;
using testing::TemporaryFolder;

constexpr std::int64_t kImuRateStamp = 1'403'636'580'838'555'648;

ImuRateState madeUpState(std::int64_t stamp_ns)
{
  ImuRateState state;
  state.stamp_ns = stamp_ns;
  state.x.R = expSO3({0.1, -0.3, 0.7});
  state.x.p = {1.0, -2.0, 3.0};
  state.x.v = {0.5, 0.25, -0.125};
  state.angular_rate = {0.0, 0.0, 2.0};
  Matrix6 root = Matrix6::Identity();
  root.row(1) << 0.5, 1.0, 0.25, -0.5, 0.0, 0.125;
  state.pose_covariance = 1e-4 * root * root.transpose();
  return state;
}

/** Rows of imu_rate.csv, header first, after one scan with the states before it. */
std::vector<std::string> written(const std::string& folder, const OutputFrame& frame)
{
  ExportTarget options;
  options.directory = folder;
  options.frame = frame;
  options.imu_rate = true;
  ExporterSet set = makeExporters(options);
  set.onScan(
      madeUpResult(kImuRateStamp + 10),
      {madeUpState(kImuRateStamp), madeUpState(kImuRateStamp + 5)});
  const OutputMap map;
  EXPECT_TRUE(set.finish({}, map).output_problems.empty());
  return dataLinesOf(folder + "/imu_rate.csv");
}

std::vector<double> numbersOf(const std::string& row)
{
  std::vector<double> numbers;
  for (const auto& cell : split(row, ','))
    numbers.push_back(std::stod(cell));
  return numbers;
}

TEST(ImuRateCsv, HoldsEachStateAtItsExactStamp)
{
  const TemporaryFolder folder;
  const auto lines = written(folder.path(), {});
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(split(lines[0], ',').size(), 1U + 7U + 3U + 21U);
  EXPECT_EQ(split(lines[1], ',')[0], std::to_string(kImuRateStamp));
  EXPECT_EQ(split(lines[2], ',')[0], std::to_string(kImuRateStamp + 5));
  const auto row = numbersOf(lines[1]);
  const ImuRateState state = madeUpState(kImuRateStamp);
  EXPECT_NEAR(row[2], state.x.p.y(), 1e-6);
  EXPECT_NEAR(row[9], state.x.v.y(), 1e-6);
  EXPECT_EQ(row[12], state.pose_covariance(0, 1));
}

TEST(ImuRateCsv, OfAVehicleHasItsOwnVelocityAndCovariance)
{
  const TemporaryFolder folder;
  const OutputFrame vehicle{"vehicle", {expSO3({0.0, 0.4, -0.1}), {0.3, 0.0, -0.1}}};
  const auto row = numbersOf(written(folder.path(), vehicle).at(1));
  const ImuRateState state = madeUpState(kImuRateStamp);
  // The body turns about z with 2 rad/s, the vehicle's origin is 0.3 m ahead.
  const Vec3 velocity = state.x.v + state.x.R * Vec3(0.0, 0.6, 0.0);
  EXPECT_LT((Vec3(row[8], row[9], row[10]) - velocity).norm(), 1e-5);
  const PoseEstimate estimate =
      poseEstimateOf(state.x.pose(), state.pose_covariance, vehicle.T_imu_body);
  EXPECT_LT((Vec3(row[1], row[2], row[3]) - estimate.T_world_body.p).norm(), 1e-5);
  EXPECT_EQ(row.back(), estimate.covariance(5, 5));
}

TEST(ImuRateCsv, IsWrittenOnlyWhenAskedFor)
{
  const TemporaryFolder folder;
  ExportTarget options;
  options.directory = folder.path();
  ExporterSet set = makeExporters(options);
  const OutputMap map;
  (void)set.finish({}, map);
  EXPECT_FALSE(std::filesystem::exists(folder.file("imu_rate.csv")));
}

}  // namespace
}  // namespace fastlio
