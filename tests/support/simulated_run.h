// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file simulated_run.h The odometry on a simulated recording in memory, with the truth beside
 * every estimate. */
#pragma once

#include <fastlio/evaluation/evaluate.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/simulation/recording.h>
#include <fastlio/simulation/simulation.h>

#include <functional>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** An estimate and what is true at its stamp; the truth is in the simulator's world. */
struct JudgedScan
{
  ScanResult result;
  Kinematics truth;
  ImuBias true_bias;
};

/** The scans of a run in their order. */
struct SimulatedRun
{
  std::vector<JudgedScan> scans;
  Pose T_est_sim;  //!< the simulator's world in the filter's, exactly: both know the start pose
  Vec3 gravity = Vec3::Zero();  //!< true, in the simulator's world [m/s^2]
};

/** Feeds a whole recording to an odometry of its own. \param parameters mostly
 * matchingParameters() */
[[nodiscard]] SimulatedRun runOdometry(
    const Simulation& simulation, const OdometryOptions& parameters);

/** The same with scans as they come out of \a filter, which may change them; false: the scan does
 * not arrive. */
[[nodiscard]] SimulatedRun runOdometryWithScans(
    const Simulation& simulation, const OdometryOptions& parameters,
    const std::function<bool(LidarScan&)>& filter);

/** The input of an odometry: a simulated recording with something wrong. */
struct AlteredInputs
{
  /** May change a sample or a scan; false: it does not arrive. */
  std::function<bool(ImuSample&)> imu = [](ImuSample&) { return true; };
  std::function<bool(LidarScan&)> scan = [](LidarScan&) { return true; };
  /** All scans of the simulation, if somebody has cast them before: most of the time goes there. */
  const std::vector<LidarScan>* cast = nullptr;
  /** The true time of what now has a stamp, when stamps are altered. */
  std::function<std::int64_t(std::int64_t)> true_ns = [](std::int64_t stamp_ns)
  { return stamp_ns; };
};

/** The same with altered inputs. */
[[nodiscard]] SimulatedRun runOdometryWith(
    const AlteredInputs& inputs, const Simulation& simulation, const OdometryOptions& parameters);

/** The same for what is left of a recording \a begin seconds after its start, when the platform may
 * be in motion. The filter's world is fixed by the true pose at the end of the first scan with a
 * pose, which is where a start in motion fixes it. */
[[nodiscard]] SimulatedRun runOdometryFrom(
    double begin, const Simulation& simulation, const OdometryOptions& parameters,
    const AlteredInputs& altered = {});

/** The same with the parameters that match the simulated sensors, on one thread. */
[[nodiscard]] SimulatedRun runOdometry(const SimulationSettings& settings);

/** Estimate (with covariances) and truth as trajectories. */
[[nodiscard]] Trajectory estimateOf(const SimulatedRun& run);
[[nodiscard]] Trajectory truthOf(const SimulatedRun& run);

/** Error of an estimate, truth [-] estimate in the filter's world, order of StateBlock. */
[[nodiscard]] StateVector stateError(const SimulatedRun& run, const JudgedScan& scan);

/** Number of scans with a status. */
[[nodiscard]] std::size_t countOf(const SimulatedRun& run, ScanStatus status);

}  // namespace fastlio::testing
