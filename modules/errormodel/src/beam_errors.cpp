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
constexpr std::size_t kScansPerIncidence = 4;
}  // namespace

void BeamErrors::Offset::add(const PointMeasurement& point, double derivative)
{
  information += point.weight * derivative * derivative;
  weighted += point.weight * derivative * point.z;
  in_scan += derivative * point.weighted_h;
}

void BeamErrors::add(
    const Mat3& R_world_scan, const DeskewedScan& scan, const std::vector<PointMeasurement>& points,
    const std::vector<PlaneMatch>& matches, const Matrix6& information)
{
  for (Offsets* offsets : {&range_, &elevation_})
    for (Offset& offset : *offsets)
      offset.in_scan.setZero();
  const bool learns_incidence = scans_++ % kScansPerIncidence == 0;
  // All in the axes of the body.
  const Mat3 R_scan_world = R_world_scan.transpose();
  const Vec3 origin = scan.T_imu_lidar.p, up = scan.T_imu_lidar.R.col(2);
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
    range_[bin].add(point, along);
    elevation_[bin].add(point, range * upward);
    cross_[bin] += point.weight * along * range * upward;
    if (learns_incidence) incidence_.add(matches[i].plane, along, point);
    const double upright = point.weight * (1.0 - turned_up * turned_up);
    upright_weight_ += upright;
    upright_range_ += upright * range;
  }
  if (learns_incidence) incidence_.finishScan(information);
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

Matrix6 BeamErrors::covariance() const
{
  Matrix6 by_range = Matrix6::Zero(), by_elevation = Matrix6::Zero();
  for (const Offset& offset : range_)
    by_range += offset.in_scan * offset.in_scan.transpose();
  for (const Offset& offset : elevation_)
    by_elevation += offset.in_scan * offset.in_scan.transpose();
  return rangeVariance() * by_range + elevationVariance() * by_elevation;
}

}  // namespace fastlio
