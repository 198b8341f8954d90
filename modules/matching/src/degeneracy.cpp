// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "information_lanes.h"
#include <fastlio/matching/degeneracy.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
using Square6 = Eigen::Matrix<double, 6, 6>;

// On open ground, what all but the strongest planes say has to be more than this part of what is
// needed: in tunnels of three sensors it was not more than a tenth of it, on ground with bumps of
// 3 cm 0.11 to 0.22.
constexpr double kCommonPart = 0.12;
// A scan of open ground says this part at most along the axis that it says second most about.
constexpr double kOpen = 0.1;
// Then this part of the signal-to-noise ratio suffices.
constexpr double kCommonSignal = 0.3;

/** Lever arm that makes rotations and translations equally strong on the whole [m]. */
double leverArmOf(const Matrix6& information)
{
  const double rotation = information.topLeftCorner<3, 3>().trace();
  const double translation = information.bottomRightCorner<3, 3>().trace();
  return translation > 0.0 && rotation > 0.0 ? std::sqrt(rotation / translation) : 1.0;
}

/** Information by (rotation * lever_arm, translation). */
Square6 inLengths(const Matrix6& information, double lever_arm)
{
  Square6 m = information;
  m.topRows<3>() /= lever_arm;
  m.leftCols<3>() /= lever_arm;
  return m;
}

/** Eigenvectors of \a m; the translations come before all others and stay out of these. */
Square6 directionsOf(const Square6& m, const TranslationAxes& translations)
{
  Square6 others = Square6::Identity();
  others.bottomRightCorner<3, 3>() -= translations * translations.transpose();
  Square6 separated = others * m * others;
  const double below_all = -m.trace();
  for (Eigen::Index i = 0; i < translations.cols(); ++i)
  {
    const Vec3 axis = translations.col(i);
    const auto rank = static_cast<double>(translations.cols() - i);
    separated.bottomRightCorner<3, 3>() += rank * below_all * axis * axis.transpose();
  }
  return symmetricEigensystem(Matrix6(separated)).vectors;
}
}  // namespace

Matrix6 normalNoiseInformation(
    const Mat3& R_world_scan, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const MeasuredScan& scan, std::size_t chunk)
{
  // cov(h) = s (B B^T - h h^T) with B = [[p]x R^T; I], B n = h and half the summed variance s.
  OuterProductLanes<kLanes> shh_lanes;
  OuterProductLanes<kLanes, 4> spp_lanes;  // of (p, 1): s p p^T, s p and s
  scan.forEachBlockOf(
      chunk,
      [&](const MeasurementBlock& block, std::size_t)
      {
        double s[kLanes], p[4][kLanes];
        for (std::size_t l = 0; l < kLanes; ++l)
        {
          const std::size_t i = block.index[l];
          const bool counts = block.weight[l] > 0.0;  // other points may be no numbers
          const auto of_points = static_cast<double>(matches[i].normal_variance);
          s[l] = counts ? block.weight[l] * 0.5 * (of_points + kNormalVariance) : 0.0;
          p[0][l] = counts ? static_cast<double>(body.x[i]) : 0.0;
          p[1][l] = counts ? static_cast<double>(body.y[i]) : 0.0;
          p[2][l] = counts ? static_cast<double>(body.z[i]) : 0.0;
          p[3][l] = 1.0;
        }
        shh_lanes.add(s, block.h);
        spp_lanes.add(s, p);
      });
  const auto sums = spp_lanes.sum();
  const double s_sum = sums(3, 3);
  const Vec3 sp_sum = sums.topRightCorner<3, 1>();
  const Mat3 spp_sum = sums.topLeftCorner<3, 3>();
  const Square6 shh_sum = shh_lanes.sum();
  Square6 sum = -shh_sum;
  // [p]x [p]x^T = |p|^2 I - p p^T
  sum.topLeftCorner<3, 3>() += spp_sum.trace() * Mat3::Identity() - spp_sum;
  const Mat3 lever = skew(sp_sum) * R_world_scan.transpose();
  sum.topRightCorner<3, 3>() += lever;
  sum.bottomLeftCorner<3, 3>() += lever.transpose();
  sum.bottomRightCorner<3, 3>() += s_sum * Mat3::Identity();
  return sum;
}

bool mayBeDegenerate(const Matrix6& information)
{
  const Vector6 values = symmetricEigenvalues(inLengths(information, leverArmOf(information)));
  return values[0] < kClearlyConstrained * values[5];
}

bool isWeak(const ScanConstraints& constraints, int direction)
{
  return constraints.information[direction] < kClearlyConstrained * constraints.information[5];
}

ScanConstraints informationByDirection(
    const Matrix6& information, const Matrix6& noise_information,
    const TranslationAxes& translations)
{
  ScanConstraints c;
  c.lever_arm = leverArmOf(information);
  const Matrix6 scaled = inLengths(information, c.lever_arm);
  const Square6 noise = inLengths(noise_information, c.lever_arm);
  Square6 V;
  if (translations.cols() == 0)
  {
    const Eigensystem6 system = symmetricEigensystem(scaled);
    V = system.vectors;
    c.information = system.values;
  }
  else
  {
    V = directionsOf(scaled, translations);
    for (int i = 0; i < 6; ++i)
      c.information[i] = V.col(i).dot(Square6(scaled) * V.col(i));
  }
  c.directions = V;
  c.supported_information = c.information;
  for (int i = 0; i < 6; ++i)
    c.noise_information[i] = V.col(i).dot(noise * V.col(i));
  return c;
}

namespace
{
/** The planes are nearly parallel: open ground, or one wall in view. Two translations are weak. */
bool isOpen(const ScanConstraints& c)
{
  const Eigen::Matrix<double, 3, 6> axes = c.directions.bottomRows<3>();
  const Mat3 translation = axes * c.information.asDiagonal() * axes.transpose();
  const Eigensystem3 system = symmetricEigensystem(translation);
  return system.values[1] < kOpen * system.values[2];
}

bool isConstrained(
    const ScanConstraints& c, int direction, double min_signal_to_noise, double supported_part)
{
  const double needed = min_signal_to_noise * c.noise_information[direction];
  if (c.information[direction] > needed &&
      c.supported_information[direction] > supported_part * needed)
    return true;
  return c.information[direction] > kCommonSignal * needed &&
         c.common_information[direction] > kCommonPart * needed && isOpen(c);
}
}  // namespace

void leaveOutUnconstrained(double min_signal_to_noise, ScanConstraints& c, double supported_part)
{
  c.unconstrained = 0;
  Vector6 keep = Vector6::Ones();
  for (int i = 5; i >= 0; --i)
  {
    if (isConstrained(c, i, min_signal_to_noise, supported_part)) continue;
    c.unconstrained = i + 1;
    keep.head(i + 1).setZero();
    break;
  }
  if (c.unconstrained == 0) return;
  Vector6 unit = Vector6::Ones();
  unit.head<3>().setConstant(c.lever_arm);
  const Square6 V = c.directions;
  c.projection =
      unit.cwiseInverse().asDiagonal() * V * keep.asDiagonal() * V.transpose() * unit.asDiagonal();
}

std::vector<MotionDirection> unconstrainedMotions(const ScanConstraints& constraints)
{
  std::vector<MotionDirection> motions;
  for (int i = 0; i < constraints.unconstrained; ++i)
  {
    const Vec3 rotation = constraints.directions.col(i).head<3>();
    const Vec3 translation = constraints.directions.col(i).tail<3>();
    const bool is_rotation = rotation.norm() > translation.norm();
    motions.push_back({is_rotation, (is_rotation ? rotation : translation).normalized()});
  }
  return motions;
}

InformationSums constrainedSums(const InformationSums& sums, const ScanConstraints& constraints)
{
  InformationSums left = sums;
  if (constraints.unconstrained == 0) return left;
  const Square6 projection = constraints.projection;
  const Square6 information = projection.transpose() * sums.HtRinvH * projection;
  left.HtRinvH = 0.5 * (information + information.transpose());
  left.HtRinvz = projection.transpose() * sums.HtRinvz;
  return left;
}

}  // namespace fastlio
