// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "simulated_run.h"

#include <fastlio/imu/imu_buffer.h>
#include <fastlio/initialization/static_initializer.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fastlio::testing
{
namespace
{
/** The pose that the filter gives the resting platform: the start of its world frame. */
Pose startPose(const Simulation& simulation, const InitializationOptions& parameters)
{
  ImuBuffer buffer;
  for (const ImuSample& sample : simulation.imu().samples)
    if (buffer.add(sample) != ImuBuffer::Verdict::Accepted)
      throw std::runtime_error("a simulated inertial sample is out of order");
  const std::int64_t begin_ns = buffer.oldestStamp();
  const std::int64_t end_ns = begin_ns + toNanoseconds(parameters.duration);
  return initialState(restStatistics(buffer.samplesBetween(begin_ns, end_ns)), parameters).x.pose();
}

ImuBias biasAt(const ImuRecording& imu, std::int64_t stamp_ns)
{
  const auto next = std::lower_bound(
      imu.samples.begin(), imu.samples.end(), stamp_ns,
      [](const ImuSample& sample, std::int64_t stamp) { return sample.stamp_ns < stamp; });
  const auto last = static_cast<std::ptrdiff_t>(imu.true_bias.size()) - 1;
  const auto index = std::min<std::ptrdiff_t>(next - imu.samples.begin(), last);
  return imu.true_bias[static_cast<std::size_t>(index)];
}

void drain(
    Odometry& odometry, const Simulation& simulation, const AlteredInputs& inputs,
    SimulatedRun& run)
{
  while (auto result = odometry.next())
  {
    const std::int64_t stamp = inputs.true_ns(result->stamp_ns);
    run.scans.push_back(
        {std::move(*result), simulation.truth(stamp), biasAt(simulation.imu(), stamp)});
  }
}
}  // namespace

SimulatedRun runOdometry(const Simulation& simulation, const OdometryOptions& parameters)
{
  return runOdometryWithScans(simulation, parameters, [](LidarScan&) { return true; });
}

SimulatedRun runOdometryWithScans(
    const Simulation& simulation, const OdometryOptions& parameters,
    const std::function<bool(LidarScan&)>& filter)
{
  AlteredInputs inputs;
  inputs.scan = filter;
  return runOdometryWith(inputs, simulation, parameters);
}

SimulatedRun runOdometryWith(
    const AlteredInputs& inputs, const Simulation& simulation, const OdometryOptions& parameters)
{
  SimulatedRun run;
  run.gravity = {0.0, 0.0, -simulation.settings().gravity};
  run.T_est_sim =
      startPose(simulation, parameters.initialization) * simulation.motion().pose(0.0).inverse();
  Odometry odometry(parameters);
  for (ImuSample sample : simulation.imu().samples)
    if (inputs.imu(sample)) odometry.addImu(sample);
  for (std::size_t i = 0; i < simulation.scanCount(); ++i)
  {
    LidarScan scan = inputs.cast != nullptr ? inputs.cast->at(i) : simulation.scan(i);
    if (!inputs.scan(scan)) continue;
    odometry.addScan(std::move(scan));
    drain(odometry, simulation, inputs, run);
  }
  return run;
}

SimulatedRun runOdometryFrom(
    double begin, const Simulation& simulation, const OdometryOptions& parameters,
    const AlteredInputs& altered)
{
  const std::int64_t begin_ns = simulation.settings().start_ns + toNanoseconds(begin);
  AlteredInputs inputs = altered;
  inputs.imu = [&](ImuSample& sample)
  { return sample.stamp_ns >= begin_ns && altered.imu(sample); };
  inputs.scan = [&](LidarScan& scan)
  { return spanOf(scan).begin_ns >= begin_ns && altered.scan(scan); };
  SimulatedRun run = runOdometryWith(inputs, simulation, parameters);
  for (const JudgedScan& scan : run.scans)
  {
    if (scan.result.status != ScanStatus::Tracking) continue;
    run.T_est_sim = scan.result.filter.x.pose() * scan.truth.T_world_imu.inverse();
    break;
  }
  return run;
}

SimulatedRun runOdometry(const SimulationSettings& settings)
{
  OdometryOptions parameters = matchingParameters(settings);
  parameters.threads = 1;
  return runOdometry(Simulation(settings), parameters);
}

Trajectory estimateOf(const SimulatedRun& run)
{
  Trajectory trajectory;
  trajectory.source = "estimate";
  for (const JudgedScan& scan : run.scans)
  {
    if (scan.result.status == ScanStatus::Initializing) continue;
    trajectory.poses.push_back({scan.result.stamp_ns, scan.result.filter.x.pose()});
    trajectory.covariances.emplace_back(scan.result.filter.P.topLeftCorner<6, 6>());
  }
  return trajectory;
}

Trajectory truthOf(const SimulatedRun& run)
{
  Trajectory trajectory;
  trajectory.source = "truth";
  for (const JudgedScan& scan : run.scans)
    trajectory.poses.push_back({scan.result.stamp_ns, scan.truth.T_world_imu});
  return trajectory;
}

StateVector stateError(const SimulatedRun& run, const JudgedScan& scan)
{
  NavState truth;
  const Pose T = run.T_est_sim * scan.truth.T_world_imu;
  truth.R = T.R;
  truth.p = T.p;
  truth.v = run.T_est_sim.R * scan.truth.velocity;
  truth.gyro_bias = scan.true_bias.gyro;
  truth.accel_bias = scan.true_bias.accel;
  truth.g = run.T_est_sim.R * run.gravity;
  return boxminus(truth, scan.result.filter.x);
}

std::size_t countOf(const SimulatedRun& run, ScanStatus status)
{
  return static_cast<std::size_t>(std::count_if(
      run.scans.begin(), run.scans.end(),
      [&](const JudgedScan& scan) { return scan.result.status == status; }));
}

}  // namespace fastlio::testing
