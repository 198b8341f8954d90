// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "wheel_steps.h"
#include <fastlio/aiding/wheels.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kScaleStd = 0.02;   // of wheels that are not known better: worn, loaded tyres
constexpr double kWellKnown = 0.03;  // standard deviation over way of what wheels are compared with
constexpr double kAgreement = 4.0;   // standard deviations
constexpr double kMostContradicted = 0.34;  // of the comparisons
constexpr double kLeastChecks = 3;          // before contradictions count
constexpr double kNeed = 2.0;        // wheels take part where the odometry is so much less certain
constexpr double kLeastWay = 0.5;    // of a motion [m]
constexpr double kOpen = 100.0;      // standard deviation of what wheels do not measure [m], [rad]
constexpr double kLeastStd = 0.002;  // [m]
constexpr int kScaleRounds = 3;
}  // namespace

/** A motion by the wheels beside that of LiDAR, IMU and closures. */
struct WheelFactors::Comparison
{
  Vec3 direction;       //!< of the motion, IMU frame of a
  double rolled = 0.0;  //!< along it, by the wheels [m]
  double moved = 0.0;   //!< along it, by all others [m]
  double std = 0.0;     //!< of the latter [m]
  bool usable = false;
};

std::string wheelSentence(const WheelOutcome& outcome)
{
  std::string text =
      outcome.used ? mrpt::format(
                         "wheel odometry determines %zu of %zu motions between submaps, which the "
                         "LiDAR leaves open",
                         outcome.taking_part, outcome.motions)
                   : "wheel odometry is not used: " + outcome.reason;
  text += mrpt::format(
      "; its way counts %.4f (to %.4f), noise %.3f m after 1 m; it agrees with %zu of %zu motions "
      "that the LiDAR knows",
      outcome.scale, outcome.scale_std, outcome.noise, outcome.checks - outcome.contradicted,
      outcome.checks);
  if (outcome.slipped > 0)
    text += mrpt::format(
        "; wheels slipped during %zu motions, which are not believed", outcome.slipped);
  return text;
}

void WheelFactors::add(
    const std::vector<WheelPose>& readings, const Pose& T_vehicle_imu, const PoseTrack& track,
    std::size_t session, const Mapper& mapper)
{
  if (readings.empty()) return;
  readings_ += readings.size();
  const WheelSteps wheels = wheelSteps(readings, T_vehicle_imu, track);
  noise_variances_.resize(std::max(noise_variances_.size(), session + 1), 0.0);
  noise_variances_[session] = wheels.noise_variance;
  const std::vector<Submap>& submaps = mapper.submaps();
  std::size_t step = 0;
  for (std::size_t b = 1; b < submaps.size(); ++b)
  {
    const TrackedPose &from = submaps[b - 1].reference, &to = submaps[b].reference;
    if (submaps[b].session != session || submaps[b - 1].session != session) continue;
    Motion motion;
    motion.a = b - 1;
    motion.b = b;
    bool known = true;
    for (; step < wheels.steps.size() && wheels.steps[step].begin_ns < to.stamp_ns; ++step)
    {
      const WheelStep& s = wheels.steps[step];
      if (s.begin_ns < from.stamp_ns) continue;
      known = known && s.known;
      motion.rolled += s.rolled;
      motion.way += std::abs(s.along);
      motion.slipped = motion.slipped || s.slipped;
    }
    if (!known) continue;
    const Mat3 back = from.T_world_body.R.transpose();
    const Mat3& R_vehicle_imu = T_vehicle_imu.R;
    // The IMU swings about the vehicle's origin: p_imu = p_vehicle + R_vehicle t.
    const Vec3 arm = R_vehicle_imu.transpose() * T_vehicle_imu.p;
    motion.swung = back * (to.T_world_body.R - from.T_world_body.R) * arm;
    motion.rolled = back * motion.rolled;
    motions_.push_back(motion);
  }
}

WheelFactors::Comparison WheelFactors::comparedWith(
    const MappingResult& result, const Motion& motion) const
{
  Comparison compared;
  compared.rolled = motion.rolled.norm();
  compared.usable = !motion.slipped && compared.rolled > kLeastWay;
  if (!compared.usable) return compared;
  compared.direction = motion.rolled / compared.rolled;
  const Pose T_a_b =
      result.estimate.nodes.at(motion.a).inverse() * result.estimate.nodes.at(motion.b);
  compared.moved = compared.direction.dot(T_a_b.p - motion.swung);
  const RelativePose odometry =
      relativePose(result.submaps.at(motion.a).reference, result.submaps.at(motion.b).reference);
  const Mat3 position = withFloor(odometry.covariance).bottomRightCorner<3, 3>();
  compared.std = std::sqrt(compared.direction.dot(position * compared.direction));
  return compared;
}

/** By what LiDAR and IMU know well; what contradicts it does not count. */
void WheelFactors::findScale(const MappingResult& result, WheelOutcome& outcome) const
{
  for (int round = 0; round < kScaleRounds; ++round)
  {
    double information = 1.0 / (kScaleStd * kScaleStd), sum = information;
    outcome.checks = outcome.contradicted = 0;
    const double known = round == 0 ? kScaleStd : outcome.scale_std;
    for (const Motion& motion : motions_)
    {
      const Comparison c = comparedWith(result, motion);
      if (!c.usable || c.std > kWellKnown * c.rolled) continue;
      ++outcome.checks;
      const double variance = c.std * c.std + outcome.noise * outcome.noise * motion.way;
      const double limit = kAgreement * std::sqrt(variance + known * known * c.rolled * c.rolled);
      if (std::abs(c.moved - outcome.scale * c.rolled) > limit)
      {
        ++outcome.contradicted;
        continue;
      }
      information += c.rolled * c.rolled / variance;
      sum += c.rolled * c.moved / variance;
    }
    outcome.scale = sum / information;
    outcome.scale_std = 1.0 / std::sqrt(information);
  }
}

WheelOutcome WheelFactors::applyTo(MappingResult& result) const
{
  WheelOutcome outcome;
  outcome.readings = readings_;
  outcome.motions = motions_.size();
  outcome.slipped = static_cast<std::size_t>(
      std::count_if(motions_.begin(), motions_.end(), [](const Motion& m) { return m.slipped; }));
  for (const double variance : noise_variances_)
    outcome.noise = std::max(outcome.noise, std::sqrt(variance));
  findScale(result, outcome);
  const auto contradicted = static_cast<double>(outcome.contradicted);
  const auto checks = static_cast<double>(outcome.checks);
  if (checks >= kLeastChecks && contradicted > kMostContradicted * checks)
  {
    outcome.reason = mrpt::format(
        "%zu of %zu motions that the LiDAR knows contradict it", outcome.contradicted,
        outcome.checks);
    return outcome;
  }
  std::vector<GraphEdge> edges;
  double rolled = 0.0;
  for (const Motion& motion : motions_)
    rolled += motion.rolled.norm();
  for (const Motion& motion : motions_)
  {
    const Comparison c = comparedWith(result, motion);
    if (!c.usable) continue;
    // The error of the scale is the same for all motions: it adds up.
    const double variance = kLeastStd * kLeastStd + outcome.noise * outcome.noise * motion.way +
                            outcome.scale_std * outcome.scale_std * c.rolled * rolled;
    if (c.std < std::max(kWellKnown * c.rolled, kNeed * std::sqrt(variance))) continue;
    RelativePose measured =
        relativePose(result.submaps.at(motion.a).reference, result.submaps.at(motion.b).reference);
    const Vec3 d = c.direction;
    measured.T_a_b.p += d * (outcome.scale * c.rolled - d.dot(measured.T_a_b.p - motion.swung));
    measured.covariance = kOpen * kOpen * Matrix6::Identity();
    measured.covariance.bottomRightCorner<3, 3>() += (variance - kOpen * kOpen) * d * d.transpose();
    edges.push_back({motion.a, motion.b, measured, true});
  }
  outcome.taking_part = edges.size();
  outcome.used = !edges.empty();
  if (!outcome.used)
  {
    outcome.reason = motions_.empty() ? "there are no readings at the submaps"
                                      : "LiDAR and IMU know all motions as well by themselves";
    return outcome;
  }
  result.graph.nodes = result.estimate.nodes;
  result.graph.edges.insert(result.graph.edges.end(), edges.begin(), edges.end());
  result.estimate = optimize(result.graph);
  makeLevel(result);
  result.corrected = true;
  return outcome;
}

}  // namespace fastlio
