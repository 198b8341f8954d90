// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "rotating_scans.h"

#include "test_files.h"
#include <fastlio/sensors/conversions.h>

#include <cmath>

namespace fastlio::testing
{
using fastlio::toMrptTime;

/** Ranges of 5 m with a hole, in the order of a VLP-16's lasers. */
std::shared_ptr<Scan> rangeScan()
{
  auto scan = std::make_shared<Scan>();
  scan->sensorLabel = "lidar";
  scan->timestamp = toMrptTime(kStart);
  scan->rowCount = kRows;
  scan->columnCount = kColumns;
  scan->rangeResolution = 0.002;
  scan->startAzimuth = 0.5;
  scan->azimuthSpan = 6.0;
  scan->sweepDuration = 0.1;
  scan->lidarModel = "VLP-16";
  scan->sensorPose = mrpt::poses::CPose3D(1, 2, 3, 0, 0, 0);
  scan->rangeImage.setZero(kRows, kColumns);
  scan->intensityImage.setZero(kRows, kColumns);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
    {
      scan->rangeImage(row, column) = column == 7 ? 0 : 2500;
      scan->intensityImage(row, column) = static_cast<std::uint8_t>(column);
    }
  return scan;
}

/** The bytes before the images: the same in both layouts. */
std::string properties(const Scan& scan)
{
  const std::string native = serialize({std::make_shared<Scan>(scan)});
  std::string model;
  put(model, static_cast<std::uint32_t>(scan.lidarModel.size()));
  model += scan.lidarModel;
  const auto pose = native.find("CPose3D", native.find(model));
  // Behind the pose's end flag: stamp of reception, flag of satellite time.
  const auto end = native.find('\x88', pose + 7 + 1 + 12 * 8) + 1 + 8 + 1;
  return native.substr(0, end);
}

std::string images(const Scan& scan)
{
  std::string bytes;
  put(bytes, std::uint16_t{kColumns});
  put(bytes, std::uint16_t{kRows});
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      put(bytes, scan.rangeImage(row, column));
  put(bytes, std::uint16_t{kColumns});
  put(bytes, std::uint16_t{kRows});
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      put(bytes, scan.intensityImage(row, column));
  put(bytes, std::uint16_t{1});
  put(bytes, std::uint32_t{4});
  bytes += "LAST";
  bytes.append(std::size_t{2} * kRows * kColumns, '\0');
  return bytes;
}

/** Points on a cylinder, anticlockwise; column 7 is invalid. */
std::string points()
{
  std::string bytes;
  put(bytes, std::uint16_t{kColumns});
  put(bytes, std::uint16_t{kRows});
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
    {
      const double azimuth = 0.06 * column;
      const bool hole = column == 7;
      put(bytes, hole ? 0.0F : static_cast<float>(5.0 * std::cos(azimuth)));
      put(bytes, hole ? 0.0F : static_cast<float>(5.0 * std::sin(azimuth)));
      put(bytes, hole ? 0.0F : 0.1F * static_cast<float>(row));
    }
  return bytes;
}

std::string before2_11_4(const Scan& scan)
{
  return properties(scan) + images(scan) + '\x88';
}

std::string since2_11_4(const Scan& scan)
{
  return properties(scan) + '\0' + images(scan) + points() + '\x88';
}

}  // namespace fastlio::testing
