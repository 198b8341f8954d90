// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Messages one by one, in the three encodings.

#include "failure_message.h"
#include "recording_test_support.h"
#include "velodyne_packets.h"
#include <fastlio/messages/ros_messages.h>
#include <fastlio/messages/ros_types.h>
#include <fastlio/sensors/velodyne_decoder.h>

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/gnss_messages_novatel.h>

#include <cstring>
#include <limits>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

WireReader readerOf(const std::string& bytes, Wire wire)
{
  return {
      reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
      wire == Wire::Ros1 ? WireFormat::Ros1 : WireFormat::Cdr};
}

class MessageIn : public ::testing::TestWithParam<Wire>
{
 protected:
  RosObservation read(
      RosObservation (*reading)(WireReader&, const std::string&), const std::string& bytes) const
  {
    WireReader in = readerOf(bytes, GetParam());
    return reading(in, "label");
  }
};

INSTANTIATE_TEST_SUITE_P(
    Encodings, MessageIn, ::testing::Values(Wire::Ros1, Wire::Cdr, Wire::CdrBigEndian),
    [](const auto& instance)
    {
      return instance.param == Wire::Ros1  ? "Ros1"
             : instance.param == Wire::Cdr ? "Cdr"
                                           : "CdrBigEndian";
    });

TEST_P(MessageIn, AnImuKeepsStampRateAndAcceleration)
{
  const auto result =
      read(readImu, imuMessage(GetParam(), kStart + 123'456'700, {1, 2, 3}, {4, 5, 6}, "imu_link"));
  EXPECT_EQ(result.frame, "imu_link");
  const auto& imu = dynamic_cast<const mrpt::obs::CObservationIMU&>(*result.observation);
  EXPECT_EQ(imu.sensorLabel, "label");
  EXPECT_EQ(toNanoseconds(imu.timestamp), kStart + 123'456'700);
  EXPECT_EQ(imu.get(mrpt::obs::IMU_WY), 2.0);
  EXPECT_EQ(imu.get(mrpt::obs::IMU_Z_ACC), 6.0);
  EXPECT_FALSE(imu.has(mrpt::obs::IMU_ORI_QUAT_W));  // zeros are no orientation
}

TEST_P(MessageIn, ACloudKeepsEveryField)
{
  const auto result = read(readPointCloud2, cloudMessage(GetParam(), smallScan()));
  EXPECT_EQ(result.frame, "lidar");
  const CloudColumns columns = columnsOf(*result.observation);
  EXPECT_EQ(columns.x, (std::vector<float>{1.5F, -4.0F, 8.0F}));
  EXPECT_EQ(columns.z, (std::vector<float>{0.25F, 1.0F, -0.5F}));
  EXPECT_EQ(columns.intensity, (std::vector<float>{10, 20, 30}));
  EXPECT_EQ(columns.ring, (std::vector<std::uint16_t>{3, 7, 15}));
  EXPECT_EQ(columns.time, (std::vector<double>{0, 12'345'678, 99'000'001}));
  EXPECT_FALSE(columns.single_precision_time);
}

TEST_P(MessageIn, TimesOfEveryNameAndTypeArriveAsRecorded)
{
  for (const char* name : {"t", "time", "timestamp", "timeOffset", "offset_time", "time_stamp"})
  {
    const auto ns = read(readPointCloud2, cloudMessage(GetParam(), smallScan(), {name, 6}));
    EXPECT_EQ(columnsOf(*ns.observation).time[2], 99'000'001.0) << name;
    const auto s = read(readPointCloud2, cloudMessage(GetParam(), smallScan(), {name, 7, 1.0}));
    EXPECT_EQ(columnsOf(*s.observation).time[2], static_cast<double>(0.099000001F)) << name;
    EXPECT_TRUE(columnsOf(*s.observation).single_precision_time) << name;
    const auto date =
        read(readPointCloud2, cloudMessage(GetParam(), smallScan(), {name, 8, 1.0, true}));
    EXPECT_NEAR(columnsOf(*date.observation).time[2], 1.7e9 + 0.099, 1e-6) << name;
  }
  const auto none = read(readPointCloud2, cloudMessage(GetParam(), smallScan(), {""}));
  EXPECT_TRUE(columnsOf(*none.observation).time.empty());
}

TEST_P(MessageIn, LivoxTimesAreSecondsAfterTheStamp)
{
  const auto result = read(readLivoxCustom, livoxMessage(GetParam(), smallScan()));
  const CloudColumns columns = columnsOf(*result.observation);
  EXPECT_EQ(columns.time, (std::vector<double>{0, toSeconds(12'345'678), toSeconds(99'000'001)}));
  EXPECT_EQ(columns.y, (std::vector<float>{-2.0F, 2.5F, 0.5F}));
  EXPECT_EQ(columns.ring, (std::vector<std::uint16_t>{3, 7, 15}));
}

TEST_P(MessageIn, VelodynePacketsStayRaw)
{
  std::vector<std::string> packets;
  for (std::uint16_t i = 0; i < 3; ++i)
  {
    const Packet packet = makePacket(static_cast<std::uint16_t>(500 * i), 40, 1327U * i, 1000);
    packets.emplace_back(reinterpret_cast<const char*>(&packet), sizeof packet);
  }
  const auto result = read(readVelodyneScan, velodyneMessage(GetParam(), kStart, packets));
  const auto& scan = dynamic_cast<const mrpt::obs::CObservationVelodyneScan&>(*result.observation);
  EXPECT_EQ(scan.scan_packets.size(), 3U);
  EXPECT_EQ(toNanoseconds(scan.timestamp), kStart);
  EXPECT_EQ(scan.calibration.laser_corrections.size(), 16U);
  EXPECT_EQ(decodeVelodyne(scan).points.size(), 3U * 12 * 32);
}

TEST_P(MessageIn, FixesAndOdometryKeepTheirNumbers)
{
  WireWriter fix(GetParam());
  fix.header(kStart, "gps").number(std::int8_t{0}).number(std::uint16_t{1});
  fix.numbers({36.5, -4.25, 100.0}).numbers(std::vector<double>(9, 0.0)).number(std::uint8_t{0});
  const auto gps = read(readNavSatFix, fix.bytes());
  const auto& gga = dynamic_cast<const mrpt::obs::CObservationGPS&>(*gps.observation)
                        .getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>();
  // Copies: the struct is packed, and a reference to a member would not be aligned.
  EXPECT_EQ(double{gga.fields.latitude_degrees}, 36.5);
  EXPECT_EQ(double{gga.fields.longitude_degrees}, -4.25);
  EXPECT_EQ(gga.fields.fix_quality, 1);

  WireWriter wheels(GetParam());
  wheels.header(kStart, "odom").text("base_link");
  wheels.numbers({1, 2, 0}).numbers({0, 0, std::sqrt(0.5), std::sqrt(0.5)});
  wheels.numbers(std::vector<double>(36, 0.0)).numbers({0.5, 0, 0}).numbers({0, 0, 0.25});
  const auto odometry = read(readOdometry, wheels.bytes());
  const auto& planar = dynamic_cast<const mrpt::obs::CObservationOdometry&>(*odometry.observation);
  EXPECT_EQ(planar.odometry.y(), 2.0);
  EXPECT_NEAR(planar.odometry.phi(), M_PI / 2, 1e-12);
  EXPECT_EQ(planar.velocityLocal.omega, 0.25);
}

TEST_P(MessageIn, AFixBeforeTheEpochHasATimeOfDay)
{
  if (GetParam() == Wire::Ros1) return;  // its seconds have no sign
  WireWriter fix(GetParam());
  fix.header(kStart, "gps").number(std::int8_t{0}).number(std::uint16_t{1});
  fix.numbers({36.5, -4.25, 100.0}).numbers(std::vector<double>(9, 0.0)).number(std::uint8_t{0});
  std::string bytes = fix.bytes();
  const std::int32_t before = -3600;  // 23:00 of the day before
  for (std::size_t i = 0; i < sizeof before; ++i)
  {
    const std::size_t at = GetParam() == Wire::CdrBigEndian ? sizeof before - 1 - i : i;
    bytes[4 + at] = static_cast<char>(static_cast<std::uint32_t>(before) >> (8 * i));
  }
  const auto gps = read(readNavSatFix, bytes);
  const auto& gga = dynamic_cast<const mrpt::obs::CObservationGPS&>(*gps.observation)
                        .getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>();
  EXPECT_EQ(gga.fields.UTCTime.hour, 23);
}

TEST_P(MessageIn, PosesOfNumbersThatAreNotFiniteAreNotTaken)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto transform = [](WireWriter& out, const char* child, const std::vector<double>& numbers)
  { out.header(0, "base_link").text(child).numbers(numbers); };
  WireWriter tf(GetParam());
  tf.number(std::uint32_t{3});
  transform(tf, "place", {nan, 0, 0, 0, 0, 0, 1});
  transform(tf, "turn", {0, 0, 0, 0, 0, nan, 1});
  transform(tf, "imu", {1, 2, 3, 0, 0, 0, 1});
  const std::string bytes = tf.bytes();
  WireReader in = readerOf(bytes, GetParam());
  const auto transforms = readTransforms(in);
  ASSERT_EQ(transforms.size(), 1U);
  EXPECT_EQ(transforms[0].child, "imu");

  WireWriter wheels(GetParam());
  wheels.header(kStart, "odom").text("base_link").numbers({1, nan, 0, 0, 0, 0, 1});
  wheels.numbers(std::vector<double>(36, 0.0)).numbers({0.5, 0, 0, 0, 0, 0.25});
  EXPECT_THROW((void)read(readOdometry, wheels.bytes()), std::runtime_error);
}

TEST_P(MessageIn, EveryCutMessageIsRefused)
{
  const std::string whole = cloudMessage(GetParam(), smallScan());
  for (std::size_t size = 0; size + 1 < whole.size(); ++size)  // the last byte is not read
    EXPECT_THROW((void)read(readPointCloud2, whole.substr(0, size)), std::runtime_error) << size;
  const std::string imu = imuMessage(GetParam(), kStart, {1, 2, 3}, {4, 5, 6});
  for (std::size_t size = 0; size < imu.size(); ++size)
    EXPECT_THROW((void)read(readImu, imu.substr(0, size)), std::runtime_error) << size;
}

TEST(Messages, CloudsThatLieAboutTheirSizeAreRefused)
{
  const std::string honest = cloudMessage(Wire::Ros1, smallScan());
  const std::size_t height = honest.find("lidar") + 5;
  for (const std::size_t at : {height, height + 4})  // height, width
    for (const std::uint32_t lie : {4U, 1'000'000U, std::numeric_limits<std::uint32_t>::max()})
    {
      std::string lying = honest;
      std::memcpy(lying.data() + at, &lie, sizeof lie);
      WireReader in = readerOf(lying, Wire::Ros1);
      EXPECT_THROW((void)readPointCloud2(in, ""), std::runtime_error) << at << ' ' << lie;
    }
}

TEST(Messages, OtherEncodingsOfDdsAreNamed)
{
  const std::string parameter_list("\0\3\0\0 and more", 13);
  const std::string refusal = failureOf([&] { (void)readerOf(parameter_list, Wire::Cdr); });
  EXPECT_NE(refusal.find("0/3"), std::string::npos) << refusal;
}

TEST(Messages, TypesHaveThreeSpellings)
{
  for (const char* type :
       {"sensor_msgs/Imu", "sensor_msgs/msg/Imu", "sensor_msgs::msg::dds_::Imu_"})
    EXPECT_EQ(rosTypeOf(type).read, readImu) << type;
  EXPECT_EQ(rosTypeOf("sensor_msgs/Image").read, nullptr);
  EXPECT_EQ(rosTypeOf("").read, nullptr);
}
}  // namespace
