// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/run_table.h>
#include <fastlio/math/time.h>
#include <fastlio/tuning/run_measures.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace fastlio
{
namespace
{
constexpr double kSpan = 0.45;       // [s]: half a second, whatever the jitter of the scans
constexpr double kLongestGap = 1.0;  // [s]: the run was re-initialised in between

/** Positions minus the integral of the velocities since the first scan. */
struct Slip
{
  std::vector<double> times;  //!< since the first scan [s]
  std::vector<Vec3> slips;    //!< [m]
};

Slip slipOf(const RunTable& states)
{
  Slip slip;
  std::int64_t first = 0;
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  for (std::size_t i = 0; i < states.size(); ++i)
  {
    const std::int64_t stamp = states.stamp(i, "stamp_ns");
    if (i == 0) first = stamp;
    const double time = toSeconds(stamp - first);
    const Vec3 next_position = states.vector(i, {"x", "y", "z"});
    const Vec3 next_velocity = states.vector(i, {"vx", "vy", "vz"});
    Vec3 step = Vec3::Zero();
    if (i > 0)
      step =
          next_position - position - 0.5 * (time - slip.times.back()) * (velocity + next_velocity);
    slip.slips.push_back(i == 0 ? step : Vec3(slip.slips.back() + step));
    slip.times.push_back(time);
    position = next_position;
    velocity = next_velocity;
  }
  return slip;
}

/** RMS of slip by time over spans; nothing when none fits. */
std::optional<double> rmsOverSpans(const Slip& slip)
{
  double squares = 0.0;
  double count = 0.0;
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < slip.times.size(); ++begin)
  {
    while (end < slip.times.size() && slip.times[end] < slip.times[begin] + kSpan)
      ++end;
    if (end == slip.times.size()) break;
    const double span = slip.times[end] - slip.times[begin];
    if (span > kLongestGap) continue;
    squares += ((slip.slips[end] - slip.slips[begin]) / span).squaredNorm();
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return std::sqrt(squares / count);
}

/** Mean standard deviation of the position [m]. */
double meanPositionStd(const RunTable& states)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < states.size(); ++i)
    sum += states.vector(i, {"sigma_pos_x", "sigma_pos_y", "sigma_pos_z"}).norm();
  return sum / static_cast<double>(states.size());
}

/** Adds the means over tracked scans. */
void addMeans(const RunTable& timing, Measures& measures)
{
  double scans = 0.0;
  double squares = 0.0;
  double matched = 0.0;
  double points = 0.0;
  for (std::size_t i = 0; i < timing.size(); ++i)
  {
    if (timing.text(i, "status") != "tracking") continue;
    scans += 1.0;
    squares += std::pow(timing.number(i, "residual_rms"), 2);
    matched += timing.number(i, "points_effective");
    points += timing.number(i, "points_downsampled");
  }
  if (scans == 0.0 || points == 0.0) return;
  measures["residual"] = std::sqrt(squares / scans);
  measures["inliers"] = matched / points;
}
}  // namespace

Measures measuresOfRun(const std::string& folder)
{
  Measures measures;
  addMeans(RunTable(folder + "/timing.csv"), measures);
  const RunTable states(folder + "/states.csv");
  const Slip slips = slipOf(states);
  if (!slips.times.empty()) measures["duration"] = slips.times.back();
  const auto slip = rmsOverSpans(slips);
  if (!slip || measures.count("residual") == 0) return measures;
  measures["slip"] = *slip;
  measures["position_std"] = meanPositionStd(states);
  measures["proxy"] = *slip * measures.at("position_std");
  return measures;
}

}  // namespace fastlio
