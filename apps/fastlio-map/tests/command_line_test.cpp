// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The program on simulated recordings: loops, runs without any, several sessions, GNSS, bad command
// lines.

#include "map_fixture.h"

#include <string>

namespace fastlio::testing
{
namespace
{
TEST_F(Map, ClosesTheLoopOfAWalk)
{
  const std::string rawlog = record("walk", walk(55.0));
  const ProcessResult result = run({rawlog, "-o", folder_.file("map"), "--frame", "imu"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const auto summary = summaryOf("map");
  EXPECT_TRUE(summary["corrected"].get<bool>());
  EXPECT_GE(summary["closures_accepted"].get<int>(), 1);
  EXPECT_LE(
      summary["surfaces_apart_after_m"].get<double>(),
      summary["surfaces_apart_before_m"].get<double>() + 0.002);
  const auto walls = summary["wall_thickness"];
  EXPECT_GT(walls["walls"].get<int>(), 50);
  EXPECT_GT(walls["single_m"].get<double>(), 0.001);
  EXPECT_LE(walls["after_m"].get<double>(), walls["before_m"].get<double>() + 0.002);
  EXPECT_LT(walls["ratio"].get<double>(), 1.5);
  for (const std::string& text : {result.output, contentOf(folder_.file("map") + "/report.html")})
    EXPECT_NE(text.find("walls of two passes are "), std::string::npos) << text.substr(0, 2000);
  for (const auto& file : summary["outputs"])
    EXPECT_EQ(fs::file_size(file["path"].get<std::string>()), file["bytes"].get<std::size_t>());
  EXPECT_NE(
      contentOf(folder_.file("map") + "/poses.g2o").find("EDGE_SE3:QUAT 0 1"), std::string::npos);
  EXPECT_NE(contentOf(folder_.file("map") + "/report.html").find("Closures"), std::string::npos);
}

TEST_F(Map, WithoutARevisitIsTheOdometryToTheBit)
{
  const std::string rawlog = record("walk", walk(16.0));
  ASSERT_EQ(
      run({rawlog, "-o", folder_.file("map"), "--export", "trajectory,covariance,ply"}).exit_status,
      0);
  EXPECT_FALSE(summaryOf("map")["corrected"].get<bool>());
  EXPECT_TRUE(summaryOf("map")["wall_thickness"].is_null());
  const auto replay =
      Process({FASTLIO_REPLAY_PROGRAM, rawlog, "-o", folder_.file("replay")}, folder_.file("r.txt"))
          .wait();
  ASSERT_EQ(replay.exit_status, 0) << replay.output;
  for (const char* file : {"/trajectory.tum", "/covariance.csv", "/map.ply"})
    EXPECT_TRUE(contentOf(folder_.file("map") + file) == contentOf(folder_.file("replay") + file))
        << file;
  // A folder of a run stands for its recording and its parameters.
  ASSERT_EQ(
      run({folder_.file("replay"), "-o", folder_.file("again"), "--export", "trajectory"})
          .exit_status,
      0);
  EXPECT_TRUE(
      contentOf(folder_.file("again") + "/trajectory.tum") ==
      contentOf(folder_.file("map") + "/trajectory.tum"));
}

TEST_F(Map, DoesNotDependOnTheThreads)
{
  const std::string rawlog = record("walk", walk(42.0));
  for (const char* threads : {"1", "3"})
    ASSERT_EQ(
        run({rawlog, "-o", folder_.file(threads), "--threads", threads, "--export",
             "covariance,graph,ply"})
            .exit_status,
        0);
  for (const char* file : {"/covariance.csv", "/poses.graph", "/map.ply"})
    EXPECT_TRUE(contentOf(folder_.file("1") + file) == contentOf(folder_.file("3") + file)) << file;
}

TEST_F(Map, FindsAnotherDayInTheMap)
{
  const std::string first = record("first", walk(45.0));
  const std::string second = record("second", anotherDay(25.0));
  const ProcessResult result =
      run({first, second, "-o", folder_.file("both"), "--export", "trajectory,report"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const auto summary = summaryOf("both");
  ASSERT_EQ(summary["sessions"].size(), 2U);
  EXPECT_TRUE(summary["sessions"][1]["in_map"]["found"].get<bool>());
  EXPECT_GT(summary["sessions"][1]["in_map"]["probability"].get<double>(), 0.999);
  EXPECT_TRUE(fs::exists(folder_.file("both") + "/trajectory.recording.tum"));
  EXPECT_TRUE(fs::exists(folder_.file("both") + "/trajectory.recording-2.tum"));
}

TEST_F(Map, AnotherPlaceIsNotFoundAndSaysSo)
{
  const std::string first = record("first", walk(20.0));
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 20.0;
  settings.lidar.stride = 6;
  const std::string second = record("second", settings);
  const ProcessResult result =
      run({first, second, "-o", folder_.file("both"), "--export", "trajectory"});
  EXPECT_EQ(result.exit_status, 6) << result.output;
  EXPECT_NE(result.output.find("its place in the map was not found"), std::string::npos);
  EXPECT_FALSE(summaryOf("both")["sessions"][1]["in_map"]["found"].get<bool>());
  EXPECT_FALSE(fs::exists(folder_.file("both") + "/trajectory.recording-2.tum"));
}

TEST_F(Map, GnssTellsTheCoordinates)
{
  SimulationSettings settings = walk(50.0);
  settings = withSetting(settings, "gnss.rate", "2");
  settings = withSetting(settings, "gnss.noise", "0.5");
  settings = withSetting(settings, "gnss.multipath", "0.05");
  const std::string rawlog = record("walk", settings);
  const ProcessResult result =
      run({rawlog, "-o", folder_.file("map"), "--export", "las", "--crs", "EPSG:32632"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const auto summary = summaryOf("map");
  EXPECT_TRUE(summary["gnss"]["used"].get<bool>());
  EXPECT_NEAR(summary["gnss"]["horizontal_std_m"].get<double>(), 0.5, 0.35);
  EXPECT_EQ(summary["earth"]["crs"], "EPSG:32632");
  EXPECT_TRUE(summary["earth"]["rms_m"].is_null()) << "of control points only";
  const std::string las = contentOf(folder_.file("map") + "/map.las");
  EXPECT_EQ(las.substr(0, 4), "LASF");
  EXPECT_NE(las.find("UTM zone 32N"), std::string::npos);

  ASSERT_EQ(
      run({rawlog, "-o", folder_.file("without"), "--export", "trajectory", "--no-gnss"})
          .exit_status,
      0);
  EXPECT_TRUE(summaryOf("without")["earth"].is_null());
}

TEST_F(Map, RemovesMovingObjects)
{
  SimulationSettings settings = defaultSettings("crowd");
  settings.duration = 14.0;
  settings.lidar.stride = 6;
  const std::string rawlog = record("crowd", settings);
  for (const char* threads : {"1", "3"})
  {
    const ProcessResult result = run(
        {rawlog, "-o", folder_.file(threads), "--threads", threads, "--remove-moving", "--export",
         "ply,planes,report"});
    ASSERT_EQ(result.exit_status, 0) << result.output;
    EXPECT_NE(result.output.find("moving objects: "), std::string::npos) << result.output;
  }
  for (const char* file : {"/map.ply", "/map.planes"})
    EXPECT_TRUE(contentOf(folder_.file("1") + file) == contentOf(folder_.file("3") + file)) << file;
  EXPECT_NE(
      contentOf(folder_.file("1") + "/report.html").find("moving objects: "), std::string::npos);
  const auto moving = summaryOf("1")["moving_objects"];
  EXPECT_GT(moving["removed_points"].get<int>(), moving["scan_points"].get<int>() / 100);
  EXPECT_LT(moving["removed_points"].get<int>(), moving["scan_points"].get<int>() / 5);
  ASSERT_EQ(run({rawlog, "-o", folder_.file("all"), "--export", "ply"}).exit_status, 0);
  EXPECT_TRUE(summaryOf("all")["moving_objects"].is_null());
  EXPECT_GT(summaryOf("all")["map_points"], summaryOf("1")["map_points"]);
}

TEST_F(Map, WheelsTellTheWayThroughATunnel)
{
  SimulationSettings settings = defaultSettings("tunnel");
  settings.duration = 20.0;
  settings.lidar.stride = 8;
  settings.wheels.rate = 50.0;
  const std::string rawlog = record("tunnel", settings);
  const ProcessResult result =
      run({rawlog, "-o", folder_.file("with"), "--export", "trajectory,report"});
  EXPECT_NE(result.output.find("wheel odometry determines"), std::string::npos) << result.output;
  const auto summary = summaryOf("with");
  EXPECT_TRUE(summary["wheels"]["used"].get<bool>());
  EXPECT_TRUE(summary["corrected"].get<bool>());
  EXPECT_NEAR(summary["wheels"]["scale"].get<double>(), 1.0, 0.05);
  EXPECT_NE(summary["result"].get<std::string>().find("wheel odometry"), std::string::npos);
  EXPECT_NE(
      contentOf(folder_.file("with") + "/report.html").find("wheel odometry determines"),
      std::string::npos);
  run({rawlog, "-o", folder_.file("without"), "--export", "trajectory", "--no-wheels"});
  EXPECT_EQ(summaryOf("without")["wheels"]["readings"].get<int>(), 0);
  EXPECT_FALSE(summaryOf("without")["corrected"].get<bool>());
}

TEST_F(Map, RefusesBadCommandLines)
{
  const std::string missing = folder_.file("none.rawlog");
  EXPECT_EQ(run({}).exit_status, 1);
  EXPECT_EQ(run({missing, "-o", folder_.file("map")}).exit_status, 2);
  EXPECT_FALSE(fs::exists(folder_.file("map")));
  const std::string rawlog = record("walk", walk(4.0));
  EXPECT_EQ(run({rawlog, rawlog, "-o", folder_.file("map")}).exit_status, 1);
  EXPECT_EQ(run({rawlog, "-o", folder_.file("map"), "--export", "nothing"}).exit_status, 1);
  EXPECT_EQ(run({rawlog, "-o", folder_.file("map"), "--set", "map.voxel_sise=1"}).exit_status, 1);
  fs::create_directory(folder_.file("empty"));
  const ProcessResult folder = run({folder_.file("empty"), "-o", folder_.file("map")});
  EXPECT_EQ(folder.exit_status, 2);
  EXPECT_NE(folder.output.find("has no summary.json"), std::string::npos) << folder.output;
  EXPECT_FALSE(fs::exists(folder_.file("map")));
}

TEST_F(Map, UnknownReferenceSystem)
{
  SimulationSettings settings = walk(20.0);
  settings = withSetting(settings, "gnss.rate", "5");
  const ProcessResult result = run(
      {record("walk", settings), "-o", folder_.file("map"), "--export", "las", "--crs", "EPSG:1"});
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_NE(result.output.find("EPSG:1"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace fastlio::testing
