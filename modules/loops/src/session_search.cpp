// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mapper_parts.h"
#include <fastlio/loops/mapper.h>
#include <fastlio/math/statistics.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace fastlio
{
namespace
{
constexpr std::size_t kPlacesToVerify = 6;
constexpr double kGuessAttitude = 0.06;  // half of the headings' spacing, and tilt [rad]
constexpr double kGuessCells = 0.6;      // position [cells]
constexpr double kSamePlace = 1.0;       // poses nearer than this are one place [m]
constexpr double kLargestMargin = 40.0;  // beyond it, what nobody thought of is likelier

/** Cells of views in which submaps of this length can be distinguished. */
double cellOf(const std::vector<Submap>& submaps)
{
  constexpr double kLeast = 0.5, kMost = 2.0, kOverLength = 1.0 / 6.0;
  std::vector<double> lengths;
  for (std::size_t i = 1; i < submaps.size(); ++i)
    if (submaps[i].session == submaps[i - 1].session)
      lengths.push_back(submaps[i].travel - submaps[i - 1].travel);
  return std::clamp(kOverLength * median(std::move(lengths)), kLeast, kMost);
}

/** Whether two transformations put a submap at the same place. */
bool agree(const Pose& a, const Pose& b, const Submap& submap)
{
  constexpr double kMoved = 1.0, kTurned = 0.05;  // [m], [rad]
  const Vec3& p = submap.reference.T_world_body.p;
  return (a * p - b * p).norm() < kMoved && logSO3(a.R.transpose() * b.R).norm() < kTurned;
}
}  // namespace

/** Looks for the place of the latest floating submap in the whole map. */
void Mapper::searchAnchor()
{
  if (!places_)
  {
    settle();
    places_ = std::make_unique<PlaceIndex>(cellOf(result_.submaps));
    for (std::size_t i = 0; i < result_.submaps.size(); ++i)
      places_->add(result_.submaps[i].surfaces.get()->planes, levelingRotation(poses_[i].R));
  }
  const Submap& query = floating_.back();
  SessionAnchor& anchor = result_.anchors[query.session];
  ++anchor.tried;
  if (query.surfaces.planes() < limits_.min_planes) return;
  const auto found = recognised(query);
  if (!found) return;
  hypotheses_.push_back({found->T_world_session, found->margin, floating_.size() - 1});
  const Hypothesis& latest = hypotheses_.back();
  double alternatives = std::exp(-latest.margin);
  std::size_t support = 1;
  for (const Hypothesis& other : hypotheses_)
  {
    if (other.submap == latest.submap ||
        !agree(other.T_world_session, latest.T_world_session, query))
      continue;
    alternatives *= std::exp(-other.margin);
    ++support;
  }
  if (support < 2) return;
  anchor = {true, latest.T_world_session, 1.0 / (1.0 + alternatives), anchor.tried, support};
}

/** The place of a submap among all, when nothing else is nearly as likely. */
std::optional<Mapper::Hypothesis> Mapper::recognised(const Submap& query) const
{
  const Mat3 level_query = levelingRotation(query.reference.T_world_body.R);
  struct Verified
  {
    Pose T_world_query;
    double cost;
    Registration registration;
  };
  std::vector<Verified> verified;
  const auto surfaces = query.surfaces.get();
  for (const PlaceMatch& match : places_->find(surfaces->planes, level_query, kPlacesToVerify))
  {
    const Pose& T_world_place = poses_[match.place];
    const Mat3 level_place = levelingRotation(T_world_place.R);
    RelativePose predicted;
    predicted.T_a_b = Pose{level_place.transpose(), Vec3::Zero()} * match.T_place_query *
                      Pose{level_query, Vec3::Zero()};
    predicted.covariance = Matrix6::Zero();
    predicted.covariance.diagonal().head<3>().setConstant(kGuessAttitude * kGuessAttitude);
    predicted.covariance.diagonal().tail<3>().setConstant(
        std::pow(kGuessCells * places_->cell(), 2));
    const Registration registration =
        SubmapRegistration(result_.submaps[match.place].surfaces.get()->planes, workers_)
            .search(surfaces->planes, predicted, T_world_place.R.transpose() * Vec3::UnitZ());
    if (!registration.converged) continue;
    verified.push_back(
        {T_world_place * registration.motion.T_a_b, registration.evidence.cost, registration});
  }
  auto best = std::min_element(
      verified.begin(), verified.end(),
      [](const Verified& a, const Verified& b) { return a.cost < b.cost; });
  if (best == verified.end()) return std::nullopt;
  double& margin = best->registration.evidence.margin;
  for (const Verified& other : verified)
    if ((other.T_world_query.p - best->T_world_query.p).norm() > kSamePlace)
      margin = std::min(margin, other.cost - best->cost);
  if (shortcomingOf(best->registration, limits_)) return std::nullopt;
  return Hypothesis{
      best->T_world_query * query.reference.T_world_body.inverse(),
      std::min(margin, kLargestMargin), 0};
}

}  // namespace fastlio
