// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file standard_exporters.h The files that a run writes: one row per format. */
#pragma once

#include <fastlio/exporters/export_options.h>
#include <fastlio/exporters/exporter.h>
#include <fastlio/run/pose_output.h>
#include <fastlio/run/recording_access.h>

#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** The files to write and their places; an empty path leaves the file or files out. */
struct ExportTarget
{
  std::string directory;      //!< exists; receives the files
  std::string tum_path;       //!< one more trajectory in TUM format
  OutputFrame frame;          //!< body of all poses but those of states.csv
  ExportOptions parameters;   //!< exporters (names, separated by commas) and what they obey
  RecordingAccess recording;  //!< for files that hold raw observations
  double time_offset = 0.0;   //!< added to the stamps of raw scans (lidar.time_offset) [s]
  bool imu_rate = false;      //!< also imu_rate.csv (output.imu_rate)
  std::string reference;      //!< trajectory to compare with in the report; empty: none
  double max_range = 150.0;   //!< of planar scans (lidar.max_range) [m]

  /** Path of a file in the directory. */
  [[nodiscard]] std::string path(std::string_view file) const;
};

/** A format: a row of exporterKinds(). */
struct ExporterKind
{
  std::string_view name;     //!< for --export and output.exporters
  std::string_view file;     //!< name of its file
  std::string_view content;  //!< for people
  bool standard;             //!< written when no names are given
  std::unique_ptr<Exporter> (*make)(const ExportTarget& options);
  std::string_view second_file = {};  //!< name of another file of the same format; empty: none
};

/** Every format. A new one is a file with a class, and a row here. */
[[nodiscard]] const std::vector<ExporterKind>& exporterKinds();

/** The trajectory to compare a run with: the one that is given, or the ground truth beside the
 * first recording (`NAME.gt.tum` for `NAME.rawlog`); empty: there is none. */
[[nodiscard]] std::string referenceFor(
    const std::string& given, const std::vector<std::string>& recordings);

/** A line for --help on a file that a program can write. \param standard false: only when named */
[[nodiscard]] std::string fileHelpLine(
    std::string_view name, std::string_view file, std::string_view content, bool standard);

/** Such a line for each of exporterKinds(). */
[[nodiscard]] std::string exporterHelp();

/** The map that is collected for the exporters of a run.
 * \param spacing least distance of points (map.output_spacing) [m]
 * \param directory of the run's files */
[[nodiscard]] OutputMapOptions outputMapOptions(
    const ExportOptions& parameters, double spacing, const std::string& directory);

/** The exporters that the options name, of \a kinds (a program may add its own); without names the
 * standard ones, and imu_rate with output.imu_rate. The summary is always written, as the last.
 * \exception std::invalid_argument an unknown name (the message lists those that there are)
 * \exception std::runtime_error a file cannot be opened */
[[nodiscard]] ExporterSet makeExporters(
    const ExportTarget& options, const std::vector<ExporterKind>& kinds = exporterKinds());

/** Names of the files that makeExporters() writes into the directory, without the directory.
 * \exception std::invalid_argument as makeExporters() */
[[nodiscard]] std::vector<std::string> outputFileNames(
    const ExportTarget& options, const std::vector<ExporterKind>& kinds = exporterKinds());

/** Whether one of exporterKinds() writes a file of this name into the directory. */
[[nodiscard]] bool isOutputFileName(std::string_view name);

/** `trajectory.tum`: "t x y z qx qy qz qw" per scan with a pose, t in seconds with 9 decimals. */
[[nodiscard]] std::unique_ptr<Exporter> makeTumExporter(
    const std::string& path, const OutputFrame& frame);

/** `trajectory.kitti`: the 3x4 matrix [R t] row by row per scan with a pose; the stamps [s] in
 * `trajectory.kitti_times`. */
[[nodiscard]] std::unique_ptr<Exporter> makeKittiExporter(
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

/** `untrusted.csv`: stretches of the run that cannot be trusted, with their cause. */
[[nodiscard]] std::unique_ptr<Exporter> makeUntrustedExporter(const std::string& path);

/** `map.ply`: binary little-endian PLY in the world frame: float x y z [m] intensity, double time
 * [s]. */
[[nodiscard]] std::unique_ptr<Exporter> makePlyMapExporter(const std::string& path);

/** `map.pcd`: the same as binary PCD. */
[[nodiscard]] std::unique_ptr<Exporter> makePcdMapExporter(const std::string& path);

/** `map.txt`: the same as text, one point per line. */
[[nodiscard]] std::unique_ptr<Exporter> makeTextMapExporter(const std::string& path);

/** `map.metricmap`: a gzipped, serialised mrpt::maps::CSimplePointsMap. */
[[nodiscard]] std::unique_ptr<Exporter> makeMetricMapExporter(const std::string& path);

/** `map.planes`: the map of planes that scans were matched with, a gzipped, serialised
 * fastlio::CVoxelPlanesMap. */
[[nodiscard]] std::unique_ptr<Exporter> makePlanesExporter(const std::string& path);

/** `keyframes.simplemap`: a gzipped mrpt::maps::CSimpleMap of the raw scans of keyframes. */
[[nodiscard]] std::unique_ptr<Exporter> makeSimpleMapExporter(const ExportTarget& options);

/** `odometry.rawlog`: what other SLAM programs of MRPT take as odometry. */
[[nodiscard]] std::unique_ptr<Exporter> makeRawlogExporter(const ExportTarget& options);

/** `poses.graph`: keyframes and the motions between them, as mrpt::graphs reads them (VERTEX3,
 * EDGE3 with information matrices). */
[[nodiscard]] std::unique_ptr<Exporter> makeGraphExporter(const ExportTarget& options);

/** `poses.g2o`: the same for g2o (VERTEX_SE3:QUAT, EDGE_SE3:QUAT). */
[[nodiscard]] std::unique_ptr<Exporter> makeG2oExporter(const ExportTarget& options);

/** `scene.3Dscene`: map, trajectory, keyframes and ellipsoids of their covariances, for
 * SceneViewer3D of MRPT. */
[[nodiscard]] std::unique_ptr<Exporter> makeSceneExporter(const ExportTarget& options);

/** `report.html`: a page that shows and explains the run, without any other file. */
[[nodiscard]] std::unique_ptr<Exporter> makeReportExporter(const ExportTarget& options);

/** `summary.json`: the RunSummary, with the files of the exporters added before it. */
[[nodiscard]] std::unique_ptr<Exporter> makeSummaryExporter(const std::string& path);

}  // namespace fastlio
