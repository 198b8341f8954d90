// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "pose_parsing.h"
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/options/split_text.h>

#include <algorithm>
#include <array>

namespace fastlio
{
namespace
{
using Names = std::vector<std::string>;

/** Places of named columns in every row. */
using ColumnIndices = std::vector<std::size_t>;

Names poseNames()
{
  return {"x", "y", "z", "qx", "qy", "qz", "qw"};
}

Names covarianceNames()
{
  constexpr std::array kAxes{"rx", "ry", "rz", "px", "py", "pz"};
  Names names;
  for (std::size_t i = 0; i < kAxes.size(); ++i)
    for (std::size_t j = i; j < kAxes.size(); ++j)
      names.push_back(std::string("c_") + kAxes[i] + "_" + kAxes[j]);
  return names;
}

ColumnIndices findColumns(
    const std::vector<std::string_view>& header, const Names& names, const TextPlace& place)
{
  ColumnIndices indices;
  std::string missing;
  for (const std::string& name : names)
  {
    const auto it = std::find(header.begin(), header.end(), name);
    if (it == header.end()) missing += (missing.empty() ? "" : ", ") + name;
    indices.push_back(static_cast<std::size_t>(it - header.begin()));
  }
  if (!missing.empty())
    failAt(
        place, "the header line lacks the columns " + missing +
                   "; expected the header of states.csv or covariance.csv");
  return indices;
}

std::vector<std::string_view> pick(
    const std::vector<std::string_view>& row, const ColumnIndices& columns)
{
  std::vector<std::string_view> picked;
  for (const std::size_t i : columns)
    picked.push_back(row[i]);
  return picked;
}

Matrix6 parseUpperTriangle(const std::vector<std::string_view>& columns, const TextPlace& place)
{
  Matrix6 P;
  std::size_t next = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j)
      P(i, j) = P(j, i) = parseNumber(columns[next++], place);
  return P;
}

/** The columns to read of each row; covariance stays empty for a trajectory without. */
struct Layout
{
  std::size_t width = 0;
  ColumnIndices stamp, pose, covariance;
};

Layout layoutOf(const DataLine& header, const Names& covariance, const TextPlace& place)
{
  const std::vector<std::string_view> names = splitAtCommas(header.text);
  return {
      names.size(), findColumns(names, {"stamp_ns"}, place), findColumns(names, poseNames(), place),
      findColumns(names, covariance, place)};
}

void appendRow(
    Trajectory& trajectory, const DataLine& line, const Layout& layout, const TextPlace& place)
{
  const std::vector<std::string_view> row = splitAtCommas(line.text);
  if (row.size() != layout.width)
    failAt(
        place, "expected " + std::to_string(layout.width) +
                   " comma-separated columns as in the header, saw " + std::to_string(row.size()));
  const std::int64_t stamp_ns = parseNanoseconds(row[layout.stamp.front()], place);
  const Pose pose = parsePoseQuaternion(pick(row, layout.pose), place);
  appendPose(trajectory, {stamp_ns, pose}, place);
  if (!layout.covariance.empty())
    trajectory.covariances.push_back(parseUpperTriangle(pick(row, layout.covariance), place));
}

Trajectory readCsv(const std::filesystem::path& file, const Names& covariance)
{
  const std::vector<DataLine> lines = readDataLines(file);
  const Layout layout = layoutOf(lines.front(), covariance, {file, lines.front().number});
  if (lines.size() < 2)
    failAt({file, lines.front().number}, "no row follows the header; the run gave no pose");
  Trajectory trajectory;
  trajectory.source = file.string();
  for (auto line = lines.begin() + 1; line != lines.end(); ++line)
    appendRow(trajectory, *line, layout, {file, line->number});
  return trajectory;
}

}  // namespace

Trajectory readStatesCsv(const std::filesystem::path& file)
{
  return readCsv(file, {});
}

Trajectory readCovarianceCsv(const std::filesystem::path& file)
{
  return readCsv(file, covarianceNames());
}

}  // namespace fastlio
