// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Which planes say most about a direction.

#include <fastlio/matching/degeneracy.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

namespace fastlio
{
namespace
{
// Planes that may be wrong at once: in a simulated tunnel one or two of some 600 were.
constexpr std::size_t kDistrustedPlanes = 3;
// So many planes, or this part of all, may be spurious together.
constexpr std::size_t kManyPlanes = 30;
constexpr double kManyPart = 0.05;
// A plane with more than this part of the points is no accident at an edge: the landing of a
// staircase is all that shows the height.
constexpr double kLargePlane = 0.03;
}  // namespace

void StrongestPlanes::reserve(std::size_t points)
{
  planes_.reserve(points);
  makeRoom(of_plane_, points);
  makeRoom(points_of_plane_, points);
}

void StrongestPlanes::look(const MeasuredScan& scan, const std::vector<PlaneMatch>& matches)
{
  planes_.assign(scan, matches);
  points_of_plane_.assign(planes_.count(), 0);
  scan.forEachBlock(
      [&](const MeasurementBlock& block, std::size_t number)
      {
        for (std::size_t l = 0; l < kLanes; ++l)
          if (block.weight[l] > 0.0) ++points_of_plane_[planes_.of(number, l)];
      });
}

TranslationAxes StrongestPlanes::unsupportedTranslations(
    const MeasuredScan& scan, const Matrix6& information, const Matrix6& noise_information,
    double min_signal_to_noise)
{
  const Eigensystem3 system = symmetricEigensystem(Mat3(information.bottomRightCorner<3, 3>()));
  const Mat3 noise = noise_information.bottomRightCorner<3, 3>();
  TranslationAxes axes(3, 0);
  for (int i = 0; i < 3 && system.values[i] < kClearlyConstrained * system.values[2]; ++i)
  {
    Vector6 direction = Vector6::Zero();
    const Vec3 axis = system.vectors.col(i);
    direction.tail<3>() = axis;
    informationAlong(scan, direction, kLargePlane * static_cast<double>(scan.sums().count));
    const double of_few = ofStrongest(kDistrustedPlanes);
    const double needed = min_signal_to_noise * axis.dot(noise * axis);
    if (system.values[i] - of_few > kSupportedPart * needed) break;
    axes.conservativeResize(3, i + 1);
    axes.col(i) = axis;
  }
  return axes;
}

void StrongestPlanes::takeFromSupport(const MeasuredScan& scan, ScanConstraints& constraints)
{
  for (int i = 0; i < 6 && isWeak(constraints, i); ++i)
  {
    Vector6 direction = constraints.directions.col(i);
    direction.head<3>() /= constraints.lever_arm;
    informationAlong(scan, direction, std::numeric_limits<double>::infinity());
    const auto part = static_cast<std::size_t>(kManyPart * static_cast<double>(planes_.count()));
    constraints.common_information[i] =
        constraints.information[i] - ofStrongest(std::max(kManyPlanes, part));
    constraints.supported_information[i] -= ofStrongest(kDistrustedPlanes);
  }
}

void StrongestPlanes::informationAlong(
    const MeasuredScan& scan, const Vector6& direction, double most_points)
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
  for (std::size_t plane = 0; plane < of_plane_.size(); ++plane)
    if (points_of_plane_[plane] > most_points) of_plane_[plane] = 0.0;
}

double StrongestPlanes::ofStrongest(std::size_t planes)
{
  const auto end =
      of_plane_.begin() + static_cast<std::ptrdiff_t>(std::min(planes, of_plane_.size()));
  std::partial_sort(of_plane_.begin(), end, of_plane_.end(), std::greater<>());
  return std::accumulate(of_plane_.begin(), end, 0.0);
}

}  // namespace fastlio
