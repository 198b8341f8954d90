// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file closures_test.cpp Loop closures with realistic sensors, against the true poses: where places
 * look alike that are not the same, none may be accepted; where streets are passed again, most have
 * to be found. With FASTLIO_EVERYTHING=1: 50 sensors, whole rides and the traps, from
 * FASTLIO_FIRST_SEED on, with every FASTLIO_STRIDE-th beam. */

#include "repeats.h"
#include "simulated_submaps.h"
#include <fastlio/evaluation/evaluate.h>
#include <fastlio/loops/mapper.h>
#include <fastlio/scenarios/realistic.h>
#include <fastlio/scenarios/settings_table.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace fastlio::testing
{
namespace
{
constexpr const char* kTown = "town";
constexpr const char* kStairs = "stairs";

// A registration that is farther off than its own errors and those of a mounting explain is false:
// 0.5 m, and more only along a direction that it leaves open.
constexpr double kFalse = 0.5;       // [m]
constexpr double kRevisit = 10.0;    // [m]
constexpr double kLeastTravel = 25;  // between passes [m]
/** What a ride has to show. */
struct Ride
{
  const char* scenario;
  double least_recall;
};
constexpr Ride kRides[] = {
    {kTown, 0.8},
    {"facades", 0.8},
    // What is in sight through a door or along a corridor need not have surfaces in common.
    {"corridors", 0.7},
    // A trap only: few surfaces tell the height, and which floor it is may be uncertain.
    {kStairs, 0.0}};

/** An unsigned number in the environment. */
std::uint64_t numberIn(const char* variable, std::uint64_t otherwise)
{
  const char* text = everything() ? std::getenv(variable) : nullptr;
  return text != nullptr ? std::stoull(text) : otherwise;
}

SimulationSettings settingsOf(const std::string& scenario, std::uint64_t seed)
{
  SimulationSettings settings = realistic(defaultSettings(scenario));
  settings.seed = seed;
  settings.lidar.stride = static_cast<int>(numberIn("FASTLIO_STRIDE", 6));
  if (everything()) return settings;
  if (scenario == kStairs)
  {
    settings.lidar.stride = 4;
    return settings;
  }
  settings.lidar.stride = 10;
  settings.speed = 2.0;
  return withSetting(settings, "world.length", "600");
}

MappingResult mapOf(const Simulation& simulation)
{
  Mapper mapper;
  for (Submap& submap : submapsOf(simulation))
    mapper.add(std::move(submap));
  return std::move(mapper).result();
}

bool isFalse(const RelativePose& motion, const Pose& truth)
{
  constexpr double kSigmas = 3.0;
  const Vec3 off = truth.p - motion.T_a_b.p;
  const Mat3 covariance = motion.covariance.bottomRightCorner<3, 3>() +
                          std::pow(kFalse / kSigmas, 2) * Mat3::Identity();
  return off.dot(covariance.inverse() * off) > kSigmas * kSigmas;
}

/** What spoke for a false closure, to find out why. */
void print(const Closure& closure, const Pose& truth)
{
  const RegistrationEvidence& e = closure.registration.evidence;
  const Vec3 off = truth.p - closure.registration.motion.T_a_b.p;
  const Vec3 predicted = truth.p - closure.predicted.T_a_b.p;
  const auto stdOf = [](const RelativePose& motion) -> Vec3
  { return motion.covariance.diagonal().tail<3>().cwiseSqrt(); };
  const Vec3 known = stdOf(closure.registration.motion), expected = stdOf(closure.predicted);
  std::printf(
      "false: %zu - %zu, off by %.2f %.2f %.2f m (std %.2f %.2f %.2f), predicted off by %.2f %.2f "
      "%.2f m (std %.2f %.2f %.2f); overlap %.2f, inliers %.2f to %.3f m, score %.2f, upright "
      "%.2f, "
      "margin %.1f, rival %.2f %.2f %.2f m; %s\n",
      closure.a, closure.b, off.x(), off.y(), off.z(), known.x(), known.y(), known.z(),
      predicted.x(), predicted.y(), predicted.z(), expected.x(), expected.y(), expected.z(),
      e.overlap, e.inlier_ratio, e.residual_rms, e.score, e.upright_score, e.margin, e.rival.x(),
      e.rival.y(), e.rival.z(), closure.reason.c_str());
}

/** Whether two places are neighbours with nothing between them: what lies behind a wall or on
 * another floor has no surface in common. */
bool isInSight(const World& world, const Vec3& a, const Vec3& b, double t)
{
  const double distance = (b - a).norm();
  if (distance >= kRevisit) return false;
  return !world.cast(Ray{a, (b - a) / std::max(distance, 1e-6)}, t, distance);
}

/** What became of the submaps of some rides. */
struct Tally
{
  std::size_t submaps = 0, accepted = 0, wrong = 0;
  // Submaps within sight of a place that was passed before, no wall or ceiling in between.
  std::size_t revisits = 0, recognised = 0;

  void add(const MappingResult& map, const Simulation& simulation)
  {
    std::vector<Pose> truth;
    std::vector<double> travel;  // of the truth: an odometry that is lost may travel anywhere
    for (const Submap& submap : map.submaps)
    {
      const Pose pose = simulation.truth(submap.reference.stamp_ns).T_world_imu;
      travel.push_back(truth.empty() ? 0.0 : travel.back() + (pose.p - truth.back().p).norm());
      truth.push_back(pose);
    }
    std::vector<bool> is_closed(truth.size(), false);
    for (const Closure& closure : map.closures)
    {
      if (closure.verdict != ClosureVerdict::Accepted) continue;
      ++accepted;
      const Pose T_a_b = truth[closure.a].inverse() * truth[closure.b];
      if (isFalse(closure.registration.motion, T_a_b))
      {
        ++wrong;
        print(closure, T_a_b);
      }
      is_closed[closure.b] = true;
    }
    submaps += truth.size();
    for (std::size_t b = 0; b < truth.size(); ++b)
    {
      bool is_revisit = false;
      const double t = simulation.secondsSinceStart(map.submaps[b].reference.stamp_ns);
      for (std::size_t a = 0; a < b && !is_revisit; ++a)
        is_revisit = travel[b] - travel[a] > kLeastTravel &&
                     isInSight(simulation.world(), truth[a].p, truth[b].p, t);
      revisits += is_revisit ? 1 : 0;
      recognised += is_revisit && is_closed[b] ? 1 : 0;
    }
  }

  [[nodiscard]] double recall() const
  {
    return static_cast<double>(recognised) /
           static_cast<double>(std::max<std::size_t>(revisits, 1));
  }
};
}  // namespace

namespace
{
/** Error of the submaps when only heading and place are aligned: the vertical is that of the map;
 * rms [m]. */
double levelError(
    const MappingResult& map, const Simulation& simulation,
    const std::function<Pose(std::size_t)>& pose_of)
{
  Trajectory estimate, truth;
  estimate.source = "estimate";
  truth.source = "truth";
  for (std::size_t i = 0; i < map.submaps.size(); ++i)
  {
    const std::int64_t stamp_ns = map.submaps[i].reference.stamp_ns;
    estimate.poses.push_back({stamp_ns, pose_of(i)});
    truth.poses.push_back({stamp_ns, simulation.truth(stamp_ns).T_world_imu});
  }
  EvaluationOptions options;
  options.alignment = Alignment::Yaw;
  return evaluate(estimate, truth, options).ape.translation.rmse;
}

/** The map stands upright, and roads that pitch by a little all the time are straight again. */
void expectLevel(const MappingResult& map, const Simulation& simulation)
{
  const double before = levelError(
      map, simulation, [&](std::size_t i) { return map.submaps[i].reference.T_world_body; });
  const double after =
      levelError(map, simulation, [&](std::size_t i) { return map.estimate.nodes[i]; });
  std::printf("level error: %.3f m by the odometry, %.3f m in the map\n", before, after);
  if (everything() || simulation.settings().scenario == kStairs) return;
  EXPECT_GT(before, 0.15);
  EXPECT_LT(after, 0.2 * before);
  EXPECT_LT(after, 0.05);
}
}  // namespace

class Closures : public ::testing::TestWithParam<Ride>
{
};

TEST_P(Closures, NoneIsFalseAndMostAreFound)
{
  const std::string scenario = GetParam().scenario;
  if (!everything() && scenario != kTown && scenario != kStairs)
    GTEST_SKIP() << "a ride without its traps shows nothing: FASTLIO_EVERYTHING=1 takes whole ones";
  const std::uint64_t seeds = everything() ? 50 : 1;
  Tally tally;
  // Whole rides of many sensors take hours: a run goes on where one has ended.
  for (std::uint64_t seed = numberIn("FASTLIO_FIRST_SEED", 1); seed <= seeds; ++seed)
  {
    const Simulation simulation(settingsOf(scenario, seed));
    const MappingResult map = mapOf(simulation);
    tally.add(map, simulation);
    expectLevel(map, simulation);
    std::printf(
        "%s, up to seed %d: %zu submaps, %zu closures, %zu false; %zu of %zu revisits recognised\n",
        scenario.c_str(), static_cast<int>(seed), tally.submaps, tally.accepted, tally.wrong,
        tally.recognised, tally.revisits);
    std::fflush(stdout);
    EXPECT_EQ(tally.wrong, 0U) << "seed " << seed;
  }
  EXPECT_GT(tally.revisits, 0U);
  EXPECT_GE(tally.recall(), GetParam().least_recall);
}

INSTANTIATE_TEST_SUITE_P(
    Ride, Closures, ::testing::ValuesIn(kRides),
    [](const auto& parameter) { return std::string(parameter.param.scenario); });

}  // namespace fastlio::testing
