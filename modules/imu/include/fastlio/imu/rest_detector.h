// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rest_detector.h Is the platform standing still? */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/filter/state.h>
#include <fastlio/imu/imu_options.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** Mean angular rate and specific force over a span of time, IMU frame. */
struct InertialMean
{
  Vec3 gyro = Vec3::Zero();   //!< [rad/s]
  Vec3 accel = Vec3::Zero();  //!< [m/s^2]
  double duration = 0.0;      //!< [s]
};

/** Mean of inputs that hold from their stamps on, the last one until end_ns. */
[[nodiscard]] InertialMean inertialMean(const std::vector<ImuSample>& inputs, std::int64_t end_ns);

/** Evidence of a scan and the inertial data before it. */
struct RestEvidence
{
  std::int64_t stamp_ns = 0;  //!< the scan's end
  InertialMean inertial;      //!< since the scan before
  Pose T_world_imu;           //!< the scan's posterior
  Vec3 velocity = Vec3::Zero();
  bool matched = false;  //!< the scan corrected the prediction
};

/** Decides after every scan.
 *
 * Inertial data alone cannot distinguish rest from steady motion, and vibration disturbs them, so
 * that the scans decide: since the platform has become quiet, their poses stay within a small
 * region and show no trend. Inertial means over a tenth of a second or more, in which vibration
 * averages out, must not change; they reveal a start within a scan. */
class RestDetector
{
 public:
  explicit RestDetector(const RestOptions& parameters) : parameters_(parameters) {}

  /** Takes the next scan.
   * \return the platform is at rest */
  bool update(const RestEvidence& evidence);

  [[nodiscard]] bool atRest() const { return at_rest_; }

  /** How long the platform has been known to rest [s]; 0 in motion. */
  [[nodiscard]] double restingTime() const;

  /** The platform is known to rest: it does from the next scan on that matches, until one is not
   * quiet. */
  void assumeRest() { assumed_ = true; }

  /** That knowledge still holds. */
  [[nodiscard]] bool assumed() const { return assumed_; }

  /** Not at rest, whatever was seen so far. */
  void reset();

 private:
  [[nodiscard]] bool quiet(const RestEvidence& evidence) const;
  void begin(const RestEvidence& evidence);
  void add(const RestEvidence& evidence);
  void addRecent(const InertialMean& mean);
  [[nodiscard]] Vec3 trend() const;
  [[nodiscard]] double quietTime() const;

  RestOptions parameters_;
  bool started_ = false, at_rest_ = false, assumed_ = false;
  std::int64_t begin_ns_ = 0, now_ns_ = 0, rest_begin_ns_ = 0;
  Pose anchor_;             // first pose of the quiet time
  InertialMean reference_;  // of the quiet time, the latest minute weighs most
  InertialMean recent_;     // of the last tenth of a second or more
  // Sums over the quiet time's scans, of t [s] and of positions from the anchor [m].
  double n_ = 0.0, t_ = 0.0, tt_ = 0.0;
  Vec3 p_ = Vec3::Zero(), tp_ = Vec3::Zero();
};

}  // namespace fastlio
