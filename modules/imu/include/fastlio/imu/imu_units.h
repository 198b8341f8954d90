// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_units.h In which units does an inertial sensor speak? */
#pragma once

#include <fastlio/filter/imu.h>

#include <cstddef>
#include <string>
#include <vector>

namespace fastlio
{
/** Unit of the specific force. */
enum class AccelUnit
{
  Auto,    //!< found from the magnitude of the first samples
  Si,      //!< m/s^2
  G,       //!< multiples of 9.80665 m/s^2
  MilliG,  //!< thousandths of it
};

/** Unit of the angular rate. */
enum class GyroUnit
{
  Auto,     //!< rad/s unless gravity turns as if it were deg/s
  Radians,  //!< rad/s
  Degrees   //!< deg/s
};

[[nodiscard]] const char* toString(AccelUnit unit);
[[nodiscard]] const char* toString(GyroUnit unit);

/** SI units per unit; 1 for Auto. */
[[nodiscard]] double siPerUnit(AccelUnit unit);
[[nodiscard]] double siPerUnit(GyroUnit unit);

/** Conclusion from the magnitude of the specific force. */
struct AccelUnitVerdict
{
  AccelUnit unit = AccelUnit::Si;
  double norm = 0.0;   //!< median magnitude of the samples, in their unit
  bool clear = false;  //!< near gravity in that unit; else Si, for want of a better one
};

/** The unit in which the median magnitude is nearest to gravity.
 * \param samples of a platform at rest or in moderate motion
 * \param gravity its magnitude [m/s^2]
 */
[[nodiscard]] AccelUnitVerdict findAccelUnit(const std::vector<ImuSample>& samples, double gravity);

/** Compares how gravity turns in the IMU frame with how the gyro says that it turns.
 *
 * In windows of a quarter of a second the direction of the specific force at the begin is turned by
 * the gyro, read in rad/s and in deg/s, and compared with that at the end. A platform that only
 * yaws gives no such evidence: then rates that no platform sustains without centrifugal forces
 * decide. Rates of a few deg/s decide nothing. */
class GyroUnitTest
{
 public:
  /** \param sample specific force in m/s^2
   * \param gravity its magnitude at rest [m/s^2] */
  void add(const ImuSample& sample, double gravity);

  /** True once the samples are clearly in deg/s; stays so. */
  [[nodiscard]] bool degrees() const { return degrees_; }
  /** The numbers that the decision rests on. */
  [[nodiscard]] std::string evidence() const;

 private:
  void closeWindow();
  [[nodiscard]] bool turnsAgree() const;
  void addSpin(const ImuSample& sample, double gravity, double dt);

  bool degrees_ = false;
  std::vector<ImuSample> window_;
  std::int64_t last_ns_ = 0;
  std::size_t windows_ = 0;        // in which the two readings differ
  double error_as_radians_ = 0.0;  // sum over them of the angle between prediction and measurement
  double error_as_degrees_ = 0.0;
  // Sums over them of the turns of gravity, predicted in deg/s (p) and measured (m).
  double pp_ = 0.0, pm_ = 0.0, mm_ = 0.0;
  double spin_time_ = 0.0;  // at an impossible rate without centrifugal force [s]
  double spin_rate_ = 0.0;
};

}  // namespace fastlio
