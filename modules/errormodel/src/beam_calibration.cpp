// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/beam_calibration.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
// A run begins with these standard deviations, near those of a good sensor, and learns from its
// residuals how large the offsets are. Factories measure azimuths best, and a larger value makes
// the attitude of a perfect sensor too uncertain. The maximum is for a LiDAR without its
// calibration.
const Vec3 kPriorStd(0.003, 0.0003, 0.0001), kMostStd(0.05, 0.005, 0.005);  // [m], [rad], [rad]
// Residuals share the errors of planes, which are in many scans: they hold so many times less
// information than their number suggests.
constexpr double kNoiseOfPlanes = 50.0;
// Offsets that grow with the elevation look like motion, and so do biases of slanted surfaces. In
// simulated rides the offsets are off by two to three standard deviations: for the covariance,
// residuals hold so many times less information still.
constexpr double kUnderstated = 9.0;
// The prediction knows the pose of a scan so well at least [rad], [m].
constexpr double kPredictedRotation = 0.002, kPredictedPosition = 0.01;
// Every so many scans there is a new estimate, later when their number has grown by an eighth.
constexpr std::size_t kScansPerEstimate = 4, kGrowth = 8;
constexpr Eigen::Index kOffsets = 3;  // of a beam: range, elevation, azimuth
}  // namespace

void BeamCalibration::begin(std::size_t first_bin, std::size_t bins)
{
  first_bin_ = first_bin;
  bins_ = bins;
  scans_ = 0;
  next_estimate_ = kScansPerEstimate;
  const auto size = kOffsets * static_cast<Eigen::Index>(bins);
  for (Eigen::MatrixXd* matrix : {&information_, &of_scan_, &covariance_})
    matrix->setZero(size, size);
  for (Eigen::VectorXd* vector : {&weighted_, &weighted_of_scan_, &offsets_})
    vector->setZero(size);
  with_pose_.setZero(size, 6);
  prior_ = kPriorStd.cwiseAbs2();
  covariance_.diagonal() = prior_.replicate(static_cast<Eigen::Index>(bins), 1);
  corrections_ = BeamCorrections();
}

/** Of the range offset of a bin; -1: not one of the LiDAR's. */
Eigen::Index BeamCalibration::indexOf(std::size_t bin) const
{
  if (bin < first_bin_ || bin >= first_bin_ + bins_) return -1;
  return kOffsets * static_cast<Eigen::Index>(bin - first_bin_);
}

void BeamCalibration::add(
    const PointMeasurement& point, const BeamView& measured, const BeamView* created)
{
  const Eigen::Index at = indexOf(measured.bin);
  const Eigen::Index before = created != nullptr ? indexOf(created->bin) : -1;
  if (at < 0) return;
  const auto addBlock = [&](Eigen::Index row, const Vec3& by_offset)
  {
    of_scan_.block<kOffsets, kOffsets>(row, row) +=
        point.weight * by_offset * by_offset.transpose();
    weighted_of_scan_.segment<kOffsets>(row) += point.weight * point.z * by_offset;
    with_pose_.middleRows<kOffsets>(row) += by_offset * point.weighted_h.transpose();
  };
  addBlock(at, measured.by_offset);
  if (before < 0) return;
  const Vec3 by_created = -created->by_offset;
  addBlock(before, by_created);
  const Mat3 cross = point.weight * measured.by_offset * by_created.transpose();
  of_scan_.block<kOffsets, kOffsets>(at, before) += cross;
  of_scan_.block<kOffsets, kOffsets>(before, at) += cross.transpose();
}

/** The scan's pose is an unknown of its own, which the prediction hardly limits: what it explains
 * is no evidence. */
bool BeamCalibration::finishScan(const Matrix6& information)
{
  Matrix6 pose = information;
  pose.diagonal().head<3>().array() += std::pow(kPredictedRotation, -2);
  pose.diagonal().tail<3>().array() += std::pow(kPredictedPosition, -2);
  Eigen::LLT<Matrix6>(pose).matrixU().solveInPlace<Eigen::OnTheRight>(with_pose_);
  of_scan_ -= with_pose_.lazyProduct(with_pose_.transpose());
  information_ += of_scan_;
  weighted_ += weighted_of_scan_;
  // The residuals are those of corrected points: what was taken off comes back.
  if (corrects_) weighted_.noalias() += of_scan_ * offsets_;
  of_scan_.setZero();
  weighted_of_scan_.setZero();
  with_pose_.setZero();
  if (++scans_ < next_estimate_) return false;
  next_estimate_ = scans_ + std::max(kScansPerEstimate, scans_ / kGrowth);
  solve(kNoiseOfPlanes);
  offsets_ = weighted_ / kNoiseOfPlanes;
  factor_.solveInPlace(offsets_);
  learnPrior();
  solve(kUnderstated * kNoiseOfPlanes);
  addCommonParts();
  if (corrects_)
    for (std::size_t i = 0; i < bins_; ++i)
    {
      const auto at = kOffsets * static_cast<Eigen::Index>(i);
      corrections_.set(first_bin_ + i, {offsets_[at], offsets_[at + 1], offsets_[at + 2]});
    }
  else
    covariance_.noalias() += offsets_ * offsets_.transpose();
  return true;
}

/** \param noise the information counts as so many times less */
void BeamCalibration::solve(double noise)
{
  covariance_ = information_ / noise;
  covariance_.diagonal() += prior_.cwiseInverse().replicate(static_cast<Eigen::Index>(bins_), 1);
  factor_.compute(covariance_);
  covariance_.setIdentity();
  factor_.solveInPlace(covariance_);
}

/** Elevations that are all off by the same, or by a part of themselves, look like another pose of
 * the LiDAR and another scale of the gyro, and ranges like biases of slanted ground: of these the
 * data know nothing. */
void BeamCalibration::addCommonParts()
{
  const auto bins = static_cast<Eigen::Index>(bins_);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(bins).normalized();
  const Eigen::VectorXd slope =
      Eigen::VectorXd::LinSpaced(bins, -1.0, 1.0).normalized();  // bins are even in the sine
  for (const Eigen::VectorXd& part : {one, slope})
    for (Eigen::Index i = 0; i < bins; ++i)
      for (Eigen::Index j = 0; j < bins; ++j)
        covariance_.block<kOffsets, kOffsets>(kOffsets * i, kOffsets * j).diagonal() +=
            part[i] * part[j] * prior_;
}

/** A step of expectation maximisation: offsets are as large as those that were found, and as they
 * still may be. */
void BeamCalibration::learnPrior()
{
  Vec3 sum = Vec3::Zero();
  double seen = 0.0;
  for (Eigen::Index at = 0; at < offsets_.size(); at += kOffsets)
  {
    if (!(information_(at, at) > 0.0)) continue;
    sum +=
        offsets_.segment<kOffsets>(at).cwiseAbs2() + covariance_.diagonal().segment<kOffsets>(at);
    seen += 1.0;
  }
  if (seen > 0.0) prior_ = (sum / seen).cwiseMin(kMostStd.cwiseAbs2());
}

double BeamCalibration::rangeStd() const
{
  return bins_ > 0 ? std::sqrt(prior_[0]) : 0.0;
}

double BeamCalibration::elevationStd() const
{
  return bins_ > 0 ? std::sqrt(prior_[1]) : 0.0;
}

double BeamCalibration::azimuthStd() const
{
  return bins_ > 0 ? std::sqrt(prior_[2]) : 0.0;
}

}  // namespace fastlio
