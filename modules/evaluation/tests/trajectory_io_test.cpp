// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "sample_trajectories.h"
#include <fastlio/evaluation/trajectory_io.h>

#include <limits>
#include <sstream>

namespace fastlio
{
namespace
{
using testing::expectThrows;

class TrajectoryIo : public ::testing::Test
{
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& text) const
  {
    return folder_.write("trajectory.txt", text);
  }

  /** Expects an error that names the file, the line and what else is given. */
  void expectError(
      const std::string& text, const char* line, std::initializer_list<const char*> parts) const
  {
    const auto read = [&] { (void)readTrajectory(file(text), {{}, 10.0}); };
    expectThrows<std::runtime_error>(read, {"trajectory.txt", line});
    expectThrows<std::runtime_error>(read, parts);
  }

  testing::TemporaryFolder folder_;
};

const std::string kStateHeader = "stamp_ns,x,y,z,qx,qy,qz,qw,vx,vy,vz";
const std::string kCovarianceHeader =
    "stamp_ns,x,y,z,qx,qy,qz,qw,"
    "c_rx_rx,c_rx_ry,c_rx_rz,c_rx_px,c_rx_py,c_rx_pz,c_ry_ry,c_ry_rz,c_ry_px,c_ry_py,c_ry_pz,"
    "c_rz_rz,c_rz_px,c_rz_py,c_rz_pz,c_px_px,c_px_py,c_px_pz,c_py_py,c_py_pz,c_pz_pz";

TEST_F(TrajectoryIo, TumKeepsEveryNanosecond)
{
  const Trajectory t =
      readTum(file("# comment\n\n1403715523.912143231 1 2 3 0 0 0.6 0.8\r\n"
                   "  1403715523.912143233\t4 5 +6 0 0 0 1\n"));
  ASSERT_EQ(t.poses.size(), 2U);
  EXPECT_EQ(t.poses[0].stamp_ns, 1403715523912143231);
  EXPECT_EQ(t.poses[1].stamp_ns, 1403715523912143233);
  EXPECT_TRUE(t.poses[1].T_world_body.p.isApprox(Vec3(4, 5, 6)));
  const Mat3 expected = expSO3({0, 0, 2.0 * std::atan2(0.6, 0.8)});
  EXPECT_TRUE(t.poses[0].T_world_body.R.isApprox(expected, 1e-12));
  EXPECT_FALSE(t.hasCovariances());
}

TEST_F(TrajectoryIo, TimesMayBeNegativeIntegersRoundedOrScientific)
{
  const std::string pose = " 0 0 0 0 0 0 1\n";
  const Trajectory t = readTum(file(
      "-1.5" + pose + "-0.25" + pose + "3" + pose + "4.0000000005" + pose + "5e0" + pose + "1.7e9" +
      pose));
  const std::vector<std::int64_t> expected{-1'500'000'000, -250'000'000,
                                           3'000'000'000,  4'000'000'001,
                                           5'000'000'000,  1'700'000'000'000'000'000};
  ASSERT_EQ(t.poses.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(t.poses[i].stamp_ns, expected[i]);
}

TEST_F(TrajectoryIo, KittiWithRateAndWithTimes)
{
  const auto poses = file("1 0 0 7 0 1 0 8 0 0 1 9\n0 -1 0 1 1 0 0 2 0 0 1 3\n");
  const Trajectory at_rate = readTrajectory(poses, {{}, 20.0});
  ASSERT_EQ(at_rate.poses.size(), 2U);
  EXPECT_EQ(at_rate.poses[1].stamp_ns, 50'000'000);
  EXPECT_TRUE(at_rate.poses[0].T_world_body.p.isApprox(Vec3(7, 8, 9)));
  EXPECT_TRUE(at_rate.poses[1].T_world_body.R.isApprox(expSO3({0, 0, M_PI / 2}), 1e-12));

  const auto times = folder_.write("times.txt", "12.5\n13.5\n");
  EXPECT_EQ(readKitti(poses, {times, 0.0}).poses[0].stamp_ns, 12'500'000'000);
}

TEST_F(TrajectoryIo, KittiNeedsTimes)
{
  const auto poses = file("1 0 0 7 0 1 0 8 0 0 1 9\n");
  const auto times = folder_.write("times.txt", "1\n2\n");
  const auto reading = [&](const KittiTiming& timing)
  { return [&poses, timing] { (void)readTrajectory(poses, timing); }; };
  expectThrows<std::runtime_error>(reading({}), {"carry no time"});
  expectThrows<std::runtime_error>(reading({{}, -1.0}), {"carry no time"});
  expectThrows<std::runtime_error>(reading({times, 10.0}), {"either"});
  expectThrows<std::runtime_error>(reading({times, 0.0}), {"2 times", "1 poses"});
  const auto bad_times = folder_.write("times.txt", "1 2\n");
  expectThrows<std::runtime_error>(reading({bad_times, 0.0}), {"times.txt:1", "one time"});
}

TEST_F(TrajectoryIo, StatesAreFoundByColumnName)
{
  const Trajectory t = readTrajectory(
      file("# units\nvx,qw,qz,qy,qx,z,y,x,stamp_ns\n0.5,1,0,0,0,3,2,1,1700000000000000001\n"));
  ASSERT_EQ(t.poses.size(), 1U);
  EXPECT_EQ(t.poses[0].stamp_ns, 1'700'000'000'000'000'001);
  EXPECT_TRUE(t.poses[0].T_world_body.p.isApprox(Vec3(1, 2, 3)));
}

TEST_F(TrajectoryIo, CovarianceIsTheUpperTriangle)
{
  std::ostringstream text;
  text << "# order\n" << kCovarianceHeader << "\n5,1,2,3,0,0,0,1";
  for (int i = 1; i <= 21; ++i)
    text << ',' << i;
  const Trajectory t = readTrajectory(file(text.str()));
  ASSERT_EQ(t.covariances.size(), 1U);
  const Matrix6& P = t.covariances[0];
  EXPECT_EQ(P(0, 0), 1.0);
  EXPECT_EQ(P(0, 5), 6.0);
  EXPECT_EQ(P(1, 1), 7.0);
  EXPECT_EQ(P(2, 3), 13.0);
  EXPECT_EQ(P(5, 5), 21.0);
  EXPECT_TRUE(P.isApprox(P.transpose(), 0.0));
}

TEST_F(TrajectoryIo, BadLinesAreNamed)
{
  const std::string good = "1 0 0 0 0 0 0 1\n";
  expectError(good + "2 0 0 0 0 0 1\n", ":2:", {"8 columns", "saw 7"});
  expectError(good + good, ":2:", {"1.000000000 s", "not newer", "sort"});
  expectError("2 0 0 0 0 0 0 1\n" + good, ":2:", {"not newer"});
  expectError("1 0 nan 0 0 0 0 1\n", ":1:", {"finite", "nan"});
  expectError("1 0 1e999 0 0 0 0 1\n", ":1:", {"number", "1e999"});
  expectError("1 0 x 0 0 0 0 1\n", ":1:", {"number", "'x'"});
  expectError("1 0 0 0 0 0 0 2\n", ":1:", {"length is 2", "qx qy qz qw"});
  expectError("1 0 0 0 0 0 0 0\n", ":1:", {"length is 0"});
  expectError("1x 0 0 0 0 0 0 1\n", ":1:", {"time in seconds", "'1x'"});
  expectError("nan 0 0 0 0 0 0 1\n", ":1:", {"time in seconds"});
  expectError("1700000000000000000 0 0 0 0 0 0 1\n", ":1:", {"nanoseconds"});
  expectError("1e30 0 0 0 0 0 0 1\n", ":1:", {"nanoseconds"});
  expectError("1 2 3\n", ":1:", {"not known", "saw 3"});
  expectError("2 0 0 7 0 1 0 8 0 0 1 9\n", ":1:", {"not a rotation"});
  expectError("1 0 0 7 0 1 0 8 0 0 -1 9\n", ":1:", {"not a rotation"});
  expectError("1 0 0 7 0 1 0 8 0 0 1 9\n1 2\n", ":2:", {"12 numbers", "saw 2"});
}

TEST_F(TrajectoryIo, BadCsvIsNamed)
{
  expectError("stamp_ns,x,y,qx,qy,qz\n1,2,3,4,5,6\n", ":1:", {"lacks the columns z, qw"});
  expectError(kStateHeader + "\n", ":1:", {"no row"});
  expectError(kStateHeader + "\n1,2,3\n", ":2:", {"11 comma-separated", "saw 3"});
  expectError(kStateHeader + "\n1.5,0,0,0,0,0,0,1,0,0,0\n", ":2:", {"integer number of nano"});
  expectError(kStateHeader + "\n1,,0,0,0,0,0,1,0,0,0\n", ":2:", {"expected a number, saw ''"});
  const std::string row = "1,0,0,0,0,0,0,1";
  expectError(kCovarianceHeader + "\n" + row + "\n", ":2:", {"29 comma-separated", "saw 8"});
  expectThrows<std::runtime_error>(
      [&] { (void)readCovarianceCsv(file(kStateHeader + "\n")); }, {"c_rx_rx", "c_pz_pz"});
}

TEST_F(TrajectoryIo, UnreadableFiles)
{
  const auto reading = [](const std::filesystem::path& path)
  { return [path] { (void)readTrajectory(path); }; };
  expectThrows<std::runtime_error>(reading(folder_.file("none")), {"none", "does not exist"});
  expectThrows<std::runtime_error>(reading(folder_.path()), {"is a folder"});
  expectThrows<std::runtime_error>(reading(file("")), {"no data"});
  expectThrows<std::runtime_error>(reading(file("# only\n\n")), {"no data"});
}

TEST_F(TrajectoryIo, LinesWithoutEndAndPipesAreRefused)
{
  const auto reading = [](const std::filesystem::path& path)
  { return [path] { (void)readTrajectory(path); }; };
  expectThrows<std::runtime_error>(
      reading(file(std::string(1'000'000, '1'))), {":1:", "longer than 16384"});
  expectThrows<std::runtime_error>(reading("/dev/zero"), {"/dev/zero", "a pipe or a device"});
  expectThrows<std::runtime_error>(reading(file("1 2 \x1B[2J 4 5 6 7 8\n")), {"\\x1b[2J"});
}

TEST(TrajectoryTest, WhatIsNotATrajectoryIsRefused)
{
  const auto checking = [](const Trajectory& t) { return [&t] { requireValid(t); }; };
  expectThrows<std::invalid_argument>(checking(Trajectory{}), {"no pose"});
  Trajectory t = testing::curve(3);
  EXPECT_NO_THROW(requireValid(t));
  t.covariances.resize(2, Matrix6::Identity());
  expectThrows<std::invalid_argument>(checking(t), {"3 poses", "2 covariances"});
  t.covariances.resize(3, Matrix6::Identity());
  t.covariances[2](0, 0) = std::numeric_limits<double>::quiet_NaN();
  expectThrows<std::invalid_argument>(checking(t), {"pose 2", "covariance"});
  t = testing::curve(3);
  t.poses[1].stamp_ns = t.poses[0].stamp_ns;
  expectThrows<std::invalid_argument>(checking(t), {"curve", "pose 1", "not newer"});
  t = testing::curve(3);
  t.poses[1].T_world_body.p.x() = std::numeric_limits<double>::infinity();
  expectThrows<std::invalid_argument>(checking(t), {"pose 1", "not finite"});
  t = testing::curve(3);
  t.poses[2].T_world_body.R *= 2.0;
  expectThrows<std::invalid_argument>(checking(t), {"pose 2", "not a rotation"});
}

}  // namespace
}  // namespace fastlio
