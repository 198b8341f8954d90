// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file standard_exporters.h The files that a run writes. */
#pragma once

#include <fastlio/mrpt_bridge/output/exporter.h>
#include <fastlio/mrpt_bridge/output/pose_output.h>

#include <string>

namespace fastlio
{
/** What to write and where; an empty path leaves the file or files out. */
struct OutputOptions
{
  std::string directory;  //!< exists; receives all files of docs/outputs.md
  std::string tum_path;   //!< one more trajectory in TUM format
  OutputFrame frame;      //!< body of trajectory.tum, covariance.csv and imu_rate.csv
  bool imu_rate = false;  //!< also writes imu_rate.csv
};

/** Every exporter of docs/outputs.md. A new one is a line in this function.
 * \exception std::runtime_error a file cannot be opened */
[[nodiscard]] ExporterSet makeStandardExporters(const OutputOptions& options);

/** `trajectory.tum`: "t x y z qx qy qz qw" per scan with a pose, t in seconds with 9 decimals. */
[[nodiscard]] std::unique_ptr<Exporter> makeTumExporter(
    const std::string& path, const OutputFrame& frame);

/** `states.csv`: the whole state of the IMU body and its 18 standard deviations. */
[[nodiscard]] std::unique_ptr<Exporter> makeStatesExporter(const std::string& path);

/** `covariance.csv`: pose and the upper triangle of its 6x6 covariance. */
[[nodiscard]] std::unique_ptr<Exporter> makeCovarianceExporter(
    const std::string& path, const OutputFrame& frame);

/** `imu_rate.csv`: pose, velocity and pose covariance at each inertial sample. */
[[nodiscard]] std::unique_ptr<Exporter> makeImuRateExporter(
    const std::string& path, const OutputFrame& frame);

/** `timing.csv`: status, counts and milliseconds per stage of every scan. */
[[nodiscard]] std::unique_ptr<Exporter> makeTimingExporter(const std::string& path);

/** `map.ply`: binary little-endian PLY, float x y z in the world frame [m]. */
[[nodiscard]] std::unique_ptr<Exporter> makePlyMapExporter(const std::string& path);

/** `map.metricmap`: a gzipped, serialised mrpt::maps::CSimplePointsMap. */
[[nodiscard]] std::unique_ptr<Exporter> makeMetricMapExporter(const std::string& path);

/** `summary.json`: the RunSummary, with the files of the exporters added before it. */
[[nodiscard]] std::unique_ptr<Exporter> makeSummaryExporter(const std::string& path);

}  // namespace fastlio
