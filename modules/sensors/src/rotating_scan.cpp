// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "velodyne_models.h"
#include <fastlio/math/time.h>
#include <fastlio/sensors/point_cloud_conversion.h>
#include <fastlio/sensors/rotating_scan.h>
#include <fastlio/sensors/velodyne_decoder.h>

#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
using Scan = mrpt::obs::CObservationRotatingScan;

/** The points that a scan holds, row by row; empty: none. */
std::vector<mrpt::math::TPoint3Df> ownPoints(const Scan& scan)
{
#if FASTLIO_MRPT_HAS_ROTATING_POINTS
  return {scan.organizedPoints.begin(), scan.organizedPoints.end()};
#else
  const auto* with_points = dynamic_cast<const RotatingScan*>(&scan);
  return with_points != nullptr ? with_points->points : std::vector<mrpt::math::TPoint3Df>{};
#endif
}

std::optional<VelodyneModel> modelOf(const Scan& scan)
{
  if (scan.rowCount == 16 && scan.lidarModel == "VLP-16") return VelodyneModel::Vlp16;
  if (scan.rowCount == 32 && scan.lidarModel == "HDL-32E") return VelodyneModel::Hdl32e;
  // MRPT does not name it.
  if (scan.rowCount == 64 && scan.lidarModel.rfind("HDL-64", 0) == 0) return VelodyneModel::Hdl64e;
  return std::nullopt;
}

/** The matrices of MRPT count from an unsigned zero. */
template <typename Matrix>
auto at(const Matrix& matrix, int row, int column)
{
  return matrix(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
}

bool isEmptyFrom(const Scan& scan, int first_column)
{
  for (int row = 0; row < scan.rangeImage.rows(); ++row)
    for (int column = first_column; column < scan.rangeImage.cols(); ++column)
      if (at(scan.rangeImage, row, column) != 0) return false;
  return true;
}

/** MRPT makes range images out of packets with as many columns as there are returns. Only the
 * columns of the lasers are used; sweepDuration is about these. */
int usedColumns(const Scan& scan)
{
  const int all = scan.columnCount;
  const int points = all / std::max<int>(1, scan.rowCount);
  return modelOf(scan) && points > 0 && isEmptyFrom(scan, points) ? points : all;
}

/** Collects points of a scan column by column, in the order of their measurement. */
class Collector
{
 public:
  explicit Collector(const Scan& scan)
      : scan_(scan), columns_(usedColumns(scan)), timed_(hasColumnTimes(scan))
  {
    result_.has_point_times = timed_;
  }

  [[nodiscard]] int columns() const { return columns_; }

  /** Fraction of the sweep that has passed at a column. */
  [[nodiscard]] double fractionAt(int column) const
  {
    return static_cast<double>(column) / columns_;
  }

  void add(const Vec3& p, int row, int column, double seconds_in_column)
  {
    const double range = p.norm();
    if (!(range >= scan_.minRange && range <= scan_.maxRange))
    {
      ++result_.out_of_range;
      return;
    }
    const double time_s = fractionAt(column) * scan_.sweepDuration + seconds_in_column;
    const bool bright = row < scan_.intensityImage.rows() && column < scan_.intensityImage.cols();
    result_.points.push_back(
        static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
        bright ? static_cast<float>(at(scan_.intensityImage, row, column)) : 0.0F,
        timed_ ? static_cast<std::int32_t>(toNanoseconds(time_s)) : 0,
        static_cast<std::uint16_t>(row));
  }

  void skip() { ++result_.no_return; }

  [[nodiscard]] RotatingScanPoints take() { return std::move(result_); }

 private:
  const Scan& scan_;
  int columns_;
  bool timed_;
  RotatingScanPoints result_;
};

RotatingScanPoints fromOwnPoints(const Scan& scan, const std::vector<mrpt::math::TPoint3Df>& points)
{
  if (points.size() != std::size_t{scan.rowCount} * scan.columnCount)
    throw std::runtime_error(
        "the rotating scan has " + std::to_string(points.size()) + " points for " +
        std::to_string(scan.rowCount) + " rows and " + std::to_string(scan.columnCount) +
        " columns");
  Collector collector(scan);
  for (int column = 0; column < collector.columns(); ++column)
    for (int row = 0; row < scan.rowCount; ++row)
    {
      const auto& p = points
          [static_cast<std::size_t>(row) * scan.columnCount + static_cast<std::size_t>(column)];
      const bool valid = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) &&
                         (p.x != 0 || p.y != 0 || p.z != 0);
      if (valid)
        collector.add(Vec3(p.x, p.y, p.z), row, column, 0.0);
      else
        collector.skip();
    }
  return collector.take();
}

/** The image has the lasers in the order of their firing, and angles as the rotor counts them:
 * clockwise. */
RotatingScanPoints fromRanges(const Scan& scan, VelodyneModel model)
{
  const FiringTiming timing = timingOf(model);
  const auto calibration = model == VelodyneModel::Hdl64e ? defaultVelodyneCalibration("HDL64")
                                                          : mrpt::obs::VelodyneCalibration{};
  const std::vector<LaserGeometry> lasers = lasersOf(model, calibration);
  const double turn_rate = hasColumnTimes(scan) ? scan.azimuthSpan / scan.sweepDuration : 0.0;
  Collector collector(scan);
  for (int column = 0; column < collector.columns(); ++column)
    for (int row = 0; row < scan.rowCount; ++row)
    {
      const LaserGeometry& laser = lasers.at(static_cast<std::size_t>(row));
      const double range =
          at(scan.rangeImage, row, column) * scan.rangeResolution + laser.distance_correction;
      if (at(scan.rangeImage, row, column) == 0)
      {
        collector.skip();
        continue;
      }
      const auto in_sequence = static_cast<std::size_t>(row) % timing.lasers_per_sequence;
      const double delay = 1e-6 * timing.laser_us * static_cast<double>(in_sequence);
      const double azimuth = scan.startAzimuth + collector.fractionAt(column) * scan.azimuthSpan +
                             turn_rate * delay - laser.azimuth_correction;
      const double flat = range * laser.cos_elevation + laser.offset_xy;
      collector.add(
          Vec3(
              flat * std::cos(azimuth), -flat * std::sin(azimuth),
              range * laser.sin_elevation + laser.offset_z),
          laser.ring, column, delay);
    }
  return collector.take();
}
}  // namespace

bool hasColumnTimes(const mrpt::obs::CObservationRotatingScan& scan)
{
  return scan.sweepDuration > 0.0 && scan.sweepDuration <= kMaxTimeOffset;
}

RotatingScanPoints pointsOf(const mrpt::obs::CObservationRotatingScan& scan)
{
  if (const auto points = ownPoints(scan); !points.empty()) return fromOwnPoints(scan, points);
  if (scan.rangeImage.rows() != scan.rowCount || scan.rangeImage.cols() != scan.columnCount ||
      scan.rangeImage.size() == 0)
    throw std::runtime_error("the rotating scan holds neither points nor a range image");
  if (scan.rowCount == 1)
    throw std::runtime_error("the rotating scan is one of a 2D LiDAR, which has a single row");
  if (const auto model = modelOf(scan)) return fromRanges(scan, *model);
  throw std::runtime_error(
      "the rotating scan holds a range image of '" + scan.lidarModel + "' with " +
      std::to_string(scan.rowCount) +
      " rows, whose elevations are not known, and no points; known are VLP-16, HDL-32E and "
      "HDL-64E. Convert it to point clouds with the time of each point");
}

}  // namespace fastlio
