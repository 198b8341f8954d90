// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "text_numbers.h"
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/options/split_text.h>

namespace fastlio
{
namespace
{
constexpr std::size_t kColumnsOfTum = 8;
constexpr std::size_t kColumnsOfKitti = 12;

bool isCsv(std::string_view line)
{
  return line.find(',') != std::string_view::npos;
}

}  // namespace

Trajectory readTrajectory(const std::filesystem::path& file, const KittiTiming& timing)
{
  const DataLine first = readDataLines(file).front();
  if (isCsv(first.text))
    return first.text.find("c_rx_rx") == std::string::npos ? readStatesCsv(file)
                                                           : readCovarianceCsv(file);
  const std::size_t columns = splitAtBlanks(first.text).size();
  if (columns == kColumnsOfTum) return readTum(file);
  if (columns == kColumnsOfKitti) return readKitti(file, timing);
  failAt(
      {file, first.number},
      "the format is not known: saw " + std::to_string(columns) +
          " columns; expected 8 (TUM), 12 (KITTI) or comma-separated columns with a header "
          "(states.csv, covariance.csv)");
}

}  // namespace fastlio
