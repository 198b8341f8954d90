// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "square_root.h"
#include <fastlio/errormodel/beam_errors.h>
#include <fastlio/math/columns.h>

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
// Pose and map go along with an offset, so that only a part of it is left in the residuals: about
// so much in rides whose lasers have known offsets (docs/covariance.md).
constexpr double kLeftOfRange = 0.75, kLeftOfElevation = 0.55;
// The variance of an offset over that of independent residuals: they share the errors of the map.
constexpr double kSharedNoise = 4.0;
// Every so many-th scan is sampled: for what all scans of a run tell of a single number, and for
// what the beams meet, which hardly changes in so short a time, seen from the sensor.
constexpr std::size_t kScansPerSample = 4;
// Columns of BeamPulls: those of the sides, then ranges, then elevations.
constexpr int kSideErrors = 6;
constexpr std::size_t kLaserColumns = (kBeamErrors - kSideErrors) / 2;
}  // namespace

/** The axes of the sensor. */
struct BeamErrors::SensorFrame
{
  Mat3 R_lidar_body, R_lidar_world;
  Vec3 origin;  //!< of the beams, minus that of the body
};

/** Beams of a block and what they meet, in the axes of the sensor. */
struct BeamErrors::BeamLanes
{
  double forward[kLanes], left[kLanes], range[kLanes];  // [m]
  double sine[kLanes], cosine[kLanes];                  // of the elevation
  double along[kLanes];                                 // cosine between beam and normal
  double turned_up[kLanes];                             // cosine between z axis and normal
  double upward[kLanes];                                // the normal across the beam, upward
};

BeamErrors::BeamLanes BeamErrors::beamsOf(
    const MeasurementBlock& block, const BodyPoints& body, const SensorFrame& frame)
{
  const auto turned = [](const Mat3& R, int row, double x, double y, double z)
  { return R(row, 0) * x + R(row, 1) * y + R(row, 2) * z; };
  const Mat3 R_lidar_body = frame.R_lidar_body, R_lidar_world = frame.R_lidar_world;
  const Vec3 origin = frame.origin;
  BeamLanes b;
  for (std::size_t l = 0; l < kLanes; ++l)
  {
    const std::size_t i = block.index[l];
    const auto x = static_cast<double>(body.x[i]), y = static_cast<double>(body.y[i]),
               z = static_cast<double>(body.z[i]);
    const double nx = block.h[3][l], ny = block.h[4][l], nz = block.h[5][l];
    b.forward[l] = turned(R_lidar_body, 0, x, y, z) - origin[0];
    b.left[l] = turned(R_lidar_body, 1, x, y, z) - origin[1];
    const double up = turned(R_lidar_body, 2, x, y, z) - origin[2];
    b.range[l] = std::sqrt(b.forward[l] * b.forward[l] + b.left[l] * b.left[l] + up * up);
    const double inverse = 1.0 / b.range[l];
    b.turned_up[l] = turned(R_lidar_world, 2, nx, ny, nz);
    b.along[l] = inverse * (turned(R_lidar_world, 0, nx, ny, nz) * b.forward[l] +
                            turned(R_lidar_world, 1, nx, ny, nz) * b.left[l] + b.turned_up[l] * up);
    b.sine[l] = inverse * up;
    b.cosine[l] = std::sqrt(1.0 - b.sine[l] * b.sine[l]);
    b.upward[l] = (b.turned_up[l] - b.sine[l] * b.along[l]) / b.cosine[l];
  }
  return b;
}

void BeamErrors::Offset::add(const PointMeasurement& point, double derivative)
{
  information += point.weight * derivative * derivative;
  weighted += point.weight * derivative * point.z;
}

void BeamErrors::add(
    const Pose& T_world_scan, const DeskewedScan& scan, const MeasuredScan& measured,
    const std::vector<PlaneMatch>& matches)
{
  const bool is_sampled = scans_++ % kScansPerSample == 0;
  const Mat3& R_world_scan = T_world_scan.R;
  if (is_sampled) beginSample();
  const Mat3 R_lidar_body = scan.T_imu_lidar.R.transpose();
  const SensorFrame frame{
      R_lidar_body, R_lidar_body * R_world_scan.transpose(), R_lidar_body * scan.T_imu_lidar.p};
  if (bins_per_column_ == 0) chooseColumns(scan.surfaces, frame);
  measured.forEachBlock(
      [&](const MeasurementBlock& block, std::size_t)
      {
        const BeamLanes beams = beamsOf(block, scan.surfaces, frame);
        for (std::size_t l = 0; l < kLanes; ++l)
        {
          if (block.weight[l] == 0.0 || !(beams.cosine[l] > kLeastCosine)) continue;
          const PointMeasurement point = block.point(l);
          add(beams, l, point);
          if (!is_sampled) continue;
          const PlaneMatch& match = matches[block.index[l]];
          sample(beams, l, point, match.plane);
          if (const Pose* view = views_.T_lidar_world(match.created_insertion))
            sampleCreation(
                *view, T_world_scan * pointAt(scan.surfaces, block.index[l]),
                {block.h[3][l], block.h[4][l], block.h[5][l]}, point.weighted_h);
        }
      });
  if (!is_sampled) return;
  incidence_.finishScan(measured.sums().HtRinvH);
  sides_.learn();
  finishSample(R_world_scan);
}

/** As fine as the elevations of a scan allow. They stay: a column is always of the same lasers. */
void BeamErrors::chooseColumns(const BodyPoints& body, const SensorFrame& frame)
{
  std::size_t last = 0;
  first_bin_ = kBeamBins - 1;
  for (std::size_t i = 0; i < body.size(); ++i)
  {
    const Vec3 beam = frame.R_lidar_body * pointAt(body, i) - frame.origin;
    if (!(beam.squaredNorm() > 0.0)) continue;
    const std::size_t bin = beamBin(beam.z() / beam.norm());
    first_bin_ = std::min(first_bin_, bin);
    last = std::max(last, bin);
  }
  if (last >= first_bin_) bins_per_column_ = 1 + (last - first_bin_) / kLaserColumns;
}

void BeamErrors::add(const BeamLanes& beams, std::size_t lane, const PointMeasurement& point)
{
  const double along = beams.along[lane], by_elevation = beams.range[lane] * beams.upward[lane];
  const std::size_t bin = beamBin(beams.sine[lane]);
  range_[bin].add(point, along);
  elevation_[bin].add(point, by_elevation);
  cross_[bin] += point.weight * along * by_elevation;
  const double upright = point.weight * (1.0 - beams.turned_up[lane] * beams.turned_up[lane]);
  upright_weight_ += upright;
  upright_range_ += upright * beams.range[lane];
}

void BeamErrors::beginSample()
{
  for (Offsets* offsets : {&range_, &elevation_})
    for (Offset& offset : *offsets)
      offset.in_sampled.setZero();
  sides_.beginScan();
}

/** In the axes of the body, where what the beams do changes little from scan to scan. */
void BeamErrors::finishSample(const Mat3& R_world_scan)
{
  constexpr auto kColumns = static_cast<Eigen::Index>(kLaserColumns);
  range_variance_ =
      meanSquare(range_, elevation_, kLeastRangeInformation) / (kLeftOfRange * kLeftOfRange);
  elevation_variance_ = meanSquare(elevation_, range_, kLeastElevationInformation) /
                        (kLeftOfElevation * kLeftOfElevation);
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Identity();
  turn.bottomRightCorner<3, 3>() = R_world_scan.transpose();
  Eigen::Matrix<double, 6, kBeamErrors> pulls = Eigen::Matrix<double, 6, kBeamErrors>::Zero();
  pullsOf(range_, range_variance_, pulls.middleCols<kColumns>(kSideErrors));
  pullsOf(elevation_, elevation_variance_, pulls.rightCols<kColumns>());
  pulls = turn * pulls;
  pulls.leftCols<kSideErrors>() = squareRoot(turn * sides_.covariance() * turn.transpose());
  pulls_ = pulls;
}

void BeamErrors::sample(
    const BeamLanes& beams, std::size_t lane, const PointMeasurement& point, std::uint32_t plane)
{
  const BeamGeometry beam{
      beams.forward[lane], beams.left[lane], beams.along[lane], beams.turned_up[lane]};
  const Vector6 by_range = beam.along * point.weighted_h;
  const std::size_t bin = beamBin(beams.sine[lane]);
  range_[bin].in_sampled += by_range;
  elevation_[bin].in_sampled += beams.range[lane] * beams.upward[lane] * point.weighted_h;
  sides_.add(beam, point, by_range);
  incidence_.add(plane, beam.along, point);
}

void BeamErrors::sampleCreation(
    const Pose& T_lidar_world, const Vec3& point, const Vec3& normal, const Vector6& weighted_h)
{
  const Vec3 beam = T_lidar_world * point, turned = T_lidar_world.R * normal;
  const double range = beam.norm(), sine = beam.z() / range;
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  if (!(cosine > kLeastCosine)) return;
  const double along = turned.dot(beam) / range;
  const std::size_t bin = beamBin(sine);
  range_[bin].in_sampled -= along * weighted_h;
  elevation_[bin].in_sampled -= range * (turned.z() - sine * along) / cosine * weighted_h;
  sides_.addCreation({beam.x(), beam.y(), along, turned.z()}, along * weighted_h);
}

void BeamErrors::forgetMap()
{
  incidence_.forgetMap();
  views_.clear();
}

double BeamErrors::meanSquare(
    const Offsets& offsets, const Offsets& others, double least_information) const
{
  double squares = 0.0, known = 0.0;
  for (std::size_t bin = 0; bin < kBeamBins; ++bin)
  {
    const Offset &offset = offsets[bin], &other = others[bin];
    double information = offset.information, weighted = offset.weighted;
    // What the other offset of the laser explains is not of this one, where both can be told apart.
    const double slope = other.information > 0.0 ? cross_[bin] / other.information : 0.0;
    const double apart = information - slope * cross_[bin];
    if (apart >= least_information)
    {
      information = apart;
      weighted -= slope * other.weighted;
    }
    if (information < least_information) continue;
    const double square = std::pow(weighted / information, 2);
    squares += std::max(0.0, square - kSharedNoise / information);
    known += 1.0;
  }
  return known > 0.0 ? squares / known : 0.0;
}

double BeamErrors::rangeOffset() const
{
  return std::sqrt(range_variance_);
}

double BeamErrors::elevationOffset() const
{
  return std::sqrt(elevation_variance_);
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

void BeamErrors::pullsOf(
    const Offsets& offsets, double variance, Eigen::Ref<Eigen::Matrix<double, 6, -1>> result) const
{
  std::array<double, kLaserColumns> lasers{};
  for (std::size_t bin = 0; bin < kBeamBins; ++bin)
  {
    if (!(offsets[bin].information > 0.0)) continue;
    const std::size_t column =
        bin < first_bin_ ? 0 : std::min(kLaserColumns - 1, (bin - first_bin_) / bins_per_column_);
    result.col(static_cast<Eigen::Index>(column)) += offsets[bin].in_sampled;
    lasers[column] += 1.0;
  }
  // Neighbours pull alike, each with an error of its own.
  for (std::size_t column = 0; column < kLaserColumns; ++column)
    if (lasers[column] > 0.0)
      result.col(static_cast<Eigen::Index>(column)) *= std::sqrt(variance / lasers[column]);
}

BeamPulls BeamErrors::pulls(const Mat3& R_world_scan) const
{
  BeamPulls pulls = pulls_;
  pulls.bottomRows<3>() = R_world_scan * pulls_.bottomRows<3>();
  return pulls;
}

}  // namespace fastlio
