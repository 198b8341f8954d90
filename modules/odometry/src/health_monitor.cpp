// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "health_monitor.h"

#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kTrouble = 0.5;
constexpr double kOpenButKnown = 0.6;  // a direction that is open and left to the inertial data
constexpr double kPredicted = 0.25;
constexpr int kYoungMapScans = 20;

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

double share(const ScanStatistics& s, std::size_t points)
{
  return points > 0 ? static_cast<double>(s.points_effective) / static_cast<double>(points) : 0.0;
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

void considerShare(const ScanStatistics& s, const HealthOptions& limits, ScanHealth& health)
{
  consider(
      health, above(share(s, s.points_downsampled), limits.min_share * s.usual_share),
      HealthCause::FewMatches,
      [&]
      {
        return mrpt::format(
            "%zu of %zu points match the map, less than %g of the share that matched before, %.3f "
            "(health.min_share)",
            s.points_effective, s.points_downsampled, limits.min_share, s.usual_share);
      });
}

void considerMatches(const ScanStatistics& s, const HealthOptions& limits, ScanHealth& health)
{
  consider(
      health, below(s.normalized_innovation, limits.max_innovation), HealthCause::LargeResidual,
      [&]
      {
        return mrpt::format(
            "the residuals are %.1f times what their noise explains, more than %g "
            "(health.max_innovation): wrong pose, extrinsic, time offset or point times?",
            s.normalized_innovation, limits.max_innovation);
      });
  const double information = above(s.information_eigenvalues[0], limits.min_information);
  const bool known = s.constraints.unconstrained > 0;
  consider(
      health, known ? std::max(information, kOpenButKnown) : information,
      HealthCause::OpenDirection,
      [&]
      {
        return mrpt::format(
            "the surroundings leave a direction open: smallest eigenvalue of the information %.3g, "
            "less than %g (health.min_information)",
            s.information_eigenvalues[0], limits.min_information);
      });
}

void considerInertialData(
    double inflated, const NavState& x, const HealthOptions& limits, ScanHealth& health)
{
  consider(
      health, below(inflated, limits.max_inflated), HealthCause::InertialData,
      [&]
      {
        return mrpt::format(
            "%.0f %% of the inertial data since the scan before are missing, clipped or absurd, "
            "more than %.0f %% (health.max_inflated)",
            100.0 * inflated, 100.0 * limits.max_inflated);
      });
  consider(
      health, below(x.gyro_bias.norm(), limits.max_gyro_bias), HealthCause::Bias,
      [&]
      {
        return mrpt::format(
            "the gyro's bias has run to %.2f deg/s, more than %.2f (health.max_gyro_bias)",
            kDegPerRad * x.gyro_bias.norm(), kDegPerRad * limits.max_gyro_bias);
      });
  consider(
      health, below(x.accel_bias.norm(), limits.max_accel_bias), HealthCause::Bias,
      [&]
      {
        return mrpt::format(
            "the accelerometer's bias has run to %.2f m/s^2, more than %.2f "
            "(health.max_accel_bias)",
            x.accel_bias.norm(), limits.max_accel_bias);
      });
}
}  // namespace

bool evidenceIsGood(
    const ScanStatistics& statistics, std::size_t points, const HealthOptions& limits)
{
  return share(statistics, points) >= limits.min_share * statistics.usual_share;
}

void HealthMonitor::judge(const std::vector<NoiseInflation>& inflations, ScanResult& result)
{
  ScanHealth health;
  const std::int64_t since_ns = last_ns_ == 0 ? result.begin_ns : last_ns_;
  const double interval_s = toSeconds(result.stamp_ns - since_ns);
  last_ns_ = result.stamp_ns;
  const auto message = [&] { return result.message; };
  if (result.status == ScanStatus::Initializing)
    consider(health, 0.0, HealthCause::Starting, message);
  else if (result.status == ScanStatus::Diverged)
    consider(health, 0.0, HealthCause::Lost, message);
  else if (result.status == ScanStatus::PredictionOnly)
    consider(health, kPredicted, HealthCause::NoMatch, message);
  else if (result.status == ScanStatus::Tracking)
  {
    if (young_scans_ == 0) considerShare(result.statistics, limits_, health);
    considerMatches(result.statistics, limits_, health);
    young_scans_ = std::max(0, young_scans_ - 1);
  }
  else if (result.status == ScanStatus::FirstScan)
    young_scans_ = kYoungMapScans;
  considerInertialData(
      inflatedRatio(inflations, since_ns, result.stamp_ns), result.filter.x, limits_, health);
  consider(
      health, below(interval_s, limits_.max_scan_interval), HealthCause::ScanTiming,
      [&]
      {
        return mrpt::format(
            "%.2f s since the scan before, more than %g (health.max_scan_interval): scans are "
            "missing, or the LiDAR's stamps jump",
            interval_s, limits_.max_scan_interval);
      });
  result.health = std::move(health);
}

}  // namespace fastlio
