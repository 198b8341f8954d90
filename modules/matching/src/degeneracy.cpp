// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "information_lanes.h"
#include <fastlio/matching/degeneracy.h>

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace fastlio
{
namespace
{
using Square6 = Eigen::Matrix<double, 6, 6>;

// Scans whose weakest direction has more than this fraction of the strongest one's information are
// far from degenerate: normals would have to be off by tens of degrees.
constexpr double kClearlyConstrained = 0.05;
// Planes that may be wrong at once: in a simulated tunnel one or two of some 600 were.
constexpr std::size_t kDistrustedPlanes = 3;
// Without them, this part of the signal-to-noise ratio has to be left. Of realistic sensors in
// tunnels and stairwells spurious planes leave up to a half, a floor that only near points see
// more.
constexpr double kSupportedPart = 0.6;

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

ScanConstraints informationByDirection(const Matrix6& information, const Matrix6& noise_information)
{
  ScanConstraints c;
  c.lever_arm = leverArmOf(information);
  const Matrix6 scaled = inLengths(information, c.lever_arm);
  const Eigensystem6 system = symmetricEigensystem(scaled);
  const Square6 noise = inLengths(noise_information, c.lever_arm);
  const Square6 V = system.vectors;
  c.directions = V;
  c.information = system.values;
  c.supported_information = system.values;
  for (int i = 0; i < 6; ++i)
    c.noise_information[i] = V.col(i).dot(noise * V.col(i));
  return c;
}

void StrongestPlanes::reserve(std::size_t points)
{
  planes_.reserve(points);
  makeRoom(of_plane_, points);
}

void StrongestPlanes::takeFromSupport(
    const MeasuredScan& scan, const std::vector<PlaneMatch>& matches, ScanConstraints& constraints)
{
  if (!isWeak(constraints, 0)) return;
  planes_.assign(scan, matches);
  for (int i = 0; i < 6 && isWeak(constraints, i); ++i)
  {
    Vector6 direction = constraints.directions.col(i);
    direction.head<3>() /= constraints.lever_arm;
    constraints.supported_information[i] -= informationAlong(scan, direction);
  }
}

double StrongestPlanes::informationAlong(const MeasuredScan& scan, const Vector6& direction)
{
  of_plane_.assign(planes_.count(), 0.0);
  scan.forEachBlock(
      [&](const MeasurementBlock& block, std::size_t number)
      {
        double information[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l)
        {
          double along = 0.0;
          for (std::size_t k = 0; k < 6; ++k)
            along += block.h[k][l] * direction[static_cast<Eigen::Index>(k)];
          information[l] = block.weight[l] * along * along;
        }
        for (std::size_t l = 0; l < kLanes; ++l)
          of_plane_[planes_.of(number, l)] += information[l];
      });
  std::array<double, kDistrustedPlanes> most{};  // descending
  for (double information : of_plane_)
    for (double& kept : most)
      if (information > kept) std::swap(information, kept);
  return std::accumulate(most.begin(), most.end(), 0.0);
}

void leaveOutUnconstrained(double min_signal_to_noise, ScanConstraints& c)
{
  c.unconstrained = 0;
  Vector6 keep = Vector6::Ones();
  for (int i = 5; i >= 0; --i)
  {
    const double needed = min_signal_to_noise * c.noise_information[i];
    if (c.information[i] <= needed || c.supported_information[i] <= kSupportedPart * needed)
    {
      c.unconstrained = i + 1;
      keep.head(i + 1).setZero();
      break;
    }
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
