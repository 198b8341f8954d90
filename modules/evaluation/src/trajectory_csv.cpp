// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "pose_parsing.h"
#include <fastlio/evaluation/run_table.h>
#include <fastlio/evaluation/trajectory_io.h>

#include <array>
#include <string>

namespace fastlio
{
namespace
{
using Texts = std::vector<std::string_view>;

Texts textsOf(const RunTable& table, std::size_t row, const std::vector<std::size_t>& columns)
{
  Texts texts;
  for (const std::size_t column : columns)
    texts.push_back(table.text(row, column));
  return texts;
}

Matrix6 parseUpperTriangle(const Texts& columns, const TextPlace& place)
{
  Matrix6 P;
  std::size_t next = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j)
      P(i, j) = P(j, i) = parseNumber(columns[next++], place);
  return P;
}

/** \param covariance names of its columns; empty: the trajectory gets none */
Trajectory readCsv(const std::filesystem::path& file, const std::vector<std::string>& covariance)
{
  const RunTable table(file);
  const std::vector<std::size_t> stamp = table.columns({"stamp_ns"}),
                                 pose = table.columns({"x", "y", "z", "qx", "qy", "qz", "qw"}),
                                 triangle = table.columns(covariance);
  if (table.size() == 0)
    failAt({file, table.headerLine()}, "no row follows the header; the run gave no pose");
  Trajectory trajectory;
  trajectory.source = file.string();
  for (std::size_t row = 0; row < table.size(); ++row)
  {
    const TextPlace place{file, table.line(row)};
    const std::int64_t stamp_ns = parseNanoseconds(table.text(row, stamp.front()), place);
    appendPose(
        trajectory, {stamp_ns, parsePoseQuaternion(textsOf(table, row, pose), place)}, place);
    if (!triangle.empty())
      trajectory.covariances.push_back(parseUpperTriangle(textsOf(table, row, triangle), place));
  }
  return trajectory;
}
}  // namespace

std::vector<std::string> covarianceColumns()
{
  constexpr std::array kAxes{"rx", "ry", "rz", "px", "py", "pz"};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kAxes.size(); ++i)
    for (std::size_t j = i; j < kAxes.size(); ++j)
      names.push_back(std::string("c_") + kAxes[i] + "_" + kAxes[j]);
  return names;
}

Trajectory readStatesCsv(const std::filesystem::path& file)
{
  return readCsv(file, {});
}

Trajectory readCovarianceCsv(const std::filesystem::path& file)
{
  return readCsv(file, covarianceColumns());
}

}  // namespace fastlio
