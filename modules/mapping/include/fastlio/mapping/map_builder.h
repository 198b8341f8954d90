// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_builder.h From recordings to a consistent map, in two passes: the first one finds the
 * poses, the second one puts every scan where it belongs. */
#pragma once

#include <fastlio/aiding/gnss.h>
#include <fastlio/aiding/wheels.h>
#include <fastlio/imu/imu_report.h>
#include <fastlio/loops/corrected_trajectory.h>
#include <fastlio/loops/mapper.h>
#include <fastlio/mapping/session.h>
#include <fastlio/math/pose.h>
#include <fastlio/run/output_map.h>
#include <fastlio/run/run_statistics.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace fastlio
{
/** What the first pass met in a session. */
struct SessionOutcome
{
  std::string name;
  RunStatistics statistics;             //!< of the odometry
  std::vector<Diagnostic> diagnostics;  //!< of the odometry
  SessionPass pass;
  std::size_t fixes = 0;              //!< of GNSS
  std::vector<std::string> problems;  //!< of GNSS and wheel odometry
  std::vector<StampedPose> path;      //!< of the IMU by the odometry; of a long run, some of them
};

/** A built map, without its points. */
struct BuiltMap
{
  std::vector<SessionOutcome> sessions;
  MappingResult result;
  GnssOutcome gnss;
  WheelOutcome wheels;
  bool interrupted = false;
};

/** What a pass asks now and then. */
struct PassHooks
{
  std::function<void(const std::string& what, double share)> progress;  //!< may be empty
  std::function<bool()> interrupted;                                    //!< may be empty
};

/** One scan of the second pass. */
struct PlacedScan
{
  const ScanResult& result;   //!< corrected
  const WorldPoints& points;  //!< in the corrected world; empty: it did not join the map
  const RegisteredFields& fields;
  Vec3 sensor_origin;  //!< position of the IMU in the corrected world [m]
};

/** How a map is built. */
struct BuildOptions
{
  ClosureLimits limits;
  bool use_gnss = true;    //!< where a recording has it
  bool use_wheels = true;  //!< likewise
  bool same_rig = false;   //!< sessions that isOneRig() does not tell apart are of one rig
  /** Holds the surfaces of the submaps, also for those who use the result. */
  std::shared_ptr<SubmapStore> store = std::make_shared<SubmapStore>();
};

/** The first pass: odometry over every session, submaps, closures, optimisation.
 * \exception std::runtime_error as Session::run() */
[[nodiscard]] BuiltMap buildMap(
    const std::vector<Session>& sessions, const BuildOptions& options,
    const std::shared_ptr<const Workers>& workers, const PassHooks& hooks = {});

/** The second pass over one session. Without a correction, scans and points are those of the
 * odometry to the bit. \return false when it was interrupted */
bool placeScans(
    const Session& session, std::size_t number, const MappingResult& result,
    const std::function<void(const PlacedScan&)>& use, const PassHooks& hooks = {});

}  // namespace fastlio
