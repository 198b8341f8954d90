// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "carrier_vibration.h"
#include "caster.h"
#include "packet_loss.h"
#include <fastlio/math/time.h>
#include <fastlio/scenarios/random_stream.h>
#include <fastlio/scenarios/scenario.h>
#include <fastlio/scenarios/session_changes.h>
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/simulation/simulation.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kFinalRest = 1.0;                 // after the stop [s]
constexpr std::int64_t kFirstShotNs = 13'700'000;  // LiDAR and IMU do not start at the same time

bool walksOneLoop(const SimulationSettings& s, const Scenario& row, const CarrierPath& path)
{
  return s.duration <= 0.0 && row.duration <= 0.0 && path.loop_time > 0.0;
}

MotionTiming timingFor(const SimulationSettings& s, const Scenario& row, const Scene& scene)
{
  MotionTiming timing;
  timing.blend = scene.blend;
  timing.rest = s.rest;
  timing.rate = s.speed;
  timing.start = s.path_start;
  if (walksOneLoop(s, row, scene.path)) timing.stop_at = s.path_start + scene.path.loop_time;
  return timing;
}

SimulationSettings completed(SimulationSettings s, const Scenario& row, const MotionTiming& timing)
{
  if (s.duration > 0.0) return s;
  s.duration = row.duration > 0.0 ? row.duration : timing.stopTime() + kFinalRest;
  return s;
}

std::size_t completeSweeps(const LidarModel& lidar, std::int64_t end_ns)
{
  std::size_t count = 0;
  while (lidar.stampOf(count + 1) <= end_ns)
    ++count;
  return count;
}

/** Dust or rain in the way: a weak return from somewhere before the surface, mostly near. */
void addFalseReturns(std::vector<Echo>& echoes, const SimulationSettings& s, std::size_t index)
{
  if (s.lidar.beam.false_returns == 0.0) return;
  constexpr double kReach = 10.0;  // farther drops return too little light [m]
  constexpr float kIntensity = 4.0F;
  RandomStream random(s.seed, NoiseSource::FalseReturn, index);
  for (auto& echo : echoes)
  {
    // Both are drawn for every shot, so that a setting does not change the other shots' numbers.
    const bool is_false = random.uniform() < s.lidar.beam.false_returns;
    const double depth = random.uniform();
    const double reach = echo.range > 0.0 ? std::min(echo.range, kReach) : kReach;
    if (!is_false || reach <= s.lidar.min_range) continue;
    echo = {s.lidar.min_range + depth * depth * (reach - s.lidar.min_range), kIntensity};
  }
}

void losePackets(FiredSweep& fired, std::size_t shots_per_packet)
{
  for (std::size_t i = 0; i < fired.echoes.size() && !fired.packet_lost.empty(); ++i)
    if (fired.packet_lost[i / shots_per_packet]) fired.echoes[i] = {};
}

void addRangeNoise(std::vector<Echo>& echoes, const SimulationSettings& s, std::size_t index)
{
  RandomStream noise(s.seed, NoiseSource::Range, index);
  RandomStream dropout(s.seed, NoiseSource::RangeDropout, index);
  for (auto& echo : echoes)
  {
    if (echo.range <= 0.0) continue;
    // Both are drawn for every echo, so that neither setting changes the other's numbers.
    const double error = s.lidar.range_noise * noise.normal();
    const bool lost = dropout.uniform() < s.lidar.dropout;
    echo = lost ? Echo{} : Echo{std::max(echo.range + error, 0.0), echo.intensity};
  }
}
}  // namespace

/** The objects that the constructor makes before the members. */
struct Simulation::Parts
{
  SimulationSettings settings;
  Motion motion;
  World world;

  static Parts make(const SimulationSettings& settings)
  {
    requireValid(settings);
    const Scenario& row = findScenario(settings.scenario);
    Scene scene = row.scene(settings.world);
    applySession(scene, settings.world);
    const MotionTiming timing = timingFor(settings, row, scene);
    addVibration(scene.path, settings);
    return {
        completed(settings, row, timing), Motion(std::move(scene.path), timing),
        World(std::move(scene.world))};
  }
};

Simulation::Simulation(const SimulationSettings& settings) : Simulation(Parts::make(settings)) {}

Simulation::Simulation(Parts parts)
    : settings_(std::move(parts.settings)),
      motion_(std::move(parts.motion)),
      world_(std::move(parts.world)),
      imu_(simulateImu(motion_, settings_)),
      gnss_(simulateGnss(motion_, settings_)),
      wheels_(simulateWheels(motion_, settings_)),
      lidar_(makeLidarModel(settings_.lidar, settings_.start_ns + kFirstShotNs)),
      lidar_errors_(drawLidarErrors(settings_)),
      scan_count_(completeSweeps(*lidar_, settings_.start_ns + toNanoseconds(settings_.duration)))
{
}

FiredSweep Simulation::fire(std::size_t index) const
{
  FiredSweep fired;
  fired.sweep = lidar_->sweep(index);
  fired.packet_lost = lostPackets(fired.sweep, index, settings_);
  const Caster caster(*this);
  fired.echoes = caster.cast(fired.sweep);
  addFalseReturns(fired.echoes, settings_, index);
  addRangeNoise(fired.echoes, settings_, index);
  losePackets(fired, shotsPerPacket(settings_.lidar));
  return fired;
}

LidarScan Simulation::scan(std::size_t index) const
{
  const FiredSweep fired = fire(index);
  LidarScan scan;
  scan.stamp_ns = stampOfLidar(fired.sweep.stamp_ns, settings_);
  scan.points = pointsOf(fired);
  scan.T_imu_lidar = settings_.lidar.T_imu_lidar;
  scan.dropped_invalid = fired.sweep.shots.size() - scan.points.size();
  return scan;
}

Kinematics Simulation::truth(std::int64_t stamp_ns) const
{
  return motion_.at(secondsSinceStart(stamp_ns));
}

double Simulation::secondsSinceStart(std::int64_t stamp_ns) const
{
  return static_cast<double>(stamp_ns - settings_.start_ns) / kNsPerSecond;
}

PointColumns pointsOf(const FiredSweep& fired)
{
  PointColumns points;
  points.reserve(fired.echoes.size());
  for (std::size_t i = 0; i < fired.echoes.size(); ++i)
  {
    const Echo& echo = fired.echoes[i];
    if (echo.range <= 0.0) continue;
    const Shot& shot = fired.sweep.shots[i];
    const Eigen::Vector3f p = (echo.range * shot.direction).cast<float>();
    points.push_back(p.x(), p.y(), p.z(), echo.intensity, shot.offset_ns, shot.ring);
  }
  return points;
}

}  // namespace fastlio
