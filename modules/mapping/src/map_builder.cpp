// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mapping/aids.h>
#include <fastlio/mapping/map_builder.h>
#include <fastlio/mapping/rigs.h>
#include <fastlio/run/pose_output.h>

#include <utility>

namespace fastlio
{
namespace
{
std::function<void(double)> progressOf(const PassHooks& hooks, const std::string& what)
{
  if (!hooks.progress) return {};
  return [&hooks, what](double share) { hooks.progress(what, share); };
}

bool isInterrupted(const PassHooks& hooks)
{
  return hooks.interrupted && hooks.interrupted();
}

/** Enough of them for a drawing. */
std::vector<StampedPose> pathOf(const std::vector<TrackedPose>& poses)
{
  constexpr std::size_t kMost = 4000;
  const std::size_t stride = poses.size() / kMost + 1;
  std::vector<StampedPose> path;
  for (std::size_t i = 0; i < poses.size(); i += stride)
    path.push_back({poses[i].stamp_ns, poses[i].T_world_body});
  return path;
}

/** The odometry over one session into submaps. */
SessionOutcome addSession(
    const Session& session, SubmapBuilder submaps, Mapper& mapper, PoseTrack& track,
    const PassHooks& hooks)
{
  SessionOutcome outcome;
  outcome.name = session.name();
  const auto use = [&](const ScanResult& result, const Odometry& odometry)
  {
    outcome.statistics.add(result);
    // They only become more, now and then.
    if (odometry.diagnostics().size() != outcome.diagnostics.size())
      outcome.diagnostics = odometry.diagnostics();
    track.add(result);
    if (auto submap = submaps.add(result, odometry.registeredPoints(), odometry.mapOrigin()))
      mapper.add(std::move(*submap));
    return !isInterrupted(hooks);
  };
  outcome.pass = session.run(
      use, progressOf(hooks, session.name() + ": odometry"),
      [&submaps](const ImuSample& sample) { submaps.addImu(sample); });
  outcome.path = pathOf(track.poses());
  if (auto submap = submaps.finish()) mapper.add(std::move(*submap));
  return outcome;
}
}  // namespace

BuiltMap buildMap(
    const std::vector<Session>& sessions, const BuildOptions& options,
    const std::shared_ptr<const Workers>& workers, const PassHooks& hooks)
{
  BuiltMap built;
  Mapper mapper(options.limits, workers);
  GnssFactors gnss;
  WheelFactors wheels;
  for (std::size_t i = 0; i < sessions.size() && !built.interrupted; ++i)
  {
    PoseTrack track(OutputFrame{});
    built.sessions.push_back(
        addSession(sessions[i], SubmapBuilder(i, {}, options.store), mapper, track, hooks));
    SessionOutcome& outcome = built.sessions.back();
    // A recording without other sensors has nothing that is worth another pass.
    const bool wanted = options.use_gnss || options.use_wheels;
    if (wanted && outcome.pass.bridge.other_sensors > 0)
    {
      const Aids aids = readAids(sessions[i], outcome.problems);
      outcome.fixes = options.use_gnss ? aids.fixes.size() : 0;
      if (options.use_gnss) gnss.add(aids.fixes, track, i, mapper);
      if (options.use_wheels)
        wheels.add(aids.wheels, sessions[i].plan().T_vehicle_imu, track, i, mapper);
    }
    built.interrupted = built.sessions.back().pass.stopped;
  }
  built.result = std::move(mapper).result();
  if (options.same_rig) built.result.rigs = rigsOf(sessions);
  built.wheels = wheels.applyTo(built.result);
  built.gnss = gnss.applyTo(built.result);
  return built;
}

bool placeScans(
    const Session& session, std::size_t number, const MappingResult& result,
    const std::function<void(const PlacedScan&)>& use, const PassHooks& hooks)
{
  const CorrectedTrajectory trajectory(result, number);
  WorldPoints placed;
  const SessionPass pass = session.run(
      [&](const ScanResult& scan, const Odometry& odometry)
      {
        const WorldPoints& registered = odometry.registeredPoints();
        const ScanResult corrected = trajectory.corrected(scan);
        const bool moves = trajectory.changes() && hasPose(scan.status);
        if (moves)
          moved(
              registered, odometry.mapOrigin(),
              trajectory.correctionAt(scan.stamp_ns, scan.filter.x.pose()), placed);
        use(
            {corrected, moves ? placed : registered, odometry.registeredFields(),
             corrected.filter.x.p});
        return !isInterrupted(hooks);
      },
      progressOf(hooks, session.name() + ": map"));
  return !pass.stopped;
}

}  // namespace fastlio
