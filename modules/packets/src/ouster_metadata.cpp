// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/options/printable.h>
#include <fastlio/packets/ouster_metadata.h>
#include <fastlio/recordings/byte_source.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace fastlio
{
namespace
{
using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::uint32_t k15Bits = 0x7FFF, k19Bits = 0x7FFFF, k20Bits = 0xFFFFF;
constexpr std::array<OusterProfile, 12> kProfiles{{
    {"LEGACY", 12, k20Bits, 0, 4, 0},
    {"RNG19_RFL8_SIG16_NIR16", 12, k19Bits, 0, 4, 0},
    {"RNG19_RFL8_SIG16_NIR16_DUAL", 16, k19Bits, 0, 3, 4, 7},
    {"RNG15_RFL8_NIR8", 4, k15Bits, 3, 2, 0},
    {"RNG15_RFL8_NIR8_DUAL", 8, k15Bits, 3, 2, 4, 6},
    {"FUSA_RNG15_RFL8_NIR8_DUAL", 8, k15Bits, 3, 2, 4, 6},
    {"FIVE_WORD_PIXEL", 20, k19Bits, 0, 3, 4, 7},
    {"RNG15_RFL8_NIR8_ZONE16", 8, k15Bits, 3, 2, 0},
    {"RNG19_RFL8_SIG16_NIR16_ZONE16", 12, k19Bits, 0, 4, 0},
    {"RNG15_RFL8_WIN8", 4, k15Bits, 3, 2, 0},
    {"RNG19_RFL8_SIG16_NIR16_RGB16", 16, k19Bits, 0, 3, 0},
    {"RNG19_RFL8_SIG16_NIR16_RGB16_DUAL", 20, k19Bits, 0, 3, 4, 7},
}};

OusterProfile profileOf(const std::string& name)
{
  for (const OusterProfile& profile : kProfiles)
    if (profile.name == name) return profile;
  throw std::runtime_error("the profile '" + printable(name) + "' of its packets is not known");
}

/** The part of that name; in older metadata everything is at the top. */
const Json& part(const Json& all, const char* name)
{
  const auto found = all.find(name);
  return found != all.end() && found->is_object() ? *found : all;
}

std::vector<double> anglesOf(const Json& beams, const char* name)
{
  std::vector<double> angles = beams.at(name).get<std::vector<double>>();
  for (double& angle : angles)
    angle *= kRadPerDeg;
  return angles;
}

/** Row by row, in millimetres; absent: the identity. */
Pose poseIn(const Json& object, const char* name)
{
  Pose pose;
  const auto found = object.find(name);
  if (found == object.end()) return pose;
  const auto numbers = found->get<std::array<double, 16>>();
  using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Matrix T = Eigen::Map<const Matrix>(numbers.data());
  pose.R = T.topLeftCorner<3, 3>();
  pose.p = 1e-3 * T.topRightCorner<3, 1>();
  if (!(pose.R * pose.R.transpose()).isIdentity(1e-3))
    throw std::runtime_error(std::string(name) + " is no rotation");
  return pose;
}

/** "1024x10": the columns. */
std::size_t columnsOf(const Json& all)
{
  const Json& config = part(all, "config_params");
  const std::string mode = config.at("lidar_mode").get<std::string>();
  return std::stoul(mode.substr(0, mode.find('x')));
}

void readFormat(const Json& all, OusterMetadata& metadata)
{
  const bool nested = all.contains("lidar_data_format");
  const char* name = nested ? "lidar_data_format" : "data_format";
  metadata.pixels = metadata.altitude.size();
  metadata.columns_per_packet = 16;
  if (!all.contains(name))
  {
    metadata.columns_per_frame = columnsOf(all);
    metadata.profile = profileOf("LEGACY");
    return;
  }
  const Json& format = all.at(name);
  metadata.columns_per_frame = format.at("columns_per_frame").get<std::size_t>();
  metadata.columns_per_packet = format.at("columns_per_packet").get<std::size_t>();
  metadata.pixels = format.at("pixels_per_column").get<std::size_t>();
  metadata.profile = profileOf(format.value("udp_profile_lidar", "LEGACY"));
}

void readBeams(const Json& all, OusterMetadata& metadata)
{
  const Json& beams = part(all, "beam_intrinsics");
  metadata.altitude = anglesOf(beams, "beam_altitude_angles");
  metadata.azimuth = anglesOf(beams, "beam_azimuth_angles");
  if (beams.contains("beam_to_lidar_transform"))
    metadata.beam_origin = poseIn(beams, "beam_to_lidar_transform").p;
  else
    metadata.beam_origin.x() = 1e-3 * beams.value("lidar_origin_to_beam_origin_mm", 0.0);
}

/** The profile of the IMU stands beside that of the LiDAR, or in the configuration. */
void readImuFormat(const Json& all, OusterMetadata& metadata)
{
  const Json& format = part(all, "lidar_data_format");
  const Json& config = part(all, "config_params");
  const std::string profile =
      format.value("udp_profile_imu", config.value("udp_profile_imu", "LEGACY"));
  if (profile == "LEGACY") return;
  if (profile == "ACCEL32_GYRO32_NMEA" && all.contains("imu_data_format"))
    metadata.imu_samples =
        all.at("imu_data_format").value("imu_measurements_per_packet", std::size_t{0});
  if (metadata.imu_samples == 0) metadata.unread_imu = profile;
}

void requireSane(const OusterMetadata& metadata)
{
  constexpr std::size_t kMostPixels = 1024, kMostColumns = 65536, kMostPerPacket = 1024;
  const auto within = [](std::size_t n, std::size_t most) { return n > 0 && n <= most; };
  if (metadata.imu_samples > kMostPerPacket || !within(metadata.pixels, kMostPixels) ||
      !within(metadata.columns_per_frame, kMostColumns) ||
      !within(metadata.columns_per_packet, kMostPerPacket))
    throw std::runtime_error("its numbers of pixels or columns make no sense");
  if (metadata.altitude.size() != metadata.pixels || metadata.azimuth.size() != metadata.pixels)
    throw std::runtime_error("it does not have an angle for each beam");
}

std::optional<std::string> jsonText(const fs::path& path)
{
  constexpr std::size_t kLargestMetadata = std::size_t{4} << 20U;
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > kLargestMetadata)
    return std::nullopt;
  return headOf(path.string(), kLargestMetadata);
}

/** The only one of the folder. */
std::optional<OusterMetadata> onlyMetadataIn(const fs::path& folder)
{
  constexpr std::size_t kMostFiles = 1000;
  std::optional<OusterMetadata> metadata;
  std::error_code error;
  std::size_t files = 0;
  for (fs::directory_iterator it(folder, error), end; !error && it != end && files < kMostFiles;
       it.increment(error), ++files)
  {
    if (it->path().extension() != ".json") continue;
    const auto text = jsonText(it->path());
    if (!text) continue;
    try
    {
      OusterMetadata found = parseOusterMetadata(*text);
      if (metadata)
        throw std::invalid_argument(
            "several files beside the recording are metadata of an Ouster; give the right one the "
            "name of the recording, with the ending .json");
      metadata = std::move(found);
    }
    catch (const std::runtime_error&)
    {
      // JSON of something else.
    }
  }
  return metadata;
}
}  // namespace

std::size_t OusterMetadata::packetBytes() const
{
  constexpr std::size_t kColumnHead = 16, kColumnFoot = 4;    // legacy
  constexpr std::size_t kHead = 32, kFoot = 32, kShort = 12;  // of the others
  const std::size_t column = pixels * profile.bytes;
  if (isLegacy()) return columns_per_packet * (kColumnHead + column + kColumnFoot);
  return kHead + columns_per_packet * (kShort + column) + kFoot;
}

std::size_t OusterMetadata::imuBytes() const
{
  constexpr std::size_t kLegacy = 48, kFoot = 32;
  if (!unread_imu.empty()) return 0;
  if (imu_samples == 0) return kLegacy;
  return kOusterImuHead + imu_samples * kOusterSampleBytes + kFoot;
}

OusterMetadata parseOusterMetadata(const std::string& text)
try
{
  const Json all = Json::parse(text);
  OusterMetadata metadata;
  readBeams(all, metadata);
  readFormat(all, metadata);
  readImuFormat(all, metadata);
  requireSane(metadata);
  metadata.T_sensor_lidar = poseIn(part(all, "lidar_intrinsics"), "lidar_to_sensor_transform");
  metadata.T_sensor_imu = poseIn(part(all, "imu_intrinsics"), "imu_to_sensor_transform");
  const Json& config = part(all, "config_params");
  metadata.lidar_port = config.value("udp_port_lidar", std::uint16_t{0});
  metadata.imu_port = config.value("udp_port_imu", std::uint16_t{0});
  return metadata;
}
catch (const Json::exception& e)
{
  throw std::runtime_error("it is no metadata of an Ouster: " + printable(e.what()));
}
catch (const std::logic_error& e)
{
  throw std::runtime_error("it is no metadata of an Ouster: " + printable(e.what()));
}

std::optional<OusterMetadata> ousterMetadataBeside(const std::string& capture)
{
  const fs::path path(capture);
  const std::string stem = (path.parent_path() / path.stem()).string();
  for (const std::string& name : {stem + ".json", stem + "_0.json", capture + ".json"})
    if (const auto text = jsonText(name))
    {
      try
      {
        return parseOusterMetadata(*text);
      }
      catch (const std::runtime_error& e)
      {
        throw std::runtime_error("'" + name + "': " + e.what());
      }
    }
  try
  {
    return onlyMetadataIn(path.has_parent_path() ? path.parent_path() : fs::path("."));
  }
  catch (const std::invalid_argument& e)
  {
    throw std::runtime_error(e.what());
  }
}

}  // namespace fastlio
