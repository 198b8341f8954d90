// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "las_bytes.h"
#include <fastlio/earth/gps_time.h>
#include <fastlio/earth/las_writer.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr double kMetresOfOffset = 1000.0;

bool endsInLaz(const std::string& path)
{
  const std::string_view end = ".laz";
  return path.size() >= end.size() &&
         std::equal(
             end.begin(), end.end(), path.end() - static_cast<std::ptrdiff_t>(end.size()),
             [](char a, char b) { return a == b || (b >= 'A' && b <= 'Z' && a == b - 'A' + 'a'); });
}

const std::string& uncompressed(const std::string& path)
{
  if (endsInLaz(path))
    throw std::invalid_argument(
        "'" + printable(path) +
        "' is to be compressed (LAZ), which is not built in; write a .las file, and compress it "
        "with laszip or PDAL");
  return path;
}

void requireWritable(const LasOptions& options)
{
  const auto refuse = [](const std::string& what) { throw std::invalid_argument("LAS: " + what); };
  if (!std::isfinite(options.intensity_scale) || options.intensity_scale < 0)
    refuse(
        "intensities times " + shortestText(options.intensity_scale) + "; give a factor above 0");
  if (options.wkt.size() > kLongestLasWkt || options.wkt.find('\0') != std::string::npos)
    refuse(
        "a reference system of " + std::to_string(options.wkt.size()) +
        " bytes of WKT; the format holds " + std::to_string(kLongestLasWkt) + ", without zeros");
}

std::uint16_t sixteenBits(double intensity)
{
  constexpr double most = std::numeric_limits<std::uint16_t>::max();
  if (!(intensity > 0)) return 0;  // also not-a-number
  return static_cast<std::uint16_t>(std::lround(std::min(intensity, most)));
}
}  // namespace

LasWriter::LasWriter(const std::string& path, LasOptions options)
    : options_(std::move(options)), file_(uncompressed(path))
{
  requireWritable(options_);
  if (!file_.isRewritable())
    throw std::runtime_error(
        "cannot write '" + printable(path) +
        "' as LAS: its header is completed in the end, which a pipe or a device cannot; give a "
        "file");
  file_.write(header());
  if (!options_.wkt.empty()) file_.write(lasWktRecord(options_.wkt));
}

void LasWriter::add(const LasPoint& point)
{
  if (count_ == 0 && point.position.allFinite())
    offset_ = (point.position / kMetresOfOffset).array().floor() * kMetresOfOffset;
  const Steps steps = stepsOf(point.position);
  for (std::size_t axis = 0; axis < steps.size(); ++axis)
  {
    least_[axis] = count_ == 0 ? steps[axis] : std::min(least_[axis], steps[axis]);
    most_[axis] = count_ == 0 ? steps[axis] : std::max(most_[axis], steps[axis]);
  }
  record_.clear();
  LasBytes(record_)
      .number(steps[0])
      .number(steps[1])
      .number(steps[2])
      .number(sixteenBits(static_cast<double>(point.intensity) * options_.intensity_scale))
      .number(kLasOneOfOneReturns)
      .zeros(5)  // flags, classification, user data, scan angle
      .zeros(2)  // source
      .number(adjustedGpsTime(point.stamp_ns));
  is_whole_ = false;
  file_.write(record_);
  is_whole_ = true;
  latest_stamp_ns_ = std::max(latest_stamp_ns_, point.stamp_ns);
  ++count_;
}

LasWriter::Steps LasWriter::stepsOf(const Vec3& position) const
{
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  Steps steps = {};
  for (int axis = 0; axis < 3; ++axis)
  {
    const double step = std::round((position[axis] - offset_[axis]) / kLasStep);
    if (!(std::abs(step) <= most))
      throw std::runtime_error(
          "LAS: the point number " + std::to_string(count_ + 1) + " at (" +
          shortestText(position.x()) + ", " + shortestText(position.y()) + ", " +
          shortestText(position.z()) + ") m does not fit: coordinates reach " +
          shortestText(std::floor(most * kLasStep)) + " m from the offset (" +
          shortestText(offset_.x()) + ", " + shortestText(offset_.y()) + ", " +
          shortestText(offset_.z()) + ") at steps of " + shortestText(kLasStep) +
          " m; remove the point, or split the map");
    steps[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(step);
  }
  return steps;
}

double LasWriter::coordinateOf(int axis, std::int32_t steps) const
{
  return static_cast<double>(steps) * kLasStep + offset_[axis];
}

std::string LasWriter::header() const
{
  LasHeader header;
  header.wkt_bytes = options_.wkt.size();
  header.offset = offset_;
  header.points = count_;
  header.day_of_stamp_ns = latest_stamp_ns_;
  for (int axis = 0; count_ > 0 && axis < 3; ++axis)
  {
    header.least[axis] = coordinateOf(axis, least_[static_cast<std::size_t>(axis)]);
    header.most[axis] = coordinateOf(axis, most_[static_cast<std::size_t>(axis)]);
  }
  return lasHeaderBytes(header);
}

OutputFile LasWriter::commit()
{
  if (!is_whole_) throw std::logic_error("LasWriter: a file whose points were refused by the disk");
  file_.overwrite(0, header());
  return file_.commit();
}

}  // namespace fastlio
