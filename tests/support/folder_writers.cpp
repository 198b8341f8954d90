// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "folder_writers.h"

#include "wire_writer.h"
#include <fastlio/options/number_text.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/imu_conversion.h>

#include <mrpt/core/format.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstring>
#include <ctime>
#include <optional>

namespace fastlio::testing
{
namespace
{
std::optional<ImuSample> sampleOf(const Object& object)
{
  const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(object.get());
  return imu == nullptr ? std::nullopt : toImuSample(*imu).sample;
}

bool isCloud(const Object& object)
{
  return dynamic_cast<const mrpt::obs::CObservationPointCloud*>(object.get()) != nullptr;
}

std::string pcdOf(const PointColumns& points)
{
  WireWriter out(Wire::Ros1);
  for (std::size_t i = 0; i < points.size(); ++i)
    out.number(points.x[i])
        .number(points.y[i])
        .number(points.z[i])
        .number(points.intensity[i])
        .number(static_cast<std::uint32_t>(points.time_offset_ns[i]))
        .number(points.ring[i]);
  const std::string n = std::to_string(points.size());
  return "VERSION 0.7\nFIELDS x y z intensity t ring\nSIZE 4 4 4 4 4 2\nTYPE F F F F U U\n"
         "COUNT 1 1 1 1 1 1\nWIDTH " +
         n + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA binary\n" + out.bytes();
}

std::string binOf(const PointColumns& points)
{
  WireWriter out(Wire::Ros1);
  for (std::size_t i = 0; i < points.size(); ++i)
    out.number(points.x[i]).number(points.y[i]).number(points.z[i]).number(points.intensity[i]);
  return out.bytes();
}

std::string dateOf(std::int64_t stamp_ns)
{
  const std::time_t seconds = stamp_ns / 1'000'000'000;
  std::tm date{};
  gmtime_r(&seconds, &date);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &date);
  return mrpt::format("%s.%09lld\n", text, static_cast<long long>(stamp_ns % 1'000'000'000));
}

/** The 30 numbers of a sample. */
std::string oxtsOf(const ImuSample& sample)
{
  std::string text;
  for (int i = 0; i < 30; ++i)
  {
    const double value = i >= 11 && i < 14   ? sample.accel[i - 11]
                         : i >= 17 && i < 20 ? sample.gyro[i - 17]
                                             : 0.0;
    text += roundTripText(value) + " ";
  }
  return text;
}
}  // namespace

std::string imuTableOf(const std::vector<Object>& objects)
{
  std::string text;
  for (const Object& object : objects)
    if (const auto sample = sampleOf(object))
    {
      text += std::to_string(sample->stamp_ns);
      for (const Vec3& values : {sample->gyro, sample->accel})
        for (int i = 0; i < 3; ++i)
          text += "," + roundTripText(values[i]);
      text += "\n";
    }
  return text;
}

std::vector<SentPacket> packetsOf(const std::vector<Object>& objects)
{
  std::vector<SentPacket> packets;
  for (const Object& object : objects)
  {
    const auto* scan = dynamic_cast<const mrpt::obs::CObservationVelodyneScan*>(object.get());
    if (scan == nullptr) continue;
    const auto timeOf = [](const auto& packet)
    {
      std::uint32_t microseconds = 0;  // MRPT's accessor wants it aligned
      std::memcpy(
          &microseconds, reinterpret_cast<const char*>(&packet) + 1200, sizeof microseconds);
      return std::int64_t{microseconds} * 1000;
    };
    for (const auto& packet : scan->scan_packets)
      packets.push_back(
          {toNanoseconds(scan->timestamp) + timeOf(packet) - timeOf(scan->scan_packets.front()),
           2368, std::string(reinterpret_cast<const char*>(&packet), sizeof packet)});
  }
  return packets;
}

void writePcdFolder(const std::string& folder, const std::vector<Object>& objects)
{
  std::filesystem::create_directories(folder + "/clouds");
  write(folder + "/imu.csv", imuTableOf(objects));
  for (const Object& object : objects)
    if (isCloud(object))
    {
      const LidarScan scan = scanOf(*object);
      write(folder + "/clouds/" + secondsText(scan.stamp_ns) + ".pcd", pcdOf(scan.points));
    }
}

void writeKittiDrive(const std::string& folder, const std::vector<Object>& objects)
{
  std::filesystem::create_directories(folder + "/velodyne_points/data");
  std::filesystem::create_directories(folder + "/oxts/data");
  std::string cloud_times, sample_times;
  int clouds = 0, samples = 0;
  for (const Object& object : objects)
    if (const auto sample = sampleOf(object))
    {
      sample_times += dateOf(sample->stamp_ns);
      write(folder + mrpt::format("/oxts/data/%010i.txt", samples++), oxtsOf(*sample));
    }
    else if (isCloud(object))
    {
      const LidarScan scan = scanOf(*object);
      cloud_times += dateOf(scan.stamp_ns);
      write(folder + mrpt::format("/velodyne_points/data/%010i.bin", clouds++), binOf(scan.points));
    }
  write(folder + "/velodyne_points/timestamps.txt", cloud_times);
  write(folder + "/oxts/timestamps.txt", sample_times);
}

}  // namespace fastlio::testing
