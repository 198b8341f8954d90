// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/localmap/place_ambiguity.h>
#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/so3.h>

#include <algorithm>

namespace fastlio
{
namespace
{
// Three standard deviations in each element. Of healthy sensors one scan in some hundreds reaches
// it, with a correction of some millimetres.
constexpr double kContradiction = 9.0;

/** What a covariance lacks to be at least \a least in every direction. */
Mat3 missing(const Mat3& least, const Mat3& covariance)
{
  const Eigensystem3 lacks = symmetricEigensystem(Mat3(least - covariance));
  const Vec3 values = lacks.values.cwiseMax(0.0);
  return lacks.vectors * values.asDiagonal() * lacks.vectors.transpose();
}
}  // namespace

void PlaceAmbiguity::add(const PoseSearchResult& search)
{
  if (!search.accepted || search.searched_std <= kUnambiguousStd) return;
  position_ += search.searched_covariance;
  heading_ += search.searched_heading_variance;
}

void PlaceAmbiguity::addCorrection(
    const NavState& predicted, const NavState& corrected, double surprise)
{
  if (surprise < kContradiction) return;
  const Vec3 moved = corrected.p - predicted.p;
  const double turned = logSO3(corrected.R * predicted.R.transpose()).dot(predicted.g.normalized());
  position_ += moved * moved.transpose();
  heading_ += turned * turned;
}

void PlaceAmbiguity::addOpenDirection(const Vec3& axis, const Mat3& position)
{
  const double variance = axis.dot(position * axis);
  if (variance <= kUnambiguousStd * kUnambiguousStd) return;
  lost_ += std::max(0.0, variance - axis.dot(lost_ * axis)) * axis * axis.transpose();
}

void PlaceAmbiguity::addTo(const NavState& x, const StateMatrix& P, StateMatrix& systematic) const
{
  const Vec3 down = x.down();
  systematic.block<3, 3>(kAttitude, kAttitude) += heading_ * down * down.transpose();
  Mat3 position = systematic.block<3, 3>(kPosition, kPosition) + position_;
  if (!lost_.isZero(0.0))
    position += missing(lost_, position + P.block<3, 3>(kPosition, kPosition));
  systematic.block<3, 3>(kPosition, kPosition) = position;
}

}  // namespace fastlio
