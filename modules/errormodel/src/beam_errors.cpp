// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "square_root.h"
#include <fastlio/errormodel/beam_errors.h>
#include <fastlio/math/columns.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace fastlio
{
namespace
{
constexpr double kLeastCosine = 0.05;  // of the elevation: nearer the axis it has no direction
// Residuals share the errors of the planes: they hold less information than their number suggests.
constexpr double kSharedNoise = 4.0;
// Every so many-th scan is sampled: for what all scans of a run tell of a single number, and for
// what the beams meet, which hardly changes in so short a time, seen from the sensor.
constexpr std::size_t kScansPerSample = 4;

/** A point on a plane as the beam saw it that created the plane. */
struct CreatedPoint
{
  BeamView view;
  BeamGeometry geometry;
};

std::optional<CreatedPoint> createdBy(
    const Pose& T_lidar_world, const Vec3& point, const Vec3& normal)
{
  const Vec3 beam = T_lidar_world * point, turned = T_lidar_world.R * normal;
  const double range = beam.norm(), sine = beam.z() / range;
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  if (!(cosine > kLeastCosine)) return std::nullopt;
  const double along = turned.dot(beam) / range;
  const double upward = (turned.z() - sine * along) / cosine;
  const double sideways = beam.x() * turned.y() - beam.y() * turned.x();
  return CreatedPoint{
      {beamBin(sine), {along, range * upward, sideways}}, {beam.x(), beam.y(), along, turned.z()}};
}
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
  std::size_t bin[kLanes];                              // of the elevation as measured
  double along[kLanes];                                 // cosine between beam and normal
  double turned_up[kLanes];                             // cosine between z axis and normal
  double upward[kLanes];                                // the normal across the beam, upward
  double sideways[kLanes];                              // derivative by the azimuth [m]

  [[nodiscard]] BeamView view(std::size_t lane) const
  {
    return {bin[lane], {along[lane], range[lane] * upward[lane], sideways[lane]}};
  }
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
    b.bin[l] = body.beam_bin[i];
    const auto x = static_cast<double>(body.x[i]), y = static_cast<double>(body.y[i]),
               z = static_cast<double>(body.z[i]);
    const double nx = block.h[3][l], ny = block.h[4][l], nz = block.h[5][l];
    b.forward[l] = turned(R_lidar_body, 0, x, y, z) - origin[0];
    b.left[l] = turned(R_lidar_body, 1, x, y, z) - origin[1];
    const double up = turned(R_lidar_body, 2, x, y, z) - origin[2];
    b.range[l] = std::sqrt(b.forward[l] * b.forward[l] + b.left[l] * b.left[l] + up * up);
    const double inverse = 1.0 / b.range[l];
    const double n_forward = turned(R_lidar_world, 0, nx, ny, nz),
                 n_left = turned(R_lidar_world, 1, nx, ny, nz);
    b.turned_up[l] = turned(R_lidar_world, 2, nx, ny, nz);
    b.along[l] = inverse * (n_forward * b.forward[l] + n_left * b.left[l] + b.turned_up[l] * up);
    b.sideways[l] = n_left * b.forward[l] - n_forward * b.left[l];
    b.sine[l] = inverse * up;
    b.cosine[l] = std::sqrt(1.0 - b.sine[l] * b.sine[l]);
    b.upward[l] = (b.turned_up[l] - b.sine[l] * b.along[l]) / b.cosine[l];
  }
  return b;
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
  if (bins_per_column_ == 0) chooseColumns(scan.surfaces);
  measured.forEachBlock(
      [&](const MeasurementBlock& block, std::size_t)
      {
        const BeamLanes beams = beamsOf(block, scan.surfaces, frame);
        for (std::size_t l = 0; l < kLanes; ++l)
        {
          if (block.weight[l] == 0.0 || !(beams.cosine[l] > kLeastCosine)) continue;
          const PointMeasurement point = block.point(l);
          add(beams.view(l), point);
          const double upright = point.weight * (1.0 - beams.turned_up[l] * beams.turned_up[l]);
          upright_weight_ += upright;
          upright_range_ += upright * beams.range[l];
          if (!is_sampled) continue;
          const std::size_t i = block.index[l];
          sample(beams, l, point, matches[i], T_world_scan * pointAt(scan.surfaces, i));
        }
      });
  if (!is_sampled) return;
  incidence_.finishScan(measured.sums().HtRinvH);
  sides_.learn();
  finishSample(R_world_scan, measured.sums().HtRinvH);
}

/** As fine as the elevations of a scan allow. They stay: a column is always of the same lasers. */
void BeamErrors::chooseColumns(const BodyPoints& body)
{
  if (body.size() == 0) return;
  const auto [first, last] = std::minmax_element(body.beam_bin.begin(), body.beam_bin.end());
  first_bin_ = *first;
  const std::size_t bins = 1U + *last - *first;
  bins_per_column_ = 1 + (bins - 1) / kLaserColumns;
  calibration_.begin(first_bin_, bins);
  useCovariance();
}

std::size_t BeamErrors::columnOf(std::size_t bin) const
{
  return (bin - first_bin_) / bins_per_column_;
}

void BeamErrors::add(const BeamView& beam, const PointMeasurement& point)
{
  Beam& sums = beams_[beam.bin];
  const Eigen::Vector2d by_offset = beam.by_offset.head<2>();
  sums.information += point.weight * by_offset * by_offset.transpose();
  sums.weighted += point.weight * point.z * by_offset;
}

void BeamErrors::beginSample()
{
  for (Beam& beam : beams_)
    beam.in_sampled.setZero();
  sides_.beginScan();
}

/** In the axes of the body, where what the beams do changes little from scan to scan. */
void BeamErrors::finishSample(const Mat3& R_world_scan, const Matrix6& information)
{
  if (calibration_.finishScan(information)) useCovariance();
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Identity();
  turn.bottomRightCorner<3, 3>() = R_world_scan.transpose();
  Eigen::Matrix<double, 6, kLaserErrors> by_laser = Eigen::Matrix<double, 6, kLaserErrors>::Zero();
  for (std::size_t bin = first_bin_; bin < first_bin_ + calibration_.bins(); ++bin)
    by_laser.middleCols<kOffsets>(kOffsets * static_cast<Eigen::Index>(columnOf(bin))) +=
        beams_[bin].in_sampled;
  pulls_.leftCols<kSideErrors>() = squareRoot(turn * sides_.covariance() * turn.transpose());
  pulls_.rightCols<kLaserErrors>() = turn * by_laser * root_;
}

/** Neighbours in a column pull alike, each with an error of its own: theirs is the mean. */
void BeamErrors::useCovariance()
{
  const Eigen::MatrixXd& covariance = calibration_.covariance();
  const auto bins = covariance.rows() / kOffsets;
  Eigen::Matrix<double, kLaserErrors, 1> lasers = Eigen::Matrix<double, kLaserErrors, 1>::Zero();
  const auto columnAt = [&](Eigen::Index i)
  {
    return kOffsets * static_cast<Eigen::Index>(columnOf(first_bin_ + static_cast<std::size_t>(i)));
  };
  for (Eigen::Index i = 0; i < bins; ++i)
    lasers.segment<kOffsets>(columnAt(i)).array() += 1.0;
  Eigen::Matrix<double, kLaserErrors, kLaserErrors> of_columns;
  of_columns.setZero();
  for (Eigen::Index i = 0; i < bins; ++i)
    for (Eigen::Index j = 0; j < bins; ++j)
      of_columns.block<kOffsets, kOffsets>(columnAt(i), columnAt(j)) +=
          covariance.block<kOffsets, kOffsets>(kOffsets * i, kOffsets * j);
  const auto inverse = lasers.cwiseMax(1.0).cwiseInverse().eval();
  of_columns = inverse.asDiagonal() * of_columns * inverse.asDiagonal();
  // A column without a laser has no error, and stays apart from the others.
  of_columns.diagonal().array() += (lasers.array() == 0.0).cast<double>();
  root_ = Eigen::LLT<Eigen::Matrix<double, kLaserErrors, kLaserErrors>>(of_columns).matrixL();
}

void BeamErrors::sample(
    const BeamLanes& beams, std::size_t lane, const PointMeasurement& point,
    const PlaneMatch& match, const Vec3& point_world)
{
  const BeamGeometry beam{
      beams.forward[lane], beams.left[lane], beams.along[lane], beams.turned_up[lane]};
  const BeamView measured = beams.view(lane);
  beams_[measured.bin].in_sampled += point.weighted_h * measured.by_offset.transpose();
  sides_.add(beam, point, beam.along * point.weighted_h);
  incidence_.add(match.plane, beam.along, point);
  const Pose* view = views_.T_lidar_world(match.created_insertion);
  const auto created = view != nullptr
                           ? createdBy(*view, point_world, {match.nx, match.ny, match.nz})
                           : std::nullopt;
  calibration_.add(point, measured, created ? &created->view : nullptr);
  if (!created) return;
  beams_[created->view.bin].in_sampled -= point.weighted_h * created->view.by_offset.transpose();
  sides_.addCreation(created->geometry, created->geometry.along * point.weighted_h);
}

void BeamErrors::forgetMap()
{
  incidence_.forgetMap();
  views_.clear();
}

void BeamErrors::addTo(CalibrationFindings& findings) const
{
  for (std::size_t bin = 0; bin < kBeamBins; ++bin)
  {
    const Beam& beam = beams_[bin];
    if (!(beam.information(0, 0) > 0.0)) continue;
    BeamSums& sums = findings.beams.emplace_back();
    sums.elevation = beamElevation(bin);
    sums.information = beam.information / kSharedNoise;
    sums.weighted = beam.weighted / kSharedNoise;
  }
  findings.incidence = incidence_.sums();
  findings.incidence.information /= kSharedNoise;
  findings.incidence.weighted /= kSharedNoise;
  findings.upright_weight = upright_weight_;
  findings.upright_range = upright_range_;
}

BeamPulls BeamErrors::pulls(const Mat3& R_world_scan) const
{
  BeamPulls pulls = pulls_;
  pulls.bottomRows<3>() = R_world_scan * pulls_.bottomRows<3>();
  return pulls;
}

}  // namespace fastlio
