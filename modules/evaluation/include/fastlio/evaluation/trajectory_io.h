// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file trajectory_io.h Trajectories from files.
 *
 * All readers skip blank lines and lines that start with '#', and throw std::runtime_error naming
 * file, line, what was seen and what to do: unreadable file, no pose, wrong number of columns, not
 * a finite number, stamps that do not increase, a quaternion or rotation matrix that is not one
 * within 1e-3.
 */
#pragma once

#include <fastlio/evaluation/trajectory.h>

#include <filesystem>

namespace fastlio
{
/** Where the stamps of a KITTI pose file come from: exactly one of both. */
struct KittiTiming
{
  std::filesystem::path times_file;  //!< one time [s] per line, one line per pose
  double rate = 0.0;                 //!< poses per second [Hz], the first at 0 s
};

/** TUM: `time[s] x y z[m] qx qy qz qw` per line. Times are read exactly to the nanosecond. */
[[nodiscard]] Trajectory readTum(const std::filesystem::path& file);

/** KITTI: the 3x4 matrix [R p] row by row per line, 12 numbers [m]. */
[[nodiscard]] Trajectory readKitti(const std::filesystem::path& file, const KittiTiming& timing);

/** The poses of `states.csv`: columns stamp_ns, x, y, z, qx, qy, qz, qw, found by name. */
[[nodiscard]] Trajectory readStatesCsv(const std::filesystem::path& file);

/** Poses and covariances of `covariance.csv`: the columns of `states.csv`'s pose and the upper
 * triangle c_rx_rx, c_rx_ry, ..., c_pz_pz in the order of Trajectory::covariances, found by name.
 */
[[nodiscard]] Trajectory readCovarianceCsv(const std::filesystem::path& file);

/** The names of these columns, in their order. */
[[nodiscard]] std::vector<std::string> covarianceColumns();

/** Any of the above, recognised by the first line with data. */
[[nodiscard]] Trajectory readTrajectory(
    const std::filesystem::path& file, const KittiTiming& timing = {});

}  // namespace fastlio
