// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gravity_reading.h Where gravity is, by the accelerometer and the motion of the LiDAR. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/interface/scan_result.h>
#include <fastlio/math/pose.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace fastlio
{
/** Mean specific force without that of the motion: what the accelerometer feels of gravity. */
struct GravityReading
{
  Vec3 force = Vec3::Zero();       //!< against gravity, in the frame of a pose [m/s^2]
  Mat3 by_bias = Mat3::Zero();     //!< derivative by the bias of the accelerometer
  Mat3 covariance = Mat3::Zero();  //!< by the noise of the positions [m^2/s^4]
};

/** Weighs the specific force over two stretches of a run that follow each other, with weights that
 * grow from 0 to 1 and fall again: its integral is the mean velocity over the second stretch less
 * that over the first one, and three positions of the LiDAR determine both. The filter's own
 * estimate of gravity would not do: where it knows its attitude from the LiDAR well, both drift
 * together. */
class GravityMeter
{
 public:
  /** Samples in the order of time; they may be ahead of the scans. */
  void addImu(const ImuSample& sample) { samples_.push_back(sample); }

  /** The next scan. Where poses are missing for too long, the attitude between them is not known:
   * the stretch begins anew behind. */
  void addScan(const ScanResult& result);

  /** Ends a stretch at the latest scan and begins another one there.
   * \return gravity in the frame of the pose at which the stretch began; nothing where it or the
   * one before is too short, samples are missing, or the force is not that of gravity */
  [[nodiscard]] std::optional<GravityReading> take();

  /** Samples that are kept for a scan to come. */
  [[nodiscard]] std::size_t waitingSamples() const { return samples_.size(); }

 private:
  /** Of a scan. */
  struct Instant
  {
    std::int64_t stamp_ns = 0;
    Pose T_world_body;
    Vec3 gravity = Vec3::Zero();
    Mat3 position_covariance = Mat3::Zero();  // of its own noise
  };
  /** Integrals over the time t since the beginning. */
  struct Stretch
  {
    Instant from, to;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();      // of R a and of t R a [m/s], [m]
    Mat3 turn = Mat3::Zero(), turn_moment = Mat3::Zero();  // of R and t R [s], [s^2]
    double integrated = 0.0;                               // [s]

    [[nodiscard]] double duration() const;
    [[nodiscard]] Vec3 velocity() const;  // mean
    [[nodiscard]] bool usable() const;
  };
  [[nodiscard]] static std::optional<GravityReading> between(
      const Stretch& former, const Stretch& latter);
  void dropSamplesUntil(std::int64_t stamp_ns);

  std::deque<ImuSample> samples_;  // after the latest scan
  std::int64_t sample_ns_ = 0;     // of the latest sample that was taken in
  std::optional<Stretch> former_, current_;
};

}  // namespace fastlio
