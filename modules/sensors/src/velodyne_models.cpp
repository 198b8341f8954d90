// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "velodyne_models.h"

#include <fastlio/math/angles.h>
#include <fastlio/sensors/velodyne_decoder.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <string>

namespace
{
using fastlio::kRadPerDeg;
using fastlio::LaserGeometry;
using fastlio::VelodyneModel;
using Correction = mrpt::obs::VelodyneCalibration::PerLaserCalib;

constexpr std::size_t kLasersHdl64e = 64;

// Elevation [deg] and vertical offset of the emitter [mm] in firing order (VLP-16 user manual,
// table of vertical angles).
struct PuckLaser
{
  double elevation_deg, offset_mm;
};

constexpr std::array<PuckLaser, 16> kVlp16{
    {{-15, 11.2},
     {1, -0.7},
     {-13, 9.7},
     {3, -2.2},
     {-11, 8.1},
     {5, -3.7},
     {-9, 6.6},
     {7, -5.1},
     {-7, 5.1},
     {9, -6.6},
     {-5, 3.7},
     {11, -8.1},
     {-3, 2.2},
     {13, -9.7},
     {-1, 0.7},
     {15, -11.2}}};

constexpr std::array<PuckLaser, 16> kPuckHiRes{
    {{-10, 7.4},
     {0.67, -0.9},
     {-8.67, 6.5},
     {2, -1.8},
     {-7.33, 5.5},
     {3.33, -2.7},
     {-6, 4.6},
     {4.67, -3.7},
     {-4.67, 3.7},
     {6, -4.6},
     {-3.33, 2.7},
     {7.33, -5.5},
     {-2, 1.8},
     {8.67, -6.5},
     {-0.67, 0.9},
     {10, -7.4}}};

// Even lasers of the HDL-32E are its lower half, odd ones its upper half, 4/3 degrees apart.
constexpr std::size_t kLasersHdl32e = 32;
constexpr double kHdl32eLowestDeg = -30.67, kHdl32eOddLowestDeg = -9.33, kHdl32eStepDeg = 4.0 / 3.0;

LaserGeometry laserAt(double elevation_deg, double offset_z)
{
  LaserGeometry laser;
  laser.sin_elevation = std::sin(elevation_deg * kRadPerDeg);
  laser.cos_elevation = std::cos(elevation_deg * kRadPerDeg);
  laser.offset_z = offset_z;
  return laser;
}

std::vector<LaserGeometry> fromTable(const std::array<PuckLaser, 16>& table)
{
  std::vector<LaserGeometry> lasers;
  lasers.reserve(table.size());
  for (const PuckLaser& entry : table)
    lasers.push_back(laserAt(entry.elevation_deg, 1e-3 * entry.offset_mm));
  return lasers;
}

std::vector<LaserGeometry> hdl32eLasers()
{
  std::vector<LaserGeometry> lasers;
  for (std::size_t i = 0; i < kLasersHdl32e; ++i)
  {
    const double lowest = i % 2 == 0 ? kHdl32eLowestDeg : kHdl32eOddLowestDeg;
    const std::size_t steps = i / 2;
    lasers.push_back(laserAt(lowest + kHdl32eStepDeg * static_cast<double>(steps), 0.0));
  }
  return lasers;
}

std::vector<LaserGeometry> defaultLasers(VelodyneModel model)
{
  switch (model)
  {
    case VelodyneModel::Vlp16:
      return fromTable(kVlp16);
    case VelodyneModel::PuckHiRes:
      return fromTable(kPuckHiRes);
    case VelodyneModel::Hdl32e:
      return hdl32eLasers();
    case VelodyneModel::Hdl64e:
      break;
  }
  throw std::runtime_error(
      "HDL-64E: the observation holds no calibration of 64 lasers, and each sensor has its own. "
      "Record with the calibration file of the sensor.");
}

// Calibration files give angles in degrees (XML) or radians (YAML); the sine next to the angle
// decides.
double radiansPerUnit(const std::vector<Correction>& corrections)
{
  double error_degrees = 0, error_radians = 0;
  for (const Correction& c : corrections)
  {
    error_degrees += std::abs(std::sin(c.verticalCorrection * kRadPerDeg) - c.sinVertCorrection);
    error_radians += std::abs(std::sin(c.verticalCorrection) - c.sinVertCorrection);
  }
  return error_degrees <= error_radians ? kRadPerDeg : 1.0;
}

// The emitters of the HDL-64E are offset across their beams, those of the others along the rotor's
// axis.
LaserGeometry fromCorrection(const Correction& c, double radians_per_unit, VelodyneModel model)
{
  LaserGeometry laser;
  laser.sin_elevation = c.sinVertCorrection;
  laser.cos_elevation = c.cosVertCorrection;
  laser.azimuth_correction = c.azimuthCorrection * radians_per_unit;
  laser.distance_correction = c.distanceCorrection;
  laser.horizontal_offset = c.horizontalOffsetCorrection;
  const bool across = model == VelodyneModel::Hdl64e;
  laser.offset_xy = across ? -c.verticalOffsetCorrection * c.sinVertCorrection : 0.0;
  laser.offset_z = c.verticalOffsetCorrection * (across ? c.cosVertCorrection : 1.0);
  return laser;
}

// Also false for what is not a number.
bool isPlausible(const LaserGeometry& laser)
{
  constexpr double kLargestOffset = 10.0;  // [m]
  return std::abs(laser.sin_elevation) <= 1.0 && std::abs(laser.cos_elevation) <= 1.0 &&
         std::isfinite(laser.azimuth_correction) &&
         std::abs(laser.distance_correction) < kLargestOffset &&
         std::abs(laser.horizontal_offset) < kLargestOffset &&
         std::abs(laser.offset_xy) < kLargestOffset && std::abs(laser.offset_z) < kLargestOffset;
}

void rankByElevation(std::vector<LaserGeometry>& lasers)
{
  for (LaserGeometry& laser : lasers)
    laser.ring = static_cast<std::uint16_t>(std::count_if(
        lasers.begin(), lasers.end(),
        [&](const LaserGeometry& other) { return other.sin_elevation < laser.sin_elevation; }));
}

std::optional<VelodyneModel> modelOfByte(std::uint8_t byte)
{
  switch (byte)
  {
    case 0x21:
      return VelodyneModel::Hdl32e;
    case 0x22:
      return VelodyneModel::Vlp16;  // also Puck LITE
    case 0x24:
      return VelodyneModel::PuckHiRes;
    default:
      return std::nullopt;
  }
}
}  // namespace

namespace fastlio
{
const char* nameOf(VelodyneModel model)
{
  switch (model)
  {
    case VelodyneModel::Vlp16:
      return "VLP-16";
    case VelodyneModel::PuckHiRes:
      return "Puck Hi-Res";
    case VelodyneModel::Hdl32e:
      return "HDL-32E";
    case VelodyneModel::Hdl64e:
      return "HDL-64E";
  }
  return "unknown";
}

std::optional<VelodyneModel> modelOf(const mrpt::obs::CObservationVelodyneScan& scan)
{
  // The two last bytes of HDL-64E packets are a status channel, not mode and model.
  const std::size_t calibrated = scan.calibration.laser_corrections.size();
  if (calibrated == kLasersHdl64e) return VelodyneModel::Hdl64e;
  for (const auto& packet : scan.scan_packets)
    if (const auto model = modelOfByte(packet.velodyne_model_ID)) return model;
  if (calibrated == kLasersHdl32e) return VelodyneModel::Hdl32e;
  if (calibrated == kVlp16.size()) return VelodyneModel::Vlp16;
  return std::nullopt;
}

mrpt::obs::VelodyneCalibration defaultVelodyneCalibration(const std::string& model)
{
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  return mrpt::obs::VelodyneCalibration::LoadDefaultCalibration(model);
}

FiringTiming timingOf(VelodyneModel model)
{
  switch (model)
  {
    case VelodyneModel::Hdl32e:
      return {32, 1, 1.152, 46.08, 46.08};
    // 32 lasers of each bank within 48 us, both banks at once.
    case VelodyneModel::Hdl64e:
      return {32, 2, 1.5, 48.0, 48.0};
    case VelodyneModel::Vlp16:
    case VelodyneModel::PuckHiRes:
      break;
  }
  return {16, 1, 2.304, 55.296, 110.592};
}

std::vector<LaserGeometry> lasersOf(
    VelodyneModel model, const mrpt::obs::VelodyneCalibration& calibration)
{
  const FiringTiming timing = timingOf(model);
  const auto& corrections = calibration.laser_corrections;
  std::vector<LaserGeometry> lasers;
  if (corrections.size() == timing.lasers_per_sequence * timing.blocks_at_once)
  {
    const double radians_per_unit = radiansPerUnit(corrections);
    for (const Correction& c : corrections)
      lasers.push_back(fromCorrection(c, radians_per_unit, model));
    if (!std::all_of(lasers.begin(), lasers.end(), isPlausible))
      throw std::runtime_error(
          std::string(nameOf(model)) +
          ": the calibration in the observation holds impossible values; the recording is "
          "corrupt.");
  }
  else
  {
    lasers = defaultLasers(model);
  }
  rankByElevation(lasers);
  return lasers;
}

}  // namespace fastlio
