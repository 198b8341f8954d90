// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mapper_parts.h What the files of the mapper share (internal). */
#pragma once

#include <fastlio/loops/mapper.h>
#include <fastlio/math/linear_algebra.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace fastlio
{
/** Along a principal direction: 0 the one that is known best, 2 the one that is known least [m]. */
[[nodiscard]] inline double positionStd(const Matrix6& covariance, int direction)
{
  const auto system = symmetricEigensystem(Mat3(covariance.bottomRightCorner<3, 3>()));
  return std::sqrt(std::max(0.0, system.values[direction]));
}

[[nodiscard]] inline double largestPositionStd(const Matrix6& covariance)
{
  return positionStd(covariance, 2);
}

/** Takes a closure. \param remark that its reason ends with, for people */
void accept(Closure& closure, const std::string& remark);

/** Why a registration is not taken. */
struct Shortcoming
{
  ClosureVerdict verdict;
  std::string reason;
};

/** What a registration by itself does not show of what the limits ask for, or nothing. */
[[nodiscard]] std::optional<Shortcoming> shortcomingOf(
    const Registration& registration, const ClosureLimits& limits);

/** Accepted closures whose edges the estimate has turned off become contradicted. */
void markContradicted(MappingResult& result);

/** Without anything that corrects it, a map is that of the odometry, and no errors of its sensors
 * are found; covariances stay. */
void stayAsOdometry(MappingResult& result);

}  // namespace fastlio
