// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "registration_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace fastlio
{
namespace
{
constexpr double kStartSpacing = 1.5;     // between starts [m]
constexpr double kHeadingSpacing = 0.12;  // between starts [rad]
constexpr double kStartReach = 3.0;       // starts lie within so many standard deviations
constexpr int kMostSteps = 8;             // of starts in a direction
// Each costs about a millisecond: where all directions are lost, a pair must not take minutes.
constexpr std::size_t kMostStarts = 3000;

/** A direction in which the prediction is uncertain. */
struct SearchAxis
{
  Vec3 direction;
  double std = 0.0;
  int steps = 0;  //!< to either side
};

struct Start
{
  Pose pose;
  double squared = 0.0;  //!< distance from the prediction, in standard deviations
};

/** The likeliest ones, in the order that they have. */
std::vector<Pose> likeliest(const std::vector<Start>& starts)
{
  double farthest = std::numeric_limits<double>::infinity();
  if (starts.size() > kMostStarts)
  {
    std::vector<double> squared;
    squared.reserve(starts.size());
    for (const Start& start : starts)
      squared.push_back(start.squared);
    const auto last = squared.begin() + static_cast<std::ptrdiff_t>(kMostStarts);
    std::nth_element(squared.begin(), last, squared.end());
    farthest = *last;
  }
  std::vector<Pose> poses;
  for (const Start& start : starts)
    if (start.squared < farthest) poses.push_back(start.pose);
  return poses;
}

int stepsFor(double std, double spacing)
{
  return std::min(
      kMostSteps, static_cast<int>(std::ceil(std::max(0.0, kStartReach * std / spacing - 0.5))));
}
}  // namespace

std::vector<Pose> startsAround(const RelativePose& predicted, const Vec3& up)
{
  const Eigensystem3 position =
      symmetricEigensystem(Mat3(predicted.covariance.bottomRightCorner<3, 3>()));
  std::array<SearchAxis, 3> axes;
  for (int k = 0; k < 3; ++k)
  {
    const double std = std::sqrt(std::max(0.0, position.values[k]));
    axes.at(static_cast<std::size_t>(k)) = {
        position.vectors.col(k), std, stepsFor(std, kStartSpacing)};
  }
  const Vec3 up_in_source = predicted.T_a_b.R.transpose() * up;
  const Mat3 attitude = predicted.covariance.topLeftCorner<3, 3>();
  const double heading_std = std::sqrt(std::max(0.0, up_in_source.dot(attitude * up_in_source)));
  const int headings = stepsFor(heading_std, kHeadingSpacing);
  std::vector<Start> starts{{predicted.T_a_b}};
  for (int h = -headings; h <= headings; ++h)
    for (int i = -axes[0].steps; i <= axes[0].steps; ++i)
      for (int j = -axes[1].steps; j <= axes[1].steps; ++j)
        for (int k = -axes[2].steps; k <= axes[2].steps; ++k)
        {
          if (h == 0 && i == 0 && j == 0 && k == 0) continue;
          double squared = 0.0;  // how unlikely the place is
          Vec3 moved = Vec3::Zero();
          const std::array steps = {i, j, k};
          for (std::size_t axis = 0; axis < axes.size(); ++axis)
          {
            if (steps.at(axis) == 0) continue;
            const double way = kStartSpacing * steps.at(axis);
            moved += way * axes.at(axis).direction;
            squared +=
                std::pow(std::max(0.0, std::abs(way) - 0.5 * kStartSpacing) / axes.at(axis).std, 2);
          }
          if (squared > kStartReach * kStartReach) continue;
          const Pose pose{
              expSO3(h * kHeadingSpacing * up) * predicted.T_a_b.R, predicted.T_a_b.p + moved};
          if (h != 0) squared += std::pow(kHeadingSpacing * h / heading_std, 2);
          starts.push_back({pose, squared});
        }
  return likeliest(starts);
}

}  // namespace fastlio
