// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// KITTI's folders, folders of clouds, and the files in them.

#include "cloud_files.h"
#include "recording_test_support.h"
#include "stamp_text.h"

#include <mrpt/core/format.h>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

/** Two points as KITTI stores them. */
std::string binCloud(float x)
{
  WireWriter out(Wire::Ros1);
  for (const float value : {x, 2.0F, 3.0F, 0.5F, -x, 5.0F, 6.0F, 0.25F})
    out.number(value);
  return out.bytes();
}

class Folders : public RecordingTest
{
 protected:
  void put(const std::string& name, const std::string& bytes)
  {
    std::filesystem::create_directories(std::filesystem::path(folder_.file(name)).parent_path());
    write(folder_.file(name), bytes);
  }

  std::string root() { return folder_.path(); }
};

TEST(StampText, EveryFormIsExact)
{
  const auto stamp_of = [](const std::string& text)
  { return stampOf(text, stampUnitOf({text}, kCloudRhythm)); };
  EXPECT_EQ(stamp_of("1403636580.838555648"), 1'403'636'580'838'555'648);
  EXPECT_EQ(stamp_of("1403636580838555648"), 1'403'636'580'838'555'648);
  EXPECT_EQ(stamp_of("1403636580838555"), 1'403'636'580'838'555'000);
  EXPECT_EQ(stamp_of("1403636580838"), 1'403'636'580'838'000'000);
  EXPECT_EQ(stamp_of("1403636580"), 1'403'636'580'000'000'000);
  EXPECT_EQ(stamp_of("0.1"), 100'000'000);
  EXPECT_EQ(stamp_of("1.037875e-01"), 103'787'500);
  EXPECT_EQ(stamp_of("2011-09-26 13:02:25.594360375"), 1'317'042'145'594'360'375);
  for (const char* wrong :
       {"", "x", "-1", "-0.5", "1e300", "nan", "2011-09-26 xx:02:25", "1.2.3",
        "9999-12-31 00:00:00", "1969-12-31 23:59:59"})
    EXPECT_FALSE(stamp_of(wrong)) << wrong;
}

TEST_F(Folders, AKittiDriveGivesCloudsAndSamplesInOrder)
{
  std::string times, sample;
  for (int i = 0; i < 30; ++i)
    sample += i == 11 ? "0.5 " : i == 13 ? "9.8 " : i == 19 ? "0.25 " : "0 ";
  for (int i = 0; i < 5; ++i)
    times += mrpt::format("2011-09-26 13:02:2%i.500000000\n", i);
  for (int i = 0; i < 5; ++i)
  {
    if (i != 2)  // a lost frame keeps its time
      put(mrpt::format("drive/velodyne_points/data/%010i.bin", i), binCloud(static_cast<float>(i)));
    put(mrpt::format("drive/oxts/data/%010i.txt", i), sample);
  }
  put("drive/velodyne_points/timestamps.txt", times);
  put("drive/oxts/timestamps.txt", times);
  put("calib_imu_to_velo.txt", "calib_time: 25-May-2012\nR: 1 0 0 0 1 0 0 0 1\nT: -0.8 0.3 -0.8\n");
  const Recorded drive = readRecording(folder_.file("drive"));
  EXPECT_TRUE(drive.problems.empty());
  EXPECT_EQ(drive.count("velodyne"), 4U);
  EXPECT_EQ(drive.count("oxts"), 5U);
  for (std::size_t i = 1; i < drive.observations.size(); ++i)
    EXPECT_LE(drive.observations[i - 1]->timestamp, drive.observations[i]->timestamp);
  for (const auto& observation : drive.observations)
  {
    mrpt::poses::CPose3D pose;
    observation->getSensorPose(pose);
    if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get()))
    {
      EXPECT_EQ(imu->get(mrpt::obs::IMU_X_ACC), 0.5);
      EXPECT_EQ(imu->get(mrpt::obs::IMU_Z_ACC), 9.8);
      EXPECT_EQ(imu->get(mrpt::obs::IMU_WZ), 0.25);
    }
    else
      EXPECT_NEAR(pose.x(), 0.8, 1e-12);
  }
}

TEST_F(Folders, AKittiSequenceGivesItsClouds)
{
  put("00/times.txt", "0.000000e+00\n1.037875e-01\n");
  put("00/velodyne/000000.bin", binCloud(1));
  put("00/velodyne/000001.bin", binCloud(2));
  const Recorded sequence = readRecording(folder_.file("00"));
  ASSERT_EQ(sequence.count("velodyne"), 2U);
  EXPECT_EQ(toNanoseconds(sequence.observations[1]->timestamp), 103'787'500);
  const CloudColumns columns = columnsOf(*sequence.observations[1]);
  EXPECT_EQ(columns.x, (std::vector<float>{2, -2}));
  EXPECT_EQ(columns.intensity, (std::vector<float>{0.5F, 0.25F}));
  EXPECT_TRUE(columns.time.empty());
}

TEST_F(Folders, CloudsNamedByTheirTimesJoinATableOfSamples)
{
  put("walk/clouds/1700000000.100000000.bin", binCloud(1));
  put("walk/clouds/1700000000.200000000.bin", binCloud(2));
  put("walk/imu.csv",
      "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
      "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n"
      "1700000000150000000,0.1,0.2,0.3,1,2,9.8\n"
      "broken line\n"
      "1700000000160000000,0.1,0.2,0.3,1,2,9.8\r\n");
  const Recorded walk = readRecording(folder_.file("walk"));
  ASSERT_EQ(walk.observations.size(), 4U);
  EXPECT_EQ(walk.count("lidar"), 2U);
  const auto& imu = dynamic_cast<const mrpt::obs::CObservationIMU&>(*walk.observations[1]);
  EXPECT_EQ(toNanoseconds(imu.timestamp), 1'700'000'000'150'000'000);
  EXPECT_EQ(imu.get(mrpt::obs::IMU_WZ), 0.3);
  EXPECT_EQ(imu.get(mrpt::obs::IMU_Y_ACC), 2.0);
  ASSERT_EQ(walk.problems.size(), 1U);
  EXPECT_TRUE(contains(walk.problems[0].message, "1 lines")) << walk.problems[0].message;
}

TEST_F(Folders, ATableMayNameItsColumnsInAnyOrder)
{
  put("a/1.5.bin", binCloud(1));
  put("a/imu.csv", "acc_x,acc_y,acc_z,gyro_x,gyro_y,gyro_z,time\n1,2,3,4,5,6,1.5\n");
  const Recorded walk = readRecording(folder_.file("a"));
  ASSERT_EQ(walk.count("imu"), 1U);
  for (const auto& observation : walk.observations)
    if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get()))
    {
      EXPECT_EQ(imu->get(mrpt::obs::IMU_X_ACC), 1.0);
      EXPECT_EQ(imu->get(mrpt::obs::IMU_WX), 4.0);
    }
  put("a/imu.csv", "some,other,table\n1,2,3\n");
  EXPECT_THROW((void)readRecording(folder_.file("a")), std::runtime_error);
}

TEST_F(Folders, ATableMayNameItsUnits)
{
  put("a/1.5.bin", binCloud(1));
  for (const auto& [gyro, accel] :
       {std::pair("deg/s", "g"), std::pair("dps", "g"), std::pair("deg s^-1", "G")})
  {
    const std::string w = std::string(" [") + gyro + "],", a = std::string(" (") + accel + "),";
    put("a/imu.csv", "time," + ("wx" + w) + ("wy" + w) + ("wz" + w) + ("ax" + a) + ("ay" + a) +
                         "az (" + accel + ")\n1.5,180,-90,0,0,0.5,1\n");
    const Recorded walk = readRecording(folder_.file("a"));
    ASSERT_EQ(walk.count("imu"), 1U);
    for (const auto& observation : walk.observations)
      if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get()))
      {
        EXPECT_NEAR(imu->get(mrpt::obs::IMU_WX), M_PI, 1e-12) << gyro;
        EXPECT_NEAR(imu->get(mrpt::obs::IMU_WY), -M_PI / 2.0, 1e-12) << gyro;
        EXPECT_NEAR(imu->get(mrpt::obs::IMU_Y_ACC), 0.5 * 9.80665, 1e-12) << accel;
      }
  }
}

// A map that was written among the clouds must not make them unreadable.
TEST_F(Folders, AFileWhoseNameIsNoTimeIsLeftOut)
{
  put("a/1.0.bin", binCloud(1));
  put("a/1.1.bin", binCloud(1));
  put("a/map.pcd", "no cloud");
  const Recorded walk = readRecording(folder_.file("a"));
  EXPECT_EQ(walk.count("lidar"), 2U);
  EXPECT_TRUE(walk.problems.empty());
}

TEST_F(Folders, NumbersOfFilesAndTimesMustAgree)
{
  put("a/clouds/000001.pcd", "");
  put("a/clouds/000002.pcd", "");
  put("a/times.txt", "1.0\n");
  EXPECT_THROW((void)readRecording(folder_.file("a")), std::runtime_error);
}

TEST_F(Folders, DamagedFilesCostThemselvesOnly)
{
  put("a/1.0.bin", binCloud(1));
  put("a/1.1.bin", binCloud(1).substr(1));
  put("a/1.2.bin", binCloud(1));
  const Recorded walk = readRecording(folder_.file("a"));
  EXPECT_EQ(walk.observations.size(), 2U);
  ASSERT_EQ(walk.problems.size(), 1U);
  EXPECT_TRUE(contains(walk.problems[0].message, "1.1.bin")) << walk.problems[0].message;
}

std::string pcdHead(const std::string& data)
{
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z intensity t ring\nSIZE 4 4 4 4 4 2\n"
         "TYPE F F F F U U\nCOUNT 1 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
         "POINTS 2\nDATA " +
         data + "\n";
}

TEST_F(Folders, PcdIsReadInEveryForm)
{
  const std::string ascii = pcdHead("ascii") + "1 2 3 0.5 0 7\n4 5 6 0.25 99000001 8\n";
  WireWriter records(Wire::Ros1), columns(Wire::Ros1);
  records.number(1.F).number(2.F).number(3.F).number(0.5F).number(0U).number(std::uint16_t{7});
  records.number(4.F).number(5.F).number(6.F).number(.25F).number(99000001U).number(
      std::uint16_t{8});
  for (const float value : {1.F, 4.F, 2.F, 5.F, 3.F, 6.F, 0.5F, 0.25F})
    columns.number(value);
  columns.number(0U).number(99000001U).number(std::uint16_t{7}).number(std::uint16_t{8});
  // A run of 32 bytes, and one of 12; both literal.
  const std::string plain = columns.bytes();
  ASSERT_EQ(plain.size(), 44U);
  const std::string packed =
      std::string(1, 31) + plain.substr(0, 32) + std::string(1, 11) + plain.substr(32);
  const std::string compressed = WireWriter(Wire::Ros1)
                                     .number(static_cast<std::uint32_t>(packed.size()))
                                     .number(std::uint32_t{44})
                                     .raw(packed)
                                     .bytes();
  for (const std::string& bytes :
       {ascii, pcdHead("binary") + records.bytes(), pcdHead("binary_compressed") + compressed})
  {
    const CloudColumns cloud = readPcdCloud(fileOf(bytes, "cloud.pcd"));
    EXPECT_EQ(cloud.x, (std::vector<float>{1, 4}));
    EXPECT_EQ(cloud.z, (std::vector<float>{3, 6}));
    EXPECT_EQ(cloud.intensity, (std::vector<float>{0.5F, 0.25F}));
    EXPECT_EQ(cloud.time, (std::vector<double>{0, 99'000'001}));
    EXPECT_EQ(cloud.ring, (std::vector<std::uint16_t>{7, 8}));
  }
}

TEST_F(Folders, PcdThatLiesIsRefused)
{
  const std::string points = std::string(44, '\1');
  std::string many = pcdHead("binary") + points;
  many.replace(many.find("POINTS 2"), 8, "POINTS 9");
  std::string huge = pcdHead("binary_compressed") + points;
  for (const std::string& bytes :
       {many, huge, pcdHead("ascii") + "1 2 3 0.5 0 7\n", std::string(), std::string("FIELDS\n"),
        pcdHead("xyz"), pcdHead("binary").substr(0, 60), std::string(100'000, 'x')})
    EXPECT_THROW((void)readPcdCloud(fileOf(bytes, "cloud.pcd")), std::runtime_error);
}
}  // namespace
