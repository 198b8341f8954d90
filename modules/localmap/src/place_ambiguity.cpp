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
// After scans that contradict certain predictions, the platform is somewhere else, unless this part
// of the usual matches says that something was only in the way. A single scan may be a bad one.
constexpr double kAsUsual = 0.9, kAsUsualAfterOne = 0.6;
// Then it may be anywhere: as far as a room or a street goes, with any heading.
constexpr double kDisplacedPosition = 10.0, kDisplacedHeading = 1.5707963267948966;  // [m], [rad]

/** What a covariance lacks to be at least \a least in every direction. */
Mat3 missing(const Mat3& least, const Mat3& covariance)
{
  const Eigensystem3 lacks = symmetricEigensystem(Mat3(least - covariance));
  const Vec3 values = lacks.values.cwiseMax(0.0);
  return lacks.vectors * values.asDiagonal() * lacks.vectors.transpose();
}
}  // namespace

void PlaceAmbiguity::add(const PoseSearchResult& search, bool expects_new_view)
{
  const bool certain = search.predictionIsCertain();
  if (!search.accepted)
  {
    if (certain && !expects_new_view) ++contradictions_;
    return;
  }
  if (certain)
  {
    position_ += search.rival_offset * search.rival_offset.transpose();
    return;
  }
  position_ += search.searched_covariance;
  heading_ += search.searched_heading_variance;
}

void PlaceAmbiguity::addPose(double usual_part)
{
  const double as_usual = contradictions_ > 1 ? kAsUsual : kAsUsualAfterOne;
  if (contradictions_ > 0 && usual_part < as_usual)
  {
    position_ += kDisplacedPosition * kDisplacedPosition * Mat3::Identity();
    heading_ += kDisplacedHeading * kDisplacedHeading;
  }
  contradictions_ = 0;
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

void PlaceAmbiguity::beginInMotion(const NavState& x, const Vec3& angular_rate)
{
  first_position_ = x.p;
  first_velocity_ = x.v;
  first_rate_ = x.R * angular_rate;
  first_offset_ = x.time_offset;
}

/** All poses lie as they do from where the first one was when its scan ended by the clock of the
 * IMU. It was given as where the platform was before, by as much as the offset was wrong then. */
Vector6 PlaceAmbiguity::shiftOf(const NavState& x) const
{
  const double late = x.time_offset - first_offset_;
  const Vec3 turn = late * first_rate_;
  Vector6 shift;
  shift << x.R.transpose() * turn, late * first_velocity_ + turn.cross(x.p - first_position_);
  return shift;
}

void PlaceAmbiguity::addTo(const NavState& x, const StateMatrix& P, StateMatrix& systematic) const
{
  const Vector6 shift = shiftOf(x);
  systematic.topLeftCorner<6, 6>() += shift * shift.transpose();
  const Vec3 down = x.down();
  systematic.block<3, 3>(kAttitude, kAttitude) += heading_ * down * down.transpose();
  Mat3 position = systematic.block<3, 3>(kPosition, kPosition) + position_;
  if (!lost_.isZero(0.0))
    position += missing(lost_, position + P.block<3, 3>(kPosition, kPosition));
  systematic.block<3, 3>(kPosition, kPosition) = position;
}

}  // namespace fastlio
