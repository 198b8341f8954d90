// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file motion.h How the platform moves: pose, velocity, acceleration and angular rate as exact
 * functions of time. */
#pragma once

#include <fastlio/math/pose.h>
#include <fastlio/worlds/uniform_spline.h>

#include <array>
#include <vector>

namespace fastlio
{
/** a sin(w u), u being motion time. */
struct Oscillation
{
  double amplitude = 0.0;
  double angular_frequency = 0.0;  //!< w [rad/s]
};

/** One of the six coordinates as a function of motion time: spline + slope u + oscillations. */
struct MotionChannel
{
  UniformSpline spline;
  double offset = 0.0;
  double slope = 0.0;
  std::vector<Oscillation> oscillations;

  [[nodiscard]] double value(double u) const;
  [[nodiscard]] Jet at(double u) const;
};

/** The path of the platform ("carrier") in motion time u [s]. */
struct CarrierPath
{
  enum Channel : std::size_t
  {
    kX,
    kY,
    kZ,  //!< position in the world [m]
    kYaw,
    kPitch,
    kRoll  //!< attitude Rz(yaw) Ry(pitch) Rx(roll) [rad], pitch away from +-pi/2
  };
  std::array<MotionChannel, 6> channels;
  double loop_time = 0.0;  //!< motion time after which the path is back at its start; 0: never
};

/** Motion time as a function of time: rest, smooth start, constant rate, optionally a smooth stop.
 * All up to the third derivative of the rate are continuous. */
struct MotionTiming
{
  double rest = 2.5;   //!< at rest from 0 to here [s]
  double blend = 2.0;  //!< then this long until the full rate [s]
  double rate = 1.0;   //!< motion time per time
  double start = 0.0;  //!< motion time at rest [s]
  double stop_at =
      -1.0;  //!< motion time at which the platform comes to rest; negative: it never does

  /** Motion time and its derivatives at t [s]. */
  [[nodiscard]] Jet at(double t) const;
  /** When the platform stops [s]; infinite when it never does. */
  [[nodiscard]] double stopTime() const;
};

/** State of motion at one instant; world frame: z up. */
struct Kinematics
{
  Pose T_world_imu;
  Vec3 velocity = Vec3::Zero();      //!< of the IMU in the world frame [m/s]
  Vec3 acceleration = Vec3::Zero();  //!< of the IMU in the world frame, gravity excluded [m/s^2]
  Vec3 angular_rate = Vec3::Zero();  //!< in the IMU frame [rad/s]
};

/** The true motion of the IMU. */
class Motion
{
 public:
  /** \exception std::invalid_argument a timing that is negative or not finite, or rate not positive
   */
  Motion(CarrierPath path, const MotionTiming& timing);

  /** Pose of the IMU at t [s] since the start. */
  [[nodiscard]] Pose pose(double t) const;
  [[nodiscard]] Kinematics at(double t) const;
  [[nodiscard]] const MotionTiming& timing() const { return timing_; }
  [[nodiscard]] const CarrierPath& path() const { return path_; }

 private:
  CarrierPath path_;
  MotionTiming timing_;
};

/** The measurements of an ideal inertial sensor. \param gravity in the world frame, e.g. (0, 0,
 * -9.81)
 * \return R^T (a - g) in the IMU frame [m/s^2] */
[[nodiscard]] Vec3 specificForce(const Kinematics& motion, const Vec3& gravity);

}  // namespace fastlio
