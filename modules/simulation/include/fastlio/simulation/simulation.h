// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file simulation.h A simulated recording in memory, with the truth.
 *
 * \code
 * fastlio::SimulationSettings settings = fastlio::defaultSettings("office");
 * settings.seed = 7;
 * const fastlio::Simulation simulation(settings);
 * for (const auto& sample : simulation.imu().samples) odometry.addImu(sample);
 * for (std::size_t i = 0; i < simulation.scanCount(); ++i) odometry.addScan(simulation.scan(i));
 * const fastlio::Pose truth = simulation.truth(stamp_ns).T_world_imu;
 * \endcode
 */
#pragma once

#include <fastlio/lidar/scan.h>
#include <fastlio/scenarios/scenario.h>
#include <fastlio/simulation/gnss_model.h>
#include <fastlio/simulation/imu_model.h>
#include <fastlio/simulation/lidar_errors.h>
#include <fastlio/simulation/lidar_model.h>
#include <fastlio/simulation/wheel_model.h>
#include <fastlio/worlds/world.h>

#include <memory>

namespace fastlio
{
/** The return of a shot. */
struct Echo
{
  double range = 0.0;      //!< with noise [m]; 0: nothing came back
  float intensity = 0.0F;  //!< 0..255
};

/** A sweep and its echoes, one per shot. */
struct FiredSweep
{
  Sweep sweep;
  std::vector<Echo> echoes;
  std::vector<bool> packet_lost;  //!< per packet (shotsPerPacket()); empty: none is lost
};

/** A simulated recording. All members are const and may be called from several threads at once;
 * what they return depends on the settings only. */
class Simulation
{
 public:
  /** Simulates the IMU; scans are made on demand.
   * \exception std::invalid_argument unknown scenario or an unusable setting */
  explicit Simulation(const SimulationSettings& settings);

  /** The settings with the duration filled in. */
  [[nodiscard]] const SimulationSettings& settings() const { return settings_; }
  [[nodiscard]] const Motion& motion() const { return motion_; }
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const ImuRecording& imu() const { return imu_; }
  [[nodiscard]] const std::vector<SimulatedFix>& gnss() const { return gnss_; }
  [[nodiscard]] const std::vector<WheelReading>& wheels() const { return wheels_; }
  [[nodiscard]] const LidarErrors& lidarErrors() const { return lidar_errors_; }

  /** Number of complete sweeps. */
  [[nodiscard]] std::size_t scanCount() const { return scan_count_; }

  /** Fires sweep number index: every shot from the exact pose at its own time, true stamps. */
  [[nodiscard]] FiredSweep fire(std::size_t index) const;

  /** The same as points, with the stamp that the LiDAR delivers (stampOfLidar()) and the mounting
   * in the recording. */
  [[nodiscard]] LidarScan scan(std::size_t index) const;

  /** The true state of motion at a stamp of the IMU's clock. */
  [[nodiscard]] Kinematics truth(std::int64_t stamp_ns) const;

  /** Time since the start [s] of a stamp of the IMU's clock, as Motion and World take it. */
  [[nodiscard]] double secondsSinceStart(std::int64_t stamp_ns) const;

 private:
  struct Parts;
  explicit Simulation(Parts parts);

  SimulationSettings settings_;
  Motion motion_;
  World world_;
  ImuRecording imu_;
  std::vector<SimulatedFix> gnss_;
  std::vector<WheelReading> wheels_;
  std::unique_ptr<const LidarModel> lidar_;
  LidarErrors lidar_errors_;
  std::size_t scan_count_ = 0;
};

/** The points of a sweep in the LiDAR frame, offsets from the sweep's first shot. */
[[nodiscard]] PointColumns pointsOf(const FiredSweep& fired);

}  // namespace fastlio
