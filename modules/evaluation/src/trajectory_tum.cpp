// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "pose_parsing.h"
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/options/split_text.h>

namespace fastlio
{
namespace
{
constexpr std::size_t kTumColumns = 8;

}  // namespace

Trajectory readTum(const std::filesystem::path& file)
{
  Trajectory trajectory;
  trajectory.source = file.string();
  for (const DataLine& line : readDataLines(file))
  {
    const TextPlace place{file, line.number};
    std::vector<std::string_view> columns = splitAtBlanks(line.text);
    if (columns.size() != kTumColumns)
      failAt(
          place, "expected 8 columns (time x y z qx qy qz qw) separated by blanks, saw " +
                     std::to_string(columns.size()));
    const std::int64_t stamp_ns = parseSeconds(columns.front(), place);
    columns.erase(columns.begin());
    appendPose(trajectory, {stamp_ns, parsePoseQuaternion(columns, place)}, place);
  }
  return trajectory;
}

}  // namespace fastlio
