// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/report/report_series.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <unistd.h>

namespace fastlio
{
namespace
{
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr double kMillimetres = 1e3;

/** Resident memory of this process [MB]; not a number where the system does not report it. */
float residentMegabytes()
{
  std::ifstream in("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  if (!(in >> total >> resident)) return kNone;
  return static_cast<float>(resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6);
}

void putVector(std::array<float, kReportChannels>& values, std::size_t channel, const Vec3& vector)
{
  for (int i = 0; i < 3; ++i)
    values.at(channel + static_cast<std::size_t>(i)) = static_cast<float>(vector[i]);
}

Vec3 sigmaOf(const FilterState& filter, StateBlock block)
{
  return filter.P.diagonal().segment<3>(block).cwiseMax(0.0).cwiseSqrt();
}

void putEvidence(std::array<float, kReportChannels>& values, const ScanStatistics& s)
{
  values[kPointsInChannel] = static_cast<float>(s.points_in);
  values[kPointsDownsampledChannel] = static_cast<float>(s.points_downsampled);
  values[kPointsEffectiveChannel] = static_cast<float>(s.points_effective);
  values[kMapPointsChannel] = static_cast<float>(s.map_points);
  values[kUnconstrainedChannel] = static_cast<float>(s.constraints.unconstrained);
  if (s.points_effective == 0) return;
  values[kResidualChannel] = static_cast<float>(kMillimetres * s.residual_rms);
  values[kInnovationChannel] = static_cast<float>(s.normalized_innovation);
}

void putTimes(std::array<float, kReportChannels>& values, const StageTimings& t)
{
  std::size_t channel = kStagesChannel;
  for (const double ms :
       {t.propagate, t.deskew, t.downsample, t.associate, t.update, t.insert, t.total})
    values.at(channel++) = static_cast<float>(ms);
}

/** fmin and fmax take the other value where one is not a number. */
void takeIn(
    ReportBin& bin, const std::array<float, kReportChannels>& low,
    const std::array<float, kReportChannels>& high)
{
  for (std::size_t i = 0; i < kReportChannels; ++i)
  {
    bin.low.at(i) = std::fmin(bin.low.at(i), low.at(i));
    bin.high.at(i) = std::fmax(bin.high.at(i), high.at(i));
  }
}

void takeIn(ReportBin& bin, const ReportBin& next)
{
  takeIn(bin, next.low, next.high);
  bin.end_s = next.end_s;
  if (next.position) bin.position = next.position;
  if (next.open_axis) bin.open_axis = next.open_axis;
  if (next.worst_health >= bin.worst_health) return;
  bin.worst_health = next.worst_health;
  bin.cause = next.cause;
}

void halve(std::vector<ReportBin>& bins)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < bins.size(); i += 2, ++kept)
  {
    ReportBin bin = bins[i];
    if (i + 1 < bins.size()) takeIn(bin, bins[i + 1]);
    bins[kept] = bin;
  }
  bins.resize(kept);
}

std::optional<Vec3> openAxisOf(const ScanConstraints& constraints)
{
  if (constraints.unconstrained == 0) return std::nullopt;
  for (const MotionDirection& motion : unconstrainedMotions(constraints))
    if (!motion.is_rotation) return motion.axis;
  return std::nullopt;
}
}  // namespace

/** The bin that the next scan belongs to. */
ReportBin& ReportSeries::openBin(double begin_s)
{
  if (bins_.empty() || scans_in_last_ == scans_per_bin_)
  {
    if (bins_.size() == kMaxBins)
    {
      halve(bins_);
      scans_per_bin_ *= 2;
    }
    bins_.emplace_back();
    bins_.back().begin_s = begin_s;
    bins_.back().low.fill(kNone);
    bins_.back().high.fill(kNone);
    bins_.back().low[kMemoryChannel] = bins_.back().high[kMemoryChannel] = residentMegabytes();
    scans_in_last_ = 0;
  }
  ++scans_in_last_;
  return bins_.back();
}

ReportSeries::Values ReportSeries::valuesOf(const ScanResult& result, const PoseEstimate& body)
{
  Values values;
  values.fill(kNone);
  putEvidence(values, result.statistics);
  putTimes(values, result.milliseconds);
  values[kHealthChannel] = static_cast<float>(result.health.value);
  if (!hasPose(result.status)) return values;
  const NavState& x = result.filter.x;
  values[kHeightChannel] = static_cast<float>(body.T_world_body.p.z());
  values[kSpeedChannel] = static_cast<float>(x.v.norm());
  const double seconds = toSeconds(result.stamp_ns - last_pose_ns_);
  if (last_attitude_ && seconds > 0.0)
    values[kRateChannel] =
        static_cast<float>(kDegPerRad * logSO3(last_attitude_->transpose() * x.R).norm() / seconds);
  last_attitude_ = x.R;
  last_pose_ns_ = result.stamp_ns;
  putVector(values, kGyroBiasChannel, kDegPerRad * x.gyro_bias);
  putVector(values, kGyroSigmaChannel, kDegPerRad * sigmaOf(result.filter, kGyroBias));
  putVector(values, kAccelBiasChannel, x.accel_bias);
  putVector(values, kAccelSigmaChannel, sigmaOf(result.filter, kAccelBias));
  const Vector6 sigma = body.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  putVector(values, kAttitudeSigmaChannel, kDegPerRad * sigma.head<3>());
  putVector(values, kPositionSigmaChannel, sigma.tail<3>());
  return values;
}

void ReportSeries::add(const ScanResult& result)
{
  if (bins_.empty()) begin_ns_ = result.begin_ns;
  const PoseEstimate body = poseEstimateOf(result.filter, T_imu_body_);
  const Values values = valuesOf(result, body);
  ReportBin& bin = openBin(toSeconds(result.begin_ns - begin_ns_));
  takeIn(bin, values, values);
  bin.end_s = toSeconds(result.stamp_ns - begin_ns_);
  if (const auto axis = openAxisOf(result.statistics.constraints)) bin.open_axis = axis;
  if (result.health.value < bin.worst_health)
  {
    bin.worst_health = result.health.value;
    bin.cause = result.health.cause;
  }
  if (!hasPose(result.status)) return;
  bin.position = body.T_world_body.p;
  path_.add(result.stamp_ns, body.T_world_body.p);
}

}  // namespace fastlio
