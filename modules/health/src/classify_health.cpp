// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The measures of a scan's health, each with its limit.

#include <fastlio/health/classify.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace fastlio
{
namespace
{
constexpr double kTrouble = 0.5;
constexpr double kKnownDegeneracy = 0.6;  // a direction that is left to the inertial data
constexpr double kPredicted = 0.25;
// Position error along a degenerate direction that few users of a trajectory can live with [m].
constexpr double kMaxDegenerateStd = 0.5;
// Smallest eigenvalue of H^T R^-1 H: the scan knows each direction to 0.1 m or 0.1 rad.
constexpr double kMinInformation = 100.0;
// Fraction of the time that the noise of inertial data may be inflated: longer bridges bend the
// scan.
constexpr double kMaxInflatedRatio = 0.25;
// Beyond these, the filter explains something else by its biases.
constexpr double kMaxGyroBias = 0.17453292519943295;  // [rad/s]; 10 deg/s
constexpr double kMaxAccelBias = 2.0;                 // [m/s^2]
// From scan to scan: five periods of the usual 10 Hz [s].
constexpr double kMaxScanInterval = 0.5;

/** Health of a measure that must not exceed a limit: 1 at zero, 1/2 at the limit. */
double below(double measure, double limit)
{
  return std::clamp(1.0 - 0.5 * measure / limit, 0.0, 1.0);
}

/** Health of a measure that must reach a limit: 1/2 there, 1 at twice as much. */
double above(double measure, double limit)
{
  return limit > 0.0 ? std::clamp(0.5 * measure / limit, 0.0, 1.0) : 1.0;
}

/** Keeps the worst. \param reason makes the text, which is needed in trouble only */
template <typename Reason>
void consider(ScanHealth& health, double value, HealthCause cause, const Reason& reason)
{
  if (value >= health.value) return;
  health.value = value;
  health.cause = cause;
  health.reason = value < kTrouble ? reason() : std::string();
}

void considerInlierRatio(const ScanStatistics& s, ScanHealth& health)
{
  consider(
      health, above(inlierRatio(s, s.points_downsampled), kMinUsualFraction * s.usual_inlier_ratio),
      HealthCause::FewMatches,
      [&]
      {
        return mrpt::format(
            "%zu of %zu points match the map, less than %g of the fraction that matched before, "
            "%.3f",
            s.points_effective, s.points_downsampled, kMinUsualFraction, s.usual_inlier_ratio);
      });
}

void considerMatches(const ScanStatistics& s, ScanHealth& health)
{
  consider(
      health, below(s.normalized_innovation, kMaxInnovation), HealthCause::LargeResidual,
      [&]
      {
        return mrpt::format(
            "the residuals are %.1f times what their noise explains, more than %g: "
            "is the pose of the LiDAR, a clock or the time of the points wrong?",
            s.normalized_innovation, kMaxInnovation);
      });
  if (s.constraints.unconstrained > 0) return;
  consider(
      health, above(s.information_eigenvalues[0], kMinInformation),
      HealthCause::DegenerateDirection,
      [&]
      {
        return mrpt::format(
            "the surroundings leave a direction open: smallest eigenvalue of the information %.3g, "
            "less than %g",
            s.information_eigenvalues[0], kMinInformation);
      });
}

/** Scans have left directions open in turns, and this one does not. */
void considerLostPosition(double lost_std, ScanHealth& health)
{
  consider(
      health, below(lost_std, kMaxDegenerateStd), HealthCause::DegenerateDirection,
      [&]
      {
        return mrpt::format(
            "scans left a direction open until less than a second ago: the position has become "
            "uncertain by %.2f m meanwhile, more than %g m",
            lost_std, kMaxDegenerateStd);
      });
}

/** A direction that is left to the inertial data is fine as long as they know it well enough.
 * \return false where they do not */
bool considerDegenerateDirections(const ScanResult& result, double lost_std, ScanHealth& health)
{
  const ScanConstraints& constraints = result.statistics.constraints;
  if (constraints.unconstrained == 0)
  {
    considerLostPosition(lost_std, health);
    return lost_std <= kMaxDegenerateStd;
  }
  const Matrix6 own = result.filter.P.topLeftCorner<6, 6>() - result.map_covariance;
  const double std =
      std::max(lost_std, std::sqrt(own.bottomRightCorner<3, 3>().diagonal().maxCoeff()));
  consider(
      health, std::min(kKnownDegeneracy, below(std, kMaxDegenerateStd)),
      HealthCause::DegenerateDirection,
      [&]
      {
        const MotionDirection open = unconstrainedMotions(constraints).front();
        return mrpt::format(
            "the surroundings do not constrain the %s (%.2f, %.2f, %.2f): the position is "
            "uncertain by %.2f m, more than %g m",
            open.is_rotation ? "rotation about" : "motion along", open.axis.x(), open.axis.y(),
            open.axis.z(), std, kMaxDegenerateStd);
      });
  return std <= kMaxDegenerateStd;
}

/** A pose that only the map determines: it has places that look alike, and the right one may not be
 * among them. */
void considerSearch(const ScanStatistics& s, ScanHealth& health)
{
  if (s.searched_std <= kUnambiguousStd) return;
  consider(
      health, kPredicted, HealthCause::Lost,
      [&]
      {
        return mrpt::format(
            "the pose was uncertain by %.2f m and was found by the map alone: "
            "another place may look the same",
            s.searched_std);
      });
}

/** Scans correct the same error again and again: either the inertial data or the poses of the scans
 * are wrong. */
void considerMotion(const ScanStatistics& s, const HealthContext& context, ScanHealth& health)
{
  if (s.mounting_error)
    consider(
        health, below(s.mounting_error->leastAngle(), context.max_mounting_error),
        HealthCause::MotionDisagreement,
        [&]
        {
          return mrpt::format(
              "scans and inertial data show a LiDAR that is turned by %.1f +- %.1f deg from the "
              "pose in use, surely more than %.1f",
              kDegPerRad * s.mounting_error->angle, kDegPerRad * s.mounting_error->std,
              kDegPerRad * context.max_mounting_error);
        });
  if (s.gyro_scale)
    consider(
        health, below(s.gyro_scale->leastError(), context.max_gyro_scale_error),
        HealthCause::MotionDisagreement,
        [&]
        {
          return mrpt::format(
              "the gyro sees %.3f +- %.3f times the turns of the scans, surely more than %g off: "
              "wrong unit, range setting or imu.gyro_matrix?",
              s.gyro_scale->scale(), s.gyro_scale->std, context.max_gyro_scale_error);
        });
  if (s.range_scale)
    consider(
        health, below(s.range_scale->leastError(), context.max_range_scale_error),
        HealthCause::MotionDisagreement,
        [&]
        {
          return mrpt::format(
              "the scans see %.3f +- %.3f times the changes of velocity that the accelerometer "
              "sees, surely more than %g off: are ranges or specific force in a wrong unit, or the "
              "inertial data filtered?",
              s.range_scale->scale, s.range_scale->std, context.max_range_scale_error);
        });
  if (s.inertial_step)
    consider(
        health, kPredicted, HealthCause::MotionDisagreement,
        [&]
        {
          return std::string(
              "scans and inertial data contradict each other at once, by far: the pose of the "
              "LiDAR or the clocks are wrong, the inertial sensor is not what it was, or the "
              "LiDAR sees what moves with it, as in an elevator");
        });
  consider(
      health, below(s.motion_innovation, kMaxMotionInnovation), HealthCause::MotionDisagreement,
      [&]
      {
        return mrpt::format(
            "scans and inertial data see different motions, %.0f times as far apart as their noise "
            "explains: is the pose of the LiDAR (input.T_vehicle_lidar) wrong, or units, point "
            "times, "
            "clocks or inertial readings?",
            s.motion_innovation);
      });
}

void considerInertialData(double inflated, const NavState& x, ScanHealth& health)
{
  const auto missing = [&]
  {
    return mrpt::format(
        "%.0f %% of the inertial data since the scan before are missing, clipped or absurd, "
        "more than %.0f %%",
        100.0 * inflated, 100.0 * kMaxInflatedRatio);
  };
  consider(health, below(inflated, kMaxInflatedRatio), HealthCause::InertialData, missing);
  // They distort the scan, and a distorted scan matches badly: that is no second cause.
  const bool matches_badly =
      health.cause == HealthCause::FewMatches || health.cause == HealthCause::LargeResidual;
  if (inflated > kMaxInflatedRatio && matches_badly)
  {
    health.cause = HealthCause::InertialData;
    health.reason = missing();
  }
  consider(
      health, below(x.gyro_bias.norm(), kMaxGyroBias), HealthCause::Bias,
      [&]
      {
        return mrpt::format(
            "the gyro's bias has run to %.2f deg/s, more than %.2f",
            kDegPerRad * x.gyro_bias.norm(), kDegPerRad * kMaxGyroBias);
      });
  consider(
      health, below(x.accel_bias.norm(), kMaxAccelBias), HealthCause::Bias,
      [&]
      {
        return mrpt::format(
            "the accelerometer's bias has run to %.2f m/s^2, more than %.2f", x.accel_bias.norm(),
            kMaxAccelBias);
      });
}

/** A map of few scans may have no planes yet, as among trunks. While the prediction is certain, as
 * at rest, the pose is good. */
bool beginsAsExpected(const ScanResult& result, const HealthContext& context)
{
  constexpr double kCertain = 0.02;  // [m]
  const Mat3 position = result.filter.P.block<3, 3>(kPosition, kPosition);
  return context.map_is_sparse && position.diagonal().maxCoeff() < kCertain * kCertain;
}
}  // namespace

ScanHealth healthOf(const ScanResult& result, const HealthContext& context)
{
  ScanHealth health;
  const double interval_s = toSeconds(result.stamp_ns - context.since_ns);
  const auto message = [&] { return result.message; };
  if (result.status == ScanStatus::Initializing)
    consider(health, 0.0, HealthCause::Starting, message);
  else if (result.status == ScanStatus::Diverged)
    consider(health, 0.0, HealthCause::Lost, message);
  else if (result.status == ScanStatus::PredictionOnly)
    consider(
        health, beginsAsExpected(result, context) ? 1.0 : kPredicted, HealthCause::NoMatch,
        message);
  else if (result.status == ScanStatus::Tracking)
  {
    if (!context.map_is_sparse) considerInlierRatio(result.statistics, health);
    // A position that is off along a degenerate direction leaves residuals wherever something
    // stands across it: they are no second cause.
    if (considerDegenerateDirections(result, context.lost_std, health))
      considerMatches(result.statistics, health);
    considerMotion(result.statistics, context, health);
    considerSearch(result.statistics, health);
  }
  considerInertialData(context.inflated_ratio, result.filter.x, health);
  consider(
      health, below(interval_s, kMaxScanInterval), HealthCause::ScanTiming,
      [&]
      {
        return mrpt::format(
            "%.2f s since the scan before, more than %g: scans are "
            "missing, or the LiDAR's stamps jump",
            interval_s, kMaxScanInterval);
      });
  return health;
}

}  // namespace fastlio
