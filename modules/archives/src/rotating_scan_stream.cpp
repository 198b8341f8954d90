// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/archives/rotating_scan_stream.h>
#include <fastlio/compat/bounded_read.h>
#include <fastlio/math/little_endian.h>

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/stl_serialization.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace fastlio
{
namespace
{
using mrpt::serialization::CArchive;

constexpr const char* kName = "CObservationRotatingScan";
constexpr std::uint8_t kSerialized = 1, kText = 2;
// Of images in another file, whose lines may be few. No LiDAR has as many.
constexpr std::size_t kMostPixels = 16'000'000;

std::uint16_t shortAt(const std::array<std::uint8_t, 4>& bytes, std::size_t at)
{
  return littleAt<std::uint16_t>(bytes.data() + at);
}

struct Size
{
  std::uint16_t columns = 0, rows = 0;

  [[nodiscard]] std::size_t count() const { return std::size_t{columns} * rows; }
};

Size readSize(CArchive& in)
{
  Size size;
  size.columns = in.ReadAs<std::uint16_t>();
  size.rows = in.ReadAs<std::uint16_t>();
  return size;
}

template <typename Matrix>
void readImage(CArchive& in, const Size& size, Matrix& image)
{
  using Number = std::decay_t<decltype(image(0, 0))>;
  const auto numbers = readColumn<std::vector<Number>>(in, size.count(), kName);
  image.resize(size.rows, size.columns);
  if (!numbers.empty()) std::copy(numbers.begin(), numbers.end(), &image(0, 0));
}

void readImages(CArchive& in, const Size& size, RotatingScan& scan)
{
  readImage(in, size, scan.rangeImage);
  readImage(in, readSize(in), scan.intensityImage);
  scan.rangeOtherLayers.clear();
  const auto layers = in.ReadAs<std::uint16_t>();
  for (std::uint16_t i = 0; i < layers; ++i)
  {
    const std::string name = readText(in, kName);
    readImage(in, size, scan.rangeOtherLayers[name]);
  }
}

void readPoints(CArchive& in, RotatingScan& scan)
{
  const Size size = readSize(in);
  const auto numbers = readColumn<std::vector<float>>(in, 3 * size.count(), kName);
  const float* number = numbers.data();
#if FASTLIO_MRPT_HAS_ROTATING_POINTS
  scan.organizedPoints.resize(size.rows, size.columns);
  auto& points = scan.organizedPoints;
#else
  scan.points.resize(size.count());
  auto& points = scan.points;
#endif
  for (auto& point : points)
  {
    point.x = *number++;
    point.y = *number++;
    point.z = *number++;
  }
}

void setExternal(RotatingScan& scan, std::uint8_t format, const std::string& file)
{
  if (Size{scan.columnCount, scan.rowCount}.count() > kMostPixels)
    throw std::runtime_error(
        "CObservationRotatingScan: claims images of " + std::to_string(scan.columnCount) + " x " +
        std::to_string(scan.rowCount) + " pixels in a file of their own");
  if (format > kText)
    throw std::runtime_error(
        "CObservationRotatingScan: images are kept in format " + std::to_string(format) +
        ", which is not known.");
#if FASTLIO_MRPT_HAS_ROTATING_POINTS
  scan.setAsExternalStorage(
      file, static_cast<mrpt::obs::CObservationRotatingScan::ExternalStorageFormat>(format));
#else
  scan.external_format = format;
  scan.external_file = file;
#endif
}

/** The layout since 2.11.4, of which four bytes have been read. */
void readWithPrefix(CArchive& in, const std::array<std::uint8_t, 4>& bytes, RotatingScan& scan)
{
  const auto fifth = in.ReadAs<std::uint8_t>();
  if (bytes[0] != 0)
  {
    const std::size_t length =
        std::size_t{bytes[1]} | (std::size_t{bytes[2]} << 8U) | (std::size_t{bytes[3]} << 16U);
    if (fifth != 0) throw std::runtime_error("CObservationRotatingScan: absurd name of a file.");
    setExternal(scan, bytes[0], readColumn<std::string>(in, length, kName));
    return;
  }
  const Size size{shortAt(bytes, 1), static_cast<std::uint16_t>(bytes[3] | (fifth << 8U))};
  readImages(in, size, scan);
  readPoints(in, scan);
}

#if !FASTLIO_MRPT_HAS_ROTATING_POINTS
/** Lines of `x y z range intensity row column`. */
void loadText(RotatingScan& scan, const std::string& path)
{
  std::ifstream in(path);
  scan.rangeImage.setZero(scan.rowCount, scan.columnCount);
  scan.intensityImage.setZero(scan.rowCount, scan.columnCount);
  scan.points.assign(std::size_t{scan.rowCount} * scan.columnCount, {0, 0, 0});
  float x = 0, y = 0, z = 0;
  unsigned range = 0, intensity = 0, row = 0, column = 0;
  while (in >> x >> y >> z >> range >> intensity >> row >> column)
  {
    if (row >= scan.rowCount || column >= scan.columnCount)
      throw std::runtime_error(
          "row " + std::to_string(row) + " or column " + std::to_string(column) +
          " is outside of the scan");
    scan.rangeImage(row, column) = static_cast<std::uint16_t>(range);
    scan.intensityImage(row, column) = static_cast<std::uint8_t>(intensity);
    scan.points[std::size_t{row} * scan.columnCount + column] = {x, y, z};
  }
  if (!in.eof()) throw std::runtime_error("a line is not `x y z range intensity row column`");
}
#endif
}  // namespace

RotatingScanLayout layoutOf(
    const std::array<std::uint8_t, 4>& bytes, std::uint16_t rows, std::uint16_t columns)
{
  if (shortAt(bytes, 0) == columns && shortAt(bytes, 2) == rows) return RotatingScanLayout::Images;
  const bool external = bytes[0] == kSerialized || bytes[0] == kText;
  if (external || (bytes[0] == 0 && shortAt(bytes, 1) == columns))
    return RotatingScanLayout::StoragePrefix;
  return RotatingScanLayout::Neither;
}

std::shared_ptr<RotatingScan> readRotatingScan(CArchive& in)
{
  auto scan = std::make_shared<RotatingScan>();
  in >> scan->timestamp;
  scan->sensorLabel = readText(in, kName);
  in >> scan->rowCount >> scan->columnCount >> scan->rangeResolution >> scan->startAzimuth >>
      scan->azimuthSpan >> scan->sweepDuration;
  scan->lidarModel = readText(in, kName);
  in >> scan->minRange >> scan->maxRange >> scan->sensorPose >> scan->originalReceivedTimestamp;
  scan->has_satellite_timestamp = readFlag(in);
  std::array<std::uint8_t, 4> bytes{};
  in.ReadBuffer(bytes.data(), bytes.size());
  switch (layoutOf(bytes, scan->rowCount, scan->columnCount))
  {
    case RotatingScanLayout::Images:
      readImages(in, {shortAt(bytes, 0), shortAt(bytes, 2)}, *scan);
      return scan;
    case RotatingScanLayout::StoragePrefix:
      readWithPrefix(in, bytes, *scan);
      return scan;
    case RotatingScanLayout::Neither:
      break;
  }
  throw std::runtime_error(
      "CObservationRotatingScan: no image of the " + std::to_string(scan->columnCount) + " x " +
      std::to_string(scan->rowCount) + " pixels that it should have");
}

std::string externalFileOf(const RotatingScan& scan)
{
#if FASTLIO_MRPT_HAS_ROTATING_POINTS
  return scan.isExternallyStored() ? scan.getExternalStorageFile() : std::string();
#else
  return scan.external_file;
#endif
}

void loadRotatingScan(RotatingScan& scan, const std::string& path)
{
#if FASTLIO_MRPT_HAS_ROTATING_POINTS
  (void)path;  // MRPT looks for it in its base folder
  scan.load();
#else
  if (scan.external_format == kText) return loadText(scan, path);
  mrpt::io::CFileGZInputStream file(path);
  auto in = mrpt::serialization::archiveFrom(file);
  readImages(in, readSize(in), scan);
  readPoints(in, scan);
#endif
}

}  // namespace fastlio
