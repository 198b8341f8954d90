// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file odometry.h The LiDAR-inertial odometry: IMU samples and scans in, one ScanResult per scan
 * out.
 */
#pragma once

#include <fastlio/errormodel/calibration_sums.h>
#include <fastlio/filter/imu.h>
#include <fastlio/imu/imu_report.h>
#include <fastlio/interface/imu_rate.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/interface/scan_result.h>
#include <fastlio/lidar/scan.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace fastlio
{
class SurfaceMap;
struct SavedMap;
struct WorldPoints;

/** Counts of everything that was dropped before it reached the filter. */
struct InputStatistics
{
  std::size_t imu_in = 0, imu_not_finite = 0, imu_out_of_order = 0, imu_duplicate = 0;
  std::size_t imu_spikes = 0;      //!< lone absurd samples
  std::size_t imu_bad_stamps = 0;  //!< stamps that no other sample confirms
  std::size_t scans_in = 0, scans_empty = 0, scans_out_of_order = 0, scans_without_imu = 0;
  std::size_t scans_bad_stamp = 0;
  std::size_t scans_after_result = 0;  //!< given after the last scan with a result, in a row
  std::int64_t newest_imu_ns = 0;      //!< stamp of the newest sample that is believed; 0: none
};

/** About where the platform is, by other knowledge than the run's. Roll and pitch of the pose do
 * not count: they are known from gravity. */
struct PoseGuess
{
  Pose T_world_imu;
  double position_std = 0.0;  //!< of each coordinate [m]
  double yaw_std = 0.0;       //!< [rad]
};

/** FAST-LIO: feed samples and scans in any interleaving, then drain next().
 *
 * A scan is processed once an IMU sample at or after its end has arrived; until then next() returns
 * nothing. Not thread-safe: one thread feeds and drains.
 */
class Odometry
{
 public:
  /** \exception std::invalid_argument a parameter is out of its range (the message names it) */
  explicit Odometry(const OdometryOptions& options);
  ~Odometry();
  Odometry(Odometry&&) noexcept;
  Odometry& operator=(Odometry&&) noexcept;

  /** Starts in a map of an earlier run instead of an empty one: the first scan is searched around
   * the pose that is given, scans before it is found are Initializing. Without map.update the map
   * stays as it is. Nothing is dropped from it for being far away. \exception std::invalid_argument
   * the map is empty \exception std::logic_error scans were processed before */
  void startIn(const SavedMap& map);

  /** Searches the pose around a guess from the next scan on, whatever the run believed of it.
   * Motion, gravity and biases stay known, and so does the map, unless another one is given. Scans
   * are Diverged until the pose is found.
   * \param other map to go on in, instead of the one in use; poses are in its world from then on
   * \return false: the run has not started, its motion is not known well enough to go on with, or
   * there is no map; nothing has changed then */
  [[nodiscard]] bool relocalize(const PoseGuess& guess, const SavedMap* other = nullptr);

  /** Samples that are not finite, repeated, late or absurd are counted and dropped. A sample that
   * jumps (in value or time) waits for the next one, the first 0.2 s for the unit of the
   * accelerometer (imu.accel_unit). */
  void addImu(const ImuSample& sample);

  /** \param callback called for every sample that is not dropped, as the filter uses it: in m/s^2 and
   * rad/s, with the signs and axes of the body and by the clock of the results; in the order of
   * time, before next() gives a scan that needs it */
  void setSampleCallback(std::function<void(const ImuSample&)> callback);

  /** A scan that inertial data do not reach within lidar.max_waiting is given up with a result that
   * says so: Initializing before the start, Diverged (without a state) after it. */
  void addScan(LidarScan scan);

  /** Processes the oldest scan that is covered by IMU data. */
  [[nodiscard]] std::optional<ScanResult> next();

  /** After the last observation: also processes scans whose end the IMU data do not reach, as long
   * as the gap is below imu.max_gap. */
  [[nodiscard]] std::optional<ScanResult> flush();

  [[nodiscard]] const SurfaceMap& map() const;
  /** Origin of map() and registeredPoints(), in the world [m]: the origin of the map
   * that the run began in; else zero. Poses are in the world. */
  [[nodiscard]] const Vec3& mapOrigin() const;

  /** The points of the last scan that was used, in the world frame counted from mapOrigin(); empty
   * when the last scan did not join the map. Valid until the next call of next() or flush(). */
  [[nodiscard]] const WorldPoints& registeredPoints() const;

  /** Intensity and time of those points; with the same lifetime. */
  [[nodiscard]] const RegisteredFields& registeredFields() const;

  /** With output.imu_rate: the states at the inertial samples after the scan before the last one up
   * to the last one's end, predicted from the former: what was known at those instants. Stamps
   * ascend over all calls. Empty while the pose is not trusted. Valid until the next call of next()
   * or flush(). */
  [[nodiscard]] const std::vector<ImuRateState>& imuRateStates() const;

  /** For programs that react at the rate of the inertial sensor: the state at the newest sample,
   * predicted from the latest scan that next() has given. Call it after addImu(); nothing before
   * the start and while the pose is not trusted. Each call propagates anew from that scan. */
  [[nodiscard]] std::optional<ImuRateState> stateAtNewestSample();

  /** The evidence of the scans so far about the calibration that they were processed with. */
  [[nodiscard]] CalibrationFindings calibrationFindings() const;

  [[nodiscard]] const OdometryOptions& parameters() const;
  [[nodiscard]] const InputStatistics& inputStatistics() const;
  /** Units, rate and faults of the inertial sensor so far. */
  [[nodiscard]] ImuReport imuReport() const;
  /** Diagnostics for the user, in the order of their discovery: units, mounting,
   * re-initialisations. */
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fastlio
