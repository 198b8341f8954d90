// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mrpt_bridge/output/standard_exporters.h>

#include <filesystem>

namespace fastlio
{
ExporterSet makeStandardExporters(const OutputOptions& options)
{
  ExporterSet set;
  if (!options.tum_path.empty()) set.add(makeTumExporter(options.tum_path, options.frame));
  if (options.directory.empty()) return set;
  const auto path = [&options](const char* name)
  { return (std::filesystem::path(options.directory) / name).string(); };
  set.add(makeTumExporter(path("trajectory.tum"), options.frame));
  set.add(makeStatesExporter(path("states.csv")));
  set.add(makeCovarianceExporter(path("covariance.csv"), options.frame));
  if (options.imu_rate) set.add(makeImuRateExporter(path("imu_rate.csv"), options.frame));
  set.add(makeTimingExporter(path("timing.csv")));
  set.add(makePlyMapExporter(path("map.ply")));
  set.add(makeMetricMapExporter(path("map.metricmap")));
  set.add(makeSummaryExporter(path("summary.json")));  // last: it lists the files before it
  return set;
}

}  // namespace fastlio
