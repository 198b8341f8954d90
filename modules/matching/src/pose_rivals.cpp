// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/matching/match_evidence.h>
#include <fastlio/matching/pose_search.h>
#include <fastlio/math/linear_algebra.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace fastlio
{
namespace
{
// Of the prediction: farther off it is excluded.
constexpr double kSigmas = 3.0;
// The start of a match and its gate. A wider one would pull the rival to the place that was found.
constexpr StartWidth kNarrow{0.02, 0.003};
constexpr double kStep = 0.08;  // what that gate reaches, on both sides [m]
constexpr int kIterations = 5;
constexpr double kApart = 0.1;  // what is nearer is the same place [m]
// Of the information along the axis that the found place has. Where steps or shelves repeat, a
// rival has about as much; elsewhere mostly less than a tenth.
constexpr double kAsGood = 0.25;

/** Of a match, along an axis; less where the points do not fit. */
double informationAlong(const Vec3& axis, const InformationSums& sums)
{
  const double information = axis.dot(sums.HtRinvH.bottomRightCorner<3, 3>() * axis);
  return information / std::max(1.0, normalizedInnovation(sums));
}

/** The translation that a match shows least, of those that it shows better than the prediction. */
std::optional<Vec3> leastKnownAxis(const InformationSums& sums)
{
  const Eigensystem3 known = symmetricEigensystem(Mat3(sums.HtRinvH.bottomRightCorner<3, 3>()));
  for (int i = 0; i < 3; ++i)  // in ascending order
    if (known.values[i] * kUnambiguousStd * kUnambiguousStd >= 1.0) return known.vectors.col(i);
  return std::nullopt;
}
}  // namespace

Vec3 farthestRival(
    const FilterState& predicted, const Pose& found, const DeskewedScan& scan,
    const MatchFromStarts& match)
{
  const auto startAt = [&](const Pose& pose) { return poseStartAt(predicted, pose, kNarrow); };
  const PoseMatch best = match({startAt(found)}, scan, kIterations).front();
  const std::optional<Vec3> axis = best.updated ? leastKnownAxis(best.sums) : std::nullopt;
  if (!axis) return Vec3::Zero();
  const Mat3 P = predicted.P.block<3, 3>(kPosition, kPosition);
  const double std = std::sqrt(axis->dot(P * *axis));
  const double begin = axis->dot(predicted.x.p - found.p) - kSigmas * std;
  std::vector<PoseStart> starts;
  for (int i = 0; i * kStep <= 2.0 * kSigmas * std; ++i)
  {
    const Vec3 offset = (begin + i * kStep) * *axis;
    if (offset.norm() >= kStep) starts.push_back(startAt({found.R, found.p + offset}));
  }
  const double needed = kAsGood * informationAlong(*axis, best.sums);
  Vec3 farthest = Vec3::Zero();
  for (const PoseMatch& rival : match(starts, scan, kIterations))
  {
    const Vec3 offset = rival.T_world_imu.p - best.T_world_imu.p;
    if (!rival.updated || offset.norm() < std::max(kApart, farthest.norm())) continue;
    if (informationAlong(*axis, rival.sums) >= needed) farthest = offset;
  }
  return farthest;
}

}  // namespace fastlio
