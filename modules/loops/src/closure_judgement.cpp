// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mapper_parts.h"
#include <fastlio/loops/mapper.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kOpen = 10.0;      // as of directions that nothing constrains [m]
constexpr double kVertical = 0.95;  // cosine between the vertical and a height that stays open

/** The direction of the position that is known weakly, or along which another place is nearly as
 * likely, in the frame of the target. */
std::optional<Vec3> weakDirection(const Registration& registration, const ClosureLimits& limits)
{
  const Mat3 position = registration.motion.covariance.bottomRightCorner<3, 3>();
  const auto system = symmetricEigensystem(position);
  const bool is_known = system.values.z() <= std::pow(limits.max_position_std, 2) &&
                        registration.evidence.planes_across[0] >= limits.min_planes_across &&
                        registration.evidence.margin >= limits.min_margin;
  if (is_known) return std::nullopt;
  return Vec3(system.vectors.col(2));
}

/** How uncertain the height is [m]. */
double heightStd(const RelativePose& predicted, const Vec3& up)
{
  const Mat3 position = predicted.covariance.bottomRightCorner<3, 3>();
  return std::sqrt(up.dot(position * up));
}

/** How uncertain the place on the floor is, in its least known direction [m]. */
double floorStd(const RelativePose& predicted, const Vec3& up)
{
  const Mat3 level = Mat3::Identity() - up * up.transpose();
  const Mat3 position = predicted.covariance.bottomRightCorner<3, 3>();
  return std::sqrt(symmetricEigensystem(Mat3(level * position * level)).values[2]);
}

/** Ceilings are in view: planes that are seen from below. In simulated streets, crowns and eaves
 * are up to 2.4 % of a submap's planes; in corridors, ceilings are 9 % or more in nine of ten
 * submaps. */
bool isBelowCeiling(const std::vector<VoxelPlane>& planes, const Vec3& up)
{
  constexpr double kLevelCosine = 0.9, kCeilings = 0.04;
  const auto is_ceiling = [&up](const VoxelPlane& plane)
  { return plane.normal().dot(up) < -kLevelCosine; };
  const auto ceilings = std::count_if(planes.begin(), planes.end(), is_ceiling);
  return static_cast<double>(ceilings) > kCeilings * static_cast<double>(planes.size());
}

void decide(Closure& closure, ClosureVerdict verdict, std::string reason)
{
  closure.verdict = verdict;
  closure.reason = std::move(reason);
}
}  // namespace

const char* toString(ClosureVerdict verdict)
{
  switch (verdict)
  {
    case ClosureVerdict::Accepted:
      return "accepted";
    case ClosureVerdict::FewPlanes:
      return "few_planes";
    case ClosureVerdict::Unpredicted:
      return "unpredicted";
    case ClosureVerdict::LittleOverlap:
      return "little_overlap";
    case ClosureVerdict::PoorFit:
      return "poor_fit";
    case ClosureVerdict::Ambiguous:
      return "ambiguous";
    case ClosureVerdict::OutOfReach:
      return "out_of_reach";
    case ClosureVerdict::Uninformative:
      return "uninformative";
    case ClosureVerdict::Contradicted:
      return "contradicted";
  }
  return "unknown";
}

std::optional<Shortcoming> shortcomingOf(
    const Registration& registration, const ClosureLimits& limits)
{
  const RegistrationEvidence& found = registration.evidence;
  if (!registration.converged || found.overlap < limits.min_overlap)
    return Shortcoming{
        ClosureVerdict::LittleOverlap,
        mrpt::format(
            "%.0f %% of the surfaces have a counterpart, below %.0f %%", 100.0 * found.overlap,
            100.0 * limits.min_overlap)};
  if (found.upright_score < limits.min_upright)
    return Shortcoming{
        ClosureVerdict::LittleOverlap,
        mrpt::format(
            "%.0f %% of the upright surfaces agree, below %.0f %%", 100.0 * found.upright_score,
            100.0 * limits.min_upright)};
  if (found.inlier_ratio < limits.min_inlier_ratio || found.residual_rms > limits.max_residual)
    return Shortcoming{
        ClosureVerdict::PoorFit,
        mrpt::format(
            "%.0f %% of the counterparts agree (at least %.0f %%), to %.3f m (at most %.3f m)",
            100.0 * found.inlier_ratio, 100.0 * limits.min_inlier_ratio, found.residual_rms,
            limits.max_residual)};
  const double margin = limits.open_directions > 0 ? found.margin_across : found.margin;
  if (margin < limits.min_margin)
    return Shortcoming{
        ClosureVerdict::Ambiguous,
        mrpt::format(
            "another place, %.1f m away, is nearly as likely (margin %.1f, at least %.1f)",
            found.rival.norm(), margin, limits.min_margin)};
  const double std = positionStd(registration.motion.covariance, 2 - limits.open_directions);
  const double across = found.planes_across[limits.open_directions];
  if (std > limits.max_position_std || across < limits.min_planes_across)
    return Shortcoming{
        ClosureVerdict::Uninformative,
        mrpt::format(
            "the surfaces leave a direction open: they tell it to %.2f m (at most %.2f m), by %.1f "
            "planes (at least %.0f)",
            std, limits.max_position_std, across, limits.min_planes_across)};
  return std::nullopt;
}

/** Whether the odometry knows which floor this is, and the place on it. Between the walls of a
 * stairwell, the height may stay open then. */
bool Mapper::isFloorKnown(const RelativePose& predicted, const Vec3& up) const
{
  return limits_.narrow_deviation * heightStd(predicted, up) <= limits_.least_storey &&
         floorStd(predicted, up) <= limits_.known_place_std;
}

ClosureLimits Mapper::limitsFor(
    const Closure& closure, const Surroundings& around, const std::optional<Vec3>& weak) const
{
  ClosureLimits limits = limits_;
  const double std = largestPositionStd(closure.predicted.covariance);
  const bool is_leafy = closure.registration.evidence.upright_score < limits.min_upright;
  if (around.isNarrow()) limits.max_deviation = limits.narrow_deviation;
  if (!around.isNarrow() && std <= limits.maxStd(around.range))
  {
    // Not both: the ground and a wall fit anywhere along it, also on the next turn of a ramp.
    if (is_leafy)
      limits.min_upright = limits.known_place_overlap;
    else
      limits.open_directions = 1;
  }
  const bool is_height = weak && std::abs(weak->dot(around.up)) > kVertical;
  if (around.isNarrow() && is_height && isFloorKnown(closure.predicted, around.up))
    limits.open_directions = 1;
  if (std > limits.known_place_std) return limits;
  limits.min_overlap = limits.min_upright = limits.known_place_overlap;
  limits.open_directions = 1;
  return limits;
}

void Mapper::judge(
    Closure& closure, const ClosureLimits& limits, const std::optional<Vec3>& open) const
{
  if (auto shortcoming = shortcomingOf(closure.registration, limits))
    return decide(closure, shortcoming->verdict, std::move(shortcoming->reason));
  RelativePose& motion = closure.registration.motion;
  GraphEdge edge{0, 1, motion, true};
  // With an open direction little is left that could show a wrong attitude: the odometry alone says
  // what is too far off.
  if (open)
  {
    edge.measured.covariance.setZero();
    motion.covariance.bottomRightCorner<3, 3>() += kOpen * kOpen * *open * open->transpose();
  }
  edge.measured.covariance = withFloor(edge.measured.covariance + closure.predicted.covariance);
  const double deviation = std::sqrt(squaredError(edge, Pose{}, closure.predicted.T_a_b));
  const double moved = (motion.T_a_b.p - closure.predicted.T_a_b.p).norm();
  if (deviation > limits.max_deviation)
    return decide(
        closure, ClosureVerdict::OutOfReach,
        mrpt::format(
            "%.2f m from where the odometry has it: %.1f standard deviations, at most %.1f are "
            "allowed",
            moved, deviation, limits.max_deviation));
  accept(closure, open ? "; one direction stays open" : "");
}

Closure Mapper::compared(std::size_t a, std::size_t b) const
{
  Closure closure;
  closure.a = a;
  closure.b = b;
  closure.predicted = predictedMotion(a, b);
  const auto target = result_.submaps[a].surfaces.get(), source = result_.submaps[b].surfaces.get();
  if (std::min(target->planes.size(), source->planes.size()) < limits_.min_planes)
  {
    closure.reason = mrpt::format(
        "%zu and %zu planes: at least %zu are needed", target->planes.size(), source->planes.size(),
        limits_.min_planes);
    return closure;
  }
  Surroundings around;
  around.up = poses_[a].R.transpose() * Vec3::UnitZ();
  around.range = std::min(result_.submaps[a].range, result_.submaps[b].range);
  around.below_ceiling = isBelowCeiling(target->planes, around.up) ||
                         isBelowCeiling(source->planes, poses_[b].R.transpose() * Vec3::UnitZ());
  const SubmapRegistration surfaces(target->planes, workers_);
  Registration& found = closure.registration;
  found = surfaces.search(source->planes, closure.predicted, around.up);
  const std::optional<Vec3> weak = weakDirection(found, limits_);
  const ClosureLimits limits = limitsFor(closure, around, weak);
  const std::optional<Vec3> open = limits.open_directions > 0 ? weak : std::nullopt;
  if (open)
    found = surfaces.alignedAcross(*open, source->planes, found, closure.predicted, around.up);
  judge(closure, limits, open);
  if (around.isNarrow() && closure.verdict == ClosureVerdict::Accepted)
    judgePrediction(closure, around);
  return closure;
}

/** What has been found in a narrow place may be the next floor or room, which looks the same. */
void Mapper::judgePrediction(Closure& closure, const Surroundings& around) const
{
  const double height_std = heightStd(closure.predicted, around.up);
  if (around.below_ceiling && limits_.narrow_deviation * height_std > limits_.least_storey)
    return decide(
        closure, ClosureVerdict::Unpredicted,
        mrpt::format(
            "the odometry is %.1f m uncertain in height: the next floor may look the same",
            height_std));
  const double std = largestPositionStd(closure.predicted.covariance);
  closure.needs_agreement = std > limits_.maxStd(around.range);
  if (closure.needs_agreement)
    decide(
        closure, ClosureVerdict::Unpredicted,
        mrpt::format(
            "the odometry is %.1f m uncertain, more than %.1f m, with %.1f m in view: a place that "
            "looks the same may be another one, and no other closure agrees",
            std, limits_.maxStd(around.range), around.range));
}

}  // namespace fastlio
