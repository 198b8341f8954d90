// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file repeated_readings.h An inertial sensor that says the same again and again: its driver or
 * its bus has stopped, and something repeats the last message. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/imu/imu_report.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** Watches for readings that are all the same. Noise of a sensor that works changes at least one of
 * six values. */
class RepeatedReadings
{
 public:
  /** \param diagnostics gets what to tell the user, once for each time that it happens
   * \return whether the readings are those of the sample before */
  [[nodiscard]] bool add(const ImuSample& sample, std::vector<Diagnostic>& diagnostics);

 private:
  ImuSample first_;  // of those that are the same
  std::size_t repeats_ = 0;
  bool reported_ = false;
};

}  // namespace fastlio
