// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mapper_parts.h What the files of the mapper share (internal). */
#pragma once

#include <fastlio/map/surface_map.h>
#include <fastlio/mapping/mapper.h>
#include <fastlio/math/linear_algebra.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace fastlio
{
/** A covariance that can be inverted. */
[[nodiscard]] inline Matrix6 withFloor(const Matrix6& covariance)
{
  constexpr double kAttitude = 2e-5, kPosition = 5e-4;  // [rad], [m]
  Matrix6 result = covariance;
  result.diagonal().head<3>().array() += kAttitude * kAttitude;
  result.diagonal().tail<3>().array() += kPosition * kPosition;
  return result;
}

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

/** Why a registration is not taken. */
struct Shortcoming
{
  ClosureVerdict verdict;
  std::string reason;
};

/** What a registration by itself does not show of what the limits ask for, or nothing. */
[[nodiscard]] std::optional<Shortcoming> shortcomingOf(
    const Registration& registration, const ClosureLimits& limits);

/** The covariance of the pose that a motion leads to from \a a, whose covariance is given: attitude
 * in the body frame, position in the world. To first order. */
[[nodiscard]] Matrix6 carried(const Pose& a, const Matrix6& covariance, const RelativePose& motion);

/** The pose of a scan with covariances that hold for a map of the LiDAR: without what a wrong
 * calibration makes of all poses alike. */
[[nodiscard]] TrackedPose mappingPoseOf(const ScanResult& result);

/** Without anything that corrects it, a map is that of the odometry; covariances stay. */
void stayAsOdometry(MappingResult& result);

/** Turns a result about its first node so that the estimated vertical is z. Covariances are
 * relative to the first node and turn with it. */
void makeLevel(MappingResult& result);

/** Points that count from an origin, after a motion: single precision only in the end. */
void moved(const WorldPoints& points, const Vec3& origin, const Pose& motion, WorldPoints& result);

}  // namespace fastlio
