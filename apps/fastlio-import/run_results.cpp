// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "run_results.h"

#include <fastlio/evaluation/run_table.h>
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/savedmaps/saved_map_file.h>

#include <filesystem>
#include <stdexcept>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

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

DiagnosticStatus statusOf(const RunTable& timing, std::size_t row, const Stretch* stretch)
{
  using Level = DiagnosticStatus::Level;
  constexpr double kLimit = 0.5;  // below it a measure exceeds its limit
  const auto cell = [&](const char* name)
  { return timing.has(name) ? std::string(timing.text(row, name)) : std::string(); };
  DiagnosticStatus result;
  result.name = "odometry";
  result.message = cell("status");
  if (timing.has("health") && timing.number(row, "health") < kLimit)
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

std::vector<Stretch> stretchesOf(const fs::path& file)
{
  std::vector<Stretch> stretches;
  if (!fs::exists(file)) return stretches;
  const RunTable table(file.string());
  for (std::size_t i = 0; i < table.size(); ++i)
    stretches.push_back(
        {table.stamp(i, "begin_ns"), table.stamp(i, "end_ns"),
         std::string(table.text(i, "cause"))});
  return stretches;
}

std::vector<ScanDiagnostic> diagnosticsOf(const fs::path& folder)
{
  std::vector<ScanDiagnostic> diagnostics;
  if (!fs::exists(folder / "timing.csv")) return diagnostics;
  const std::vector<Stretch> stretches = stretchesOf(folder / "untrusted.csv");
  const RunTable timing((folder / "timing.csv").string());
  for (std::size_t i = 0; i < timing.size(); ++i)
  {
    const std::int64_t stamp_ns = timing.stamp(i, "stamp_ns");
    diagnostics.push_back({stamp_ns, statusOf(timing, i, stretchAt(stretches, stamp_ns))});
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
