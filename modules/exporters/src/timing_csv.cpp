// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/number_text.h>
#include <fastlio/run/run_health.h>

namespace fastlio
{
namespace
{
constexpr const char* kTimingHeader =
    "# Status, counts and times of every scan. stamp_ns: the scan's end. residual_rms in m;\n"
    "# normalized_innovation: mean z^2/r, about 1 when the noise model is true;\n"
    "# information_min: smallest eigenvalue of H^T R^-1 H (weakest direction of the pose).\n"
    "# health: 1 is well, below 0.5 a measure exceeds its limit, 0 lost.\n"
    "stamp_ns,status,points_in,dropped_invalid,dropped_near,dropped_far,"
    "points_downsampled,points_effective,imu_samples,map_points,iterations,converged,at_rest,"
    "residual_rms,normalized_innovation,information_min,propagate_ms,deskew_ms,downsample_ms,"
    "associate_ms,update_ms,insert_ms,total_ms,health,health_cause\n";

std::string counts(const ScanStatistics& s)
{
  std::string text;
  for (const std::size_t n :
       {s.points_in, s.dropped_invalid, s.dropped_near, s.dropped_far, s.points_downsampled,
        s.points_effective, s.imu_samples, s.map_points})
    text += "," + std::to_string(n);
  return text + "," + std::to_string(s.iterations) + "," + (s.converged ? "1" : "0") + "," +
         (s.at_rest ? "1" : "0");
}

std::string measures(const ScanStatistics& s)
{
  return "," + roundTripText(s.residual_rms) + "," + roundTripText(s.normalized_innovation) + "," +
         roundTripText(s.information_eigenvalues[0]);
}

std::string milliseconds(const StageTimings& t)
{
  std::string text;
  for (const double ms :
       {t.propagate, t.deskew, t.downsample, t.associate, t.update, t.insert, t.total})
    text += "," + fixedText(ms, 4);
  return text;
}

std::string timingRow(const ScanResult& result)
{
  // Each scan has a smallest measure; of a good one it is no cause of anything.
  const HealthCause cause =
      result.health.value < kTroubledHealth ? result.health.cause : HealthCause::None;
  return std::to_string(result.stamp_ns) + "," + machineName(result.status) +
         counts(result.statistics) + measures(result.statistics) +
         milliseconds(result.milliseconds) + "," + fixedText(result.health.value, 3) + "," +
         toString(cause) + "\n";
}
}  // namespace

std::unique_ptr<Exporter> makeTimingExporter(const std::string& path)
{
  return rowPerScan(path, kTimingHeader, timingRow);
}

}  // namespace fastlio
