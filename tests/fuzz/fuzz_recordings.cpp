// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Recordings of other makers: containers, messages, captures, files of clouds.

#include "cloud_files.h"
#include "fuzz_targets.h"
#include <fastlio/messages/ros_types.h>
#include <fastlio/packets/ouster_metadata.h>
#include <fastlio/rawlog/recording_formats.h>
#include <fastlio/recordings/recording_reader.h>
#include <fastlio/sensors/point_cloud_conversion.h>

#include <mrpt/obs/CObservationPointCloud.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <unistd.h>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;

/** A file with a name, as SQLite and captures want one; gone with the object. */
class NamedFile
{
 public:
  NamedFile(const std::string& extension, const std::uint8_t* data, std::size_t size)
      : folder_(fs::temp_directory_path() / ("fastlio-fuzz-recording-" + std::to_string(getpid())))
  {
    fs::create_directories(folder_);
    path_ = (folder_ / ("recording" + extension)).string();
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  ~NamedFile()
  {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  NamedFile(const NamedFile&) = delete;
  NamedFile& operator=(const NamedFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  void putBeside(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_ / name) << text;
  }

 private:
  fs::path folder_;
  std::string path_;
};

void use(const mrpt::obs::CObservation& observation)
{
  const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
  if (cloud == nullptr || !cloud->pointcloud) return;
  (void)toTimedPoints(readColumns(*cloud->pointcloud), 0);
}

void readAll(const std::string& path)
{
  const RecordingFormat* format = recordingFormatOf(path);
  if (format == nullptr) return;
  std::unique_ptr<RecordingReader> reader;
  try
  {
    reader = format->open(path);
  }
  catch (const std::runtime_error&)
  {
    return;  // refused, with the reason
  }
  for (NextRecorded next = reader->next(); !std::holds_alternative<EndOfRecording>(next);
       next = reader->next())
    if (const auto* observation = std::get_if<mrpt::obs::CObservation::Ptr>(&next))
      use(**observation);
  (void)reader->topics();
  (void)reader->notes();
}
}  // namespace

void fuzzRecording(const std::uint8_t* data, std::size_t size)
{
  const NamedFile file(".bag", data, size);
  readAll(file.path());
}

void fuzzCapture(const std::uint8_t* data, std::size_t size)
{
  const NamedFile file(".pcap", data, size);
  file.putBeside(
      "recording.json",
      R"({"beam_altitude_angles":[1,0],"beam_azimuth_angles":[0,1],"data_format":)"
      R"({"columns_per_frame":64,"columns_per_packet":4,"pixels_per_column":2,)"
      R"("udp_profile_lidar":"RNG15_RFL8_NIR8_DUAL"}})");
  readAll(file.path());
}

void fuzzMessage(const std::uint8_t* data, std::size_t size)
{
  constexpr const char* kTypes[] = {
      "sensor_msgs/Imu",
      "sensor_msgs/PointCloud2",
      "livox_ros_driver/CustomMsg",
      "velodyne_msgs/VelodyneScan",
      "sensor_msgs/NavSatFix",
      "nav_msgs/Odometry"};
  if (size < 2) return;
  const WireFormat format = data[0] % 2 == 0 ? WireFormat::Ros1 : WireFormat::Cdr;
  try
  {
    WireReader in(data + 2, size - 2, format);
    if (data[1] % 8 < 6)
      use(*rosTypeOf(kTypes[data[1] % 8]).read(in, "label").observation);
    else
      (void)readTransforms(in);
  }
  catch (const std::runtime_error&)
  {
    // Refused, with the reason.
  }
}

void fuzzMetadata(const std::uint8_t* data, std::size_t size)
{
  try
  {
    if (parseOusterMetadata({reinterpret_cast<const char*>(data), size}).packetBytes() == 0)
      throw std::logic_error("packets of no bytes");
  }
  catch (const std::runtime_error&)
  {
    // Refused, with the reason.
  }
}

void fuzzCloudFile(const std::uint8_t* data, std::size_t size)
{
  const NamedFile file(".pcd", data, size);
  for (const auto read : {readPcdCloud, readBinCloud})
    try
    {
      const CloudColumns columns = read(file.path());
      if (columns.y.size() != columns.size()) throw std::logic_error("columns of different length");
    }
    catch (const std::runtime_error&)
    {
      // Refused, with the reason.
    }
}

}  // namespace fastlio::testing
