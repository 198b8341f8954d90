// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/side_errors.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
// With fewer points the mean residual of a side says nothing: it is known to 3 mm.
constexpr double kLeastInformation = 1e5;  // [1/m^2]
constexpr double kFewestOffsets = 100.0;
constexpr double kBeyondChance = 2.0;  // standard deviations of what noise feigns
constexpr double kLevel = 0.7;         // cosine: beyond it a surface is floor or ceiling
// Pose and map go along with an offset, so that only a part of it is left in the residuals. In
// rides with known offsets of surfaces, a quarter (docs/covariance.md).
constexpr double kLeftOver = 0.25;

/** The eighth of the circle that a beam goes to, of walls or of what is level. */
std::size_t sideOf(const BeamGeometry& beam)
{
  return (beam.forward > 0.0 ? 1U : 0U) + (beam.left > 0.0 ? 2U : 0U) +
         (std::abs(beam.forward) > std::abs(beam.left) ? 4U : 0U) +
         (std::abs(beam.upright) > kLevel ? 8U : 0U);
}
}  // namespace

void SideErrors::add(const BeamGeometry& beam, const PointMeasurement& point, const Vector6& pull)
{
  Side& side = sides_[sideOf(beam)];
  side.information += point.weight * beam.along * beam.along;
  side.weighted += point.weight * beam.along * point.z;
  side.pull += pull;
}

void SideErrors::addCreation(const BeamGeometry& beam, const Vector6& pull)
{
  sides_[sideOf(beam)].pull -= pull;
}

void SideErrors::learn()
{
  for (const Side& side : sides_)
  {
    if (side.information < kLeastInformation) continue;
    squares_ += std::pow(side.weighted / side.information, 2);
    noise_ += 1.0 / side.information;  // the pose has taken up the errors of the planes
    count_ += 1.0;
  }
}

double SideErrors::rangeVariance() const
{
  if (count_ < kFewestOffsets) return 0.0;
  const double chance = kBeyondChance * std::sqrt(2.0 / count_) * noise_;
  return std::max(0.0, squares_ - noise_ - chance) / (count_ * kLeftOver * kLeftOver);
}

double SideErrors::rangeOffset() const
{
  return std::sqrt(rangeVariance());
}

Matrix6 SideErrors::covariance() const
{
  Matrix6 covariance = Matrix6::Zero();
  const double variance = rangeVariance();
  if (variance == 0.0) return covariance;
  for (const Side& side : sides_)
    covariance += variance * side.pull * side.pull.transpose();
  return covariance;
}

}  // namespace fastlio
