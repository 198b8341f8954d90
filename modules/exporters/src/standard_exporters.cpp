// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/split_text.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>

namespace fastlio
{
namespace
{
using Options = ExportTarget;

constexpr std::string_view kSummary = "summary";

std::vector<std::string> namesIn(const std::string& list)
{
  std::vector<std::string> names;
  for (const std::string_view name : splitAtCommas(list))
    if (!name.empty()) names.emplace_back(name);
  return names;
}

void requireKnown(const std::vector<std::string>& names, const std::vector<ExporterKind>& kinds)
{
  for (const auto& name : names)
  {
    const auto is_it = [&name](const ExporterKind& kind) { return kind.name == name; };
    if (std::any_of(kinds.begin(), kinds.end(), is_it)) continue;
    std::string known;
    for (const auto& kind : kinds)
      known += (known.empty() ? "" : ", ") + std::string(kind.name);
    throw std::invalid_argument(
        "there is no exporter '" + name + "' (--export, output.exporters); there are: " + known);
  }
}

bool isWanted(const ExporterKind& kind, const std::vector<std::string>& names, bool imu_rate)
{
  if (kind.name == kSummary) return true;
  if (std::find(names.begin(), names.end(), kind.name) != names.end()) return true;
  if (kind.name == "imu_rate") return imu_rate;
  return names.empty() && kind.standard;
}

std::vector<ExporterKind> wantedKinds(
    const Options& options, const std::vector<ExporterKind>& kinds)
{
  const auto names = namesIn(options.parameters.exporters);
  requireKnown(names, kinds);
  std::vector<ExporterKind> wanted;
  if (options.directory.empty()) return wanted;
  const auto is_wanted = [&](const ExporterKind& kind)
  { return isWanted(kind, names, options.imu_rate); };
  std::copy_if(kinds.begin(), kinds.end(), std::back_inserter(wanted), is_wanted);
  return wanted;
}
}  // namespace

std::string ExportTarget::path(std::string_view file) const
{
  return (std::filesystem::path(directory) / file).string();
}

std::string referenceFor(const std::string& given, const std::vector<std::string>& recordings)
{
  if (!given.empty() || recordings.empty()) return given;
  const std::filesystem::path beside =
      std::filesystem::path(recordings.front()).replace_extension(".gt.tum");
  std::error_code ignored;
  return std::filesystem::is_regular_file(beside, ignored) ? beside.string() : std::string();
}

const std::vector<ExporterKind>& exporterKinds()
{
  static const std::vector<ExporterKind> kinds = {
      {"trajectory", "trajectory.tum", "pose at each scan's end (TUM)", true,
       [](const Options& o) { return makeTumExporter(o.path("trajectory.tum"), o.frame); }},
      {"kitti", "trajectory.kitti", "the same as 3x4 matrices, times beside it", false,
       [](const Options& o) { return makeKittiExporter(o.path("trajectory.kitti"), o.frame); },
       "trajectory.kitti_times"},
      {"states", "states.csv", "the whole state and its standard deviations", true,
       [](const Options& o) { return makeStatesExporter(o.path("states.csv")); }},
      {"covariance", "covariance.csv", "pose and its 6x6 covariance", true,
       [](const Options& o) { return makeCovarianceExporter(o.path("covariance.csv"), o.frame); }},
      {"imu_rate", "imu_rate.csv", "state at each inertial sample", false,
       [](const Options& o) { return makeImuRateExporter(o.path("imu_rate.csv"), o.frame); }},
      {"timing", "timing.csv", "what became of each scan, milliseconds per stage", true,
       [](const Options& o) { return makeTimingExporter(o.path("timing.csv")); }},
      {"untrusted", "untrusted.csv", "stretches of the run that cannot be trusted, and why", true,
       [](const Options& o) { return makeUntrustedExporter(o.path("untrusted.csv")); }},
      {"ply", "map.ply", "map: points with intensity and time (PLY)", true,
       [](const Options& o) { return makePlyMapExporter(o.path("map.ply")); }},
      {"pcd", "map.pcd", "the same as PCD", false,
       [](const Options& o) { return makePcdMapExporter(o.path("map.pcd")); }},
      {"text", "map.txt", "the same as text", false,
       [](const Options& o) { return makeTextMapExporter(o.path("map.txt")); }},
      {"metricmap", "map.metricmap", "map for MRPT programs", true,
       [](const Options& o) { return makeMetricMapExporter(o.path("map.metricmap")); }},
      {"planes", "map.planes", "map of planes that scans were matched with, for --map-in", false,
       [](const Options& o) { return makePlanesExporter(o.path("map.planes")); }},
      {"simplemap", "keyframes.simplemap", "keyframes with their raw scans", false,
       makeSimpleMapExporter},
      {"rawlog", "odometry.rawlog", "odometry for other SLAM programs", false, makeRawlogExporter},
      {"graph", "poses.graph", "pose graph for MRPT", false, makeGraphExporter},
      {"g2o", "poses.g2o", "pose graph for g2o", false, makeG2oExporter},
      {"scene", "scene.3Dscene", "map, path and uncertainty for SceneViewer3D", false,
       makeSceneExporter},
      // After the files whose problems it lists.
      {"report", "report.html", "page that shows and explains the run", true, makeReportExporter},
      // The last: it lists the files before it.
      {kSummary, "summary.json", "the run: inputs, parameters, losses, speed, problems", true,
       [](const Options& o) { return makeSummaryExporter(o.path("summary.json")); }},
  };
  return kinds;
}

std::string fileHelpLine(
    std::string_view name, std::string_view file, std::string_view content, bool standard)
{
  constexpr std::size_t kNameWidth = 12, kFileWidth = 21;
  return "  " + padded(name, kNameWidth) + padded(file, kFileWidth) + std::string(content) +
         (standard ? "" : " *") + "\n";
}

std::string exporterHelp()
{
  std::string text;
  for (const auto& kind : exporterKinds())
    text += fileHelpLine(kind.name, kind.file, kind.content, kind.standard);
  return text;
}

OutputMapOptions outputMapOptions(
    const ExportOptions& parameters, double spacing, const std::string& directory)
{
  constexpr double kPerMillion = 1e6;
  OutputMapOptions options;
  options.spacing = spacing;
  options.tile_size = parameters.tile_size;
  options.points_in_memory = static_cast<std::size_t>(parameters.map_memory * kPerMillion);
  options.directory = directory;
  return options;
}

std::vector<std::string> outputFileNames(
    const ExportTarget& options, const std::vector<ExporterKind>& kinds)
{
  std::vector<std::string> files;
  for (const ExporterKind& kind : wantedKinds(options, kinds))
    for (const std::string_view file : {kind.file, kind.second_file})
      if (!file.empty()) files.emplace_back(file);
  return files;
}

bool isOutputFileName(std::string_view name)
{
  const auto& kinds = exporterKinds();
  return !name.empty() && std::any_of(
                              kinds.begin(), kinds.end(),
                              [name](const ExporterKind& kind)
                              { return kind.file == name || kind.second_file == name; });
}

ExporterSet makeExporters(const ExportTarget& options, const std::vector<ExporterKind>& kinds)
{
  const std::vector<ExporterKind> wanted = wantedKinds(options, kinds);
  ExporterSet set;
  if (!options.tum_path.empty())
    set.add(makeTumExporter(options.tum_path, options.frame), options.tum_path);
  for (const ExporterKind& kind : wanted)
    set.add(kind.make(options), options.path(kind.file));
  return set;
}

}  // namespace fastlio
