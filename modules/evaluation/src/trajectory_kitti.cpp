// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "pose_parsing.h"
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/math/time.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>

#include <Eigen/LU>

#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::size_t kKittiColumns = 12;

Pose parsePoseMatrix(const DataLine& line, const TextPlace& place)
{
  const std::vector<std::string_view> columns = splitAtBlanks(line.text);
  if (columns.size() != kKittiColumns)
    failAt(
        place, "expected the 12 numbers of a 3x4 matrix, row by row, saw " +
                   std::to_string(columns.size()) + " columns");
  Eigen::Matrix<double, 3, 4> Rp;
  for (int i = 0; i < 12; ++i)
    Rp(i / 4, i % 4) = parseNumber(columns[static_cast<std::size_t>(i)], place);
  const Mat3 R = Rp.leftCols<3>();
  if (!isRotation(R)) failAt(place, "the left 3x3 block is not a rotation matrix within 0.001");
  return {normalizeRotation(R), Rp.col(3)};
}

std::vector<std::int64_t> readTimes(const std::filesystem::path& file)
{
  std::vector<std::int64_t> times;
  for (const DataLine& line : readDataLines(file))
  {
    const TextPlace place{file, line.number};
    if (splitAtBlanks(line.text).size() != 1)
      failAt(place, "expected one time in seconds per line, saw '" + printable(line.text) + "'");
    times.push_back(parseSeconds(line.text, place));
  }
  return times;
}

std::vector<std::int64_t> timesAtRate(double rate, std::size_t count)
{
  std::vector<std::int64_t> times(count);
  for (std::size_t i = 0; i < count; ++i)
    times[i] = toNanoseconds(static_cast<double>(i) / rate);
  return times;
}

void requireOneTiming(const std::filesystem::path& file, const KittiTiming& timing)
{
  const bool has_rate = timing.rate > 0.0 && std::isfinite(timing.rate);
  if (timing.times_file.empty() != has_rate)
    throw std::runtime_error(
        file.string() +
        ": KITTI poses carry no time; give either a file of times or a rate above 0 Hz");
}

std::vector<std::int64_t> timesOf(
    const std::filesystem::path& file, const KittiTiming& timing, std::size_t poses)
{
  requireOneTiming(file, timing);
  if (timing.times_file.empty()) return timesAtRate(timing.rate, poses);
  std::vector<std::int64_t> times = readTimes(timing.times_file);
  if (times.size() != poses)
    throw std::runtime_error(
        timing.times_file.string() + ": holds " + std::to_string(times.size()) + " times, but " +
        file.string() + " holds " + std::to_string(poses) + " poses; they must be as many");
  return times;
}

}  // namespace

Trajectory readKitti(const std::filesystem::path& file, const KittiTiming& timing)
{
  const std::vector<DataLine> lines = readDataLines(file);
  const std::vector<std::int64_t> times = timesOf(file, timing, lines.size());
  Trajectory trajectory;
  trajectory.source = file.string();
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const TextPlace place{file, lines[i].number};
    appendPose(trajectory, {times[i], parsePoseMatrix(lines[i], place)}, place);
  }
  return trajectory;
}

}  // namespace fastlio
