// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "run_results.h"

#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/files/bounded_line.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/options/printable.h>
#include <fastlio/rawlog/saved_map_file.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

/** A row of a table whose first line without # names the columns. */
using Row = std::map<std::string, std::string>;

std::vector<std::string> cellsOf(const std::string& line)
{
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

/** No rows where the file is not there. */
std::vector<Row> readTable(const fs::path& path)
{
  std::vector<Row> rows;
  std::vector<std::string> names;
  std::ifstream in(path, std::ios::binary);
  for (std::string line; readBoundedLine(in, line);)
  {
    if (line.empty() || line.front() == '#') continue;
    const auto cells = cellsOf(line);
    if (names.empty())
    {
      names = cells;
      continue;
    }
    if (cells.size() != names.size())
      throw std::runtime_error(
          "'" + path.string() + "': the row '" + printable(line, 60) + "' is not complete");
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i)
      row[names[i]] = cells[i];
  }
  return rows;
}

std::int64_t stampIn(const Row& row, const char* name)
{
  const auto found = row.find(name);
  const std::string text = found == row.end() ? "" : found->second;
  std::int64_t stamp_ns = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), stamp_ns);
  if (error != std::errc() || end != text.data() + text.size())
    throw std::runtime_error("'" + printable(text) + "' in the column " + name + " is no stamp");
  return stamp_ns;
}

/** A stretch that is not to be relied on. */
struct Stretch
{
  std::int64_t begin_ns = 0, end_ns = 0;
  std::string cause;
};

const Stretch* stretchAt(const std::vector<Stretch>& stretches, std::int64_t stamp_ns)
{
  for (const Stretch& stretch : stretches)
    if (stamp_ns >= stretch.begin_ns && stamp_ns <= stretch.end_ns) return &stretch;
  return nullptr;
}

DiagnosticStatus statusOf(const Row& row, const Stretch* stretch)
{
  using Level = DiagnosticStatus::Level;
  constexpr double kLimit = 0.5;  // below it a measure exceeds its limit
  const auto cell = [&row](const char* name)
  {
    const auto found = row.find(name);
    return found == row.end() ? std::string() : found->second;
  };
  DiagnosticStatus result;
  result.name = "odometry";
  result.message = cell("status");
  const double health = std::strtod(cell("health").c_str(), nullptr);
  if (health < kLimit)
  {
    result.level = Level::Warning;
    result.message += ": " + cell("health_cause");
  }
  if (stretch != nullptr || cell("status") == "diverged") result.level = Level::Error;
  if (stretch != nullptr) result.message = "not to be relied on: " + stretch->cause;
  for (const char* name :
       {"health", "health_cause", "points_effective", "residual_rms", "normalized_innovation",
        "information_min", "total_ms"})
    result.values.emplace_back(name, cell(name));
  return result;
}

std::vector<ScanDiagnostic> diagnosticsOf(const fs::path& folder)
{
  std::vector<Stretch> stretches;
  for (const Row& row : readTable(folder / "untrusted.csv"))
    stretches.push_back({stampIn(row, "begin_ns"), stampIn(row, "end_ns"), row.at("cause")});
  std::vector<ScanDiagnostic> diagnostics;
  for (const Row& row : readTable(folder / "timing.csv"))
  {
    const std::int64_t stamp_ns = stampIn(row, "stamp_ns");
    diagnostics.push_back({stamp_ns, statusOf(row, stretchAt(stretches, stamp_ns))});
  }
  return diagnostics;
}

/** Every n-th of very many: a message must fit into the memory of those who show it. */
std::vector<Vec3> mapOf(const fs::path& folder)
{
  constexpr std::size_t kMostPoints = 5'000'000;
  for (const char* name : {"map.ply", "map.pcd", "map.metricmap"})
  {
    if (!fs::exists(folder / name)) continue;
    const SavedMap saved = loadSavedMap((folder / name).string());
    const std::size_t step = saved.points.size() / kMostPoints + 1;
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < saved.points.size(); i += step)
      points.emplace_back(
          saved.origin + Vec3(saved.points.x[i], saved.points.y[i], saved.points.z[i]));
    return points;
  }
  return {};
}
}  // namespace

RunResults readRunTrajectory(const std::string& file)
{
  RunResults results;
  results.trajectory = readTrajectory(file);
  return results;
}

RunResults readRunFolder(const std::string& folder)
{
  for (const char* name : {"covariance.csv", "trajectory.tum"})
  {
    const fs::path poses = fs::path(folder) / name;
    if (!fs::exists(poses)) continue;
    RunResults results = readRunTrajectory(poses.string());
    results.map = mapOf(folder);
    results.diagnostics = diagnosticsOf(folder);
    return results;
  }
  throw std::runtime_error(
      "'" + folder + "' is no folder of a run: it has neither covariance.csv nor trajectory.tum");
}

}  // namespace fastlio
