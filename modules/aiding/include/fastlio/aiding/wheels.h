// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file wheels.h Wheel odometry: how far the vehicle went where LiDAR and IMU leave it open. */
#pragma once

#include <fastlio/loops/mapper.h>
#include <fastlio/run/pose_track.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace fastlio
{
/** Where the wheels believe the vehicle to be, in the plane that it started in. */
struct WheelPose
{
  std::int64_t stamp_ns = 0;
  double x = 0.0, y = 0.0;  //!< [m]
  double heading = 0.0;     //!< [rad]
};

/** What became of the wheel odometry. */
struct WheelOutcome
{
  bool used = false;
  std::string reason;            //!< why not
  std::size_t readings = 0;      //!< in the recordings
  std::size_t motions = 0;       //!< between submaps, with readings all along
  std::size_t slipped = 0;       //!< of them, those in which wheels slipped: not believed
  std::size_t checks = 0;        //!< motions that LiDAR and IMU know well enough to compare with
  std::size_t contradicted = 0;  //!< of them, those that do not agree with the wheels
  std::size_t taking_part = 0;   //!< motions that LiDAR and IMU do not know
  double scale = 1.0;            //!< true way over the way that the wheels measure
  double scale_std = 0.0;
  double noise = 0.0;  //!< standard deviation after 1 m [m]
};

/** What came of it, for people. */
[[nodiscard]] std::string wheelSentence(const WheelOutcome& outcome);

/** Wheel odometry of all sessions as motions in a graph. The wheels measure the way along the
 * vehicle; its attitude is that of LiDAR and IMU. */
class WheelFactors
{
 public:
  /** Takes in the readings of a session, in order of time. \param track of the IMU by the odometry
   * \param mapper with the session's submaps */
  void add(
      const std::vector<WheelPose>& readings, const Pose& T_vehicle_imu, const PoseTrack& track,
      std::size_t session, const Mapper& mapper);

  /** Compares the wheels with what LiDAR and IMU know well, and adds their motions to the graph
   * where these do not: at a run that needs no wheels, nothing changes. */
  [[nodiscard]] WheelOutcome applyTo(MappingResult& result) const;

 private:
  /** From one submap to the next. */
  struct Motion
  {
    std::size_t a = 0, b = 0;    //!< numbers of the submaps
    Vec3 rolled = Vec3::Zero();  //!< of the vehicle, as the wheels measure it; IMU frame of a [m]
    Vec3 swung = Vec3::Zero();   //!< what the turn adds for the IMU, likewise [m]
    double way = 0.0;            //!< along the path [m]
    bool slipped = false;
  };
  struct Comparison;
  [[nodiscard]] Comparison comparedWith(const MappingResult& result, const Motion& motion) const;
  void findScale(const MappingResult& result, WheelOutcome& outcome) const;

  std::vector<Motion> motions_;
  std::size_t readings_ = 0;
  std::vector<double> noise_variances_;  //!< of the sessions, after 1 m [m^2]
};

}  // namespace fastlio
