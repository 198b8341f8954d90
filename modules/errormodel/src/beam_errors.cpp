// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/beam_errors.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kLeastCosine = 0.05;  // of the elevation: nearer the axis it has no direction
// From then on an offset is known: to 1 mm, and to 1 mm at 10 m.
constexpr double kLeastRangeInformation = 1e6;      // [1/m^2]
constexpr double kLeastElevationInformation = 1e8;  // [1/rad^2]
// The variance of an offset over that of independent residuals: they share the errors of the map.
constexpr double kSharedNoise = 4.0;
// What all scans of a run tell of a single number, a fourth of them tell as well.
constexpr std::size_t kScansPerLesson = 4;
}  // namespace

void BeamErrors::Offset::add(const PointMeasurement& point, double derivative, const Vector6& pull)
{
  information += point.weight * derivative * derivative;
  weighted += point.weight * derivative * point.z;
  in_scan += pull;
}

void BeamErrors::add(
    const Mat3& R_world_scan, const DeskewedScan& scan, const std::vector<PointMeasurement>& points,
    const std::vector<PlaneMatch>& matches, const Matrix6& information)
{
  for (Offsets* offsets : {&range_, &elevation_})
    for (Offset& offset : *offsets)
      offset.in_scan.setZero();
  sides_.beginScan();
  const bool learns = scans_++ % kScansPerLesson == 0;
  const bool looks_at_sides = learns || sides_.rangeOffset() > 0.0;
  // All in the axes of the body.
  const Mat3 R_scan_world = R_world_scan.transpose();
  const Vec3 origin = scan.T_imu_lidar.p;
  const Vec3 forward = scan.T_imu_lidar.R.col(0), left = scan.T_imu_lidar.R.col(1),
             up = scan.T_imu_lidar.R.col(2);
  const BodyPoints& body = scan.surfaces;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const PointMeasurement& point = points[i];
    if (point.weight == 0.0) continue;
    const Vec3 in_body(
        static_cast<double>(body.x[i]), static_cast<double>(body.y[i]),
        static_cast<double>(body.z[i]));
    const Vec3 beam = in_body - origin;
    const double range = beam.norm();
    const double sine = up.dot(beam) / range;  // of the elevation
    const double cosine = std::sqrt(1.0 - sine * sine);
    if (!(cosine > kLeastCosine)) continue;
    const Vec3 normal = R_scan_world * point.weighted_h.tail<3>() / point.weight;
    const double along = normal.dot(beam) / range;
    const double turned_up = normal.dot(up);
    const double upward = (turned_up - sine * along) / cosine;  // across the beam
    const std::size_t bin = beamBin(sine);
    const Vector6 by_range = along * point.weighted_h;
    range_[bin].add(point, along, by_range);
    elevation_[bin].add(point, range * upward, range * upward * point.weighted_h);
    if (looks_at_sides)
      sides_.add({forward.dot(beam), left.dot(beam), along, turned_up}, point, by_range);
    cross_[bin] += point.weight * along * range * upward;
    if (learns) incidence_.add(matches[i].plane, along, point);
    const double upright = point.weight * (1.0 - turned_up * turned_up);
    upright_weight_ += upright;
    upright_range_ += upright * range;
  }
  if (!learns) return;
  incidence_.finishScan(information);
  sides_.learn();
}

double BeamErrors::meanSquare(const Offsets& offsets, double least_information)
{
  double squares = 0.0, known = 0.0;
  for (const Offset& offset : offsets)
  {
    if (offset.information < least_information) continue;
    const double square = std::pow(offset.weighted / offset.information, 2);
    squares += std::max(0.0, square - kSharedNoise / offset.information);
    known += 1.0;
  }
  return known > 0.0 ? squares / known : 0.0;
}

double BeamErrors::rangeVariance() const
{
  return meanSquare(range_, kLeastRangeInformation);
}

double BeamErrors::elevationVariance() const
{
  return meanSquare(elevation_, kLeastElevationInformation);
}

double BeamErrors::rangeOffset() const
{
  return std::sqrt(rangeVariance());
}

double BeamErrors::elevationOffset() const
{
  return std::sqrt(elevationVariance());
}

void BeamErrors::addTo(CalibrationFindings& findings) const
{
  for (std::size_t bin = 0; bin < kBeamBins; ++bin)
  {
    const Offset &range = range_[bin], &elevation = elevation_[bin];
    if (!(range.information > 0.0)) continue;
    BeamSums& sums = findings.beams.emplace_back();
    sums.elevation = beamElevation(bin);
    sums.information << range.information, cross_[bin], cross_[bin], elevation.information;
    sums.weighted << range.weighted, elevation.weighted;
    // They share the errors of the map: points hold less information than their number suggests.
    sums.information /= kSharedNoise;
    sums.weighted /= kSharedNoise;
  }
  findings.incidence = incidence_.sums();
  findings.incidence.information /= kSharedNoise;
  findings.incidence.weighted /= kSharedNoise;
  findings.upright_weight = upright_weight_;
  findings.upright_range = upright_range_;
}

Matrix6 BeamErrors::sumOfSquares(const Offsets& offsets)
{
  Matrix6 sum = Matrix6::Zero();
  for (const Offset& offset : offsets)
    if (offset.information > 0.0) sum += offset.in_scan * offset.in_scan.transpose();
  return sum;
}

Matrix6 BeamErrors::covariance() const
{
  return rangeVariance() * sumOfSquares(range_) + elevationVariance() * sumOfSquares(elevation_) +
         sides_.covariance();
}

}  // namespace fastlio
