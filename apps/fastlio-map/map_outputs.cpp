// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_outputs.h"

#include <fastlio/exporters/graph_files.h>
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/failure_text.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

ExportTarget targetOf(const MapFiles& files, const Session& session, const OutputFrame& frame)
{
  ExportTarget target;
  target.directory = fs::path(files.path("simplemap")).parent_path().string();
  target.frame = frame;
  target.parameters = session.config().exporters;
  target.recording = {session.files(), session.selection(), session.plan().bridge};
  target.time_offset = session.config().odometry.lidar.time_offset;
  return target;
}

bool isOfSession(const MapFileKind& kind)
{
  return kind.of == MapFileKind::Of::Session;
}

/** A motion between poses of the IMU as that between poses of a body on it. */
RelativePose ofBody(const RelativePose& imu, const Pose& T_imu_body)
{
  RelativePose body;
  body.T_a_b = T_imu_body.inverse() * imu.T_a_b * T_imu_body;
  // R' = X^T R X, p' = X^T (R x + p - x): by the attitude error of R, which is in the frame of b.
  const Mat3 back = T_imu_body.R.transpose();
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = back;
  J.bottomLeftCorner<3, 3>() = -back * imu.T_a_b.R * skew(T_imu_body.p);
  J.bottomRightCorner<3, 3>() = back;
  body.covariance = J * imu.covariance * J.transpose();
  return body;
}

/** The graph with what was accepted, at the corrected poses. */
struct GraphContent
{
  std::vector<Pose> poses;
  std::vector<GraphFileEdge> edges;
};

GraphContent graphOf(const MappingResult& result, const Pose& T_imu_body)
{
  GraphContent content;
  for (const Pose& node : result.estimate.nodes)
    content.poses.push_back(node * T_imu_body);
  for (std::size_t i = 0; i < result.graph.edges.size(); ++i)
  {
    const GraphEdge& edge = result.graph.edges[i];
    if (edge.robust && result.estimate.edge_weights.at(i) < 0.5) continue;
    const RelativePose motion = withoutSensorErrors(edge, result.estimate);
    content.edges.push_back({edge.a, edge.b, ofBody(motion, T_imu_body)});
  }
  return content;
}
}  // namespace

const std::vector<MapFileKind>& mapFileKinds()
{
  using Of = MapFileKind::Of;
  static const std::vector<MapFileKind> kinds = {
      {"trajectory", "trajectory.tum", "corrected pose at each scan's end (TUM)", true,
       Of::Session},
      {"states", "states.csv", "the whole state and its standard deviations", true, Of::Session},
      {"covariance", "covariance.csv", "corrected pose and its 6x6 covariance", true, Of::Session},
      {"ply", "map.ply", "map: points with intensity and time (PLY)", true, Of::Map,
       makePlyMapExporter},
      {"pcd", "map.pcd", "the same as PCD", false, Of::Map, makePcdMapExporter},
      {"text", "map.txt", "the same as text", false, Of::Map, makeTextMapExporter},
      {"las", "map.las", "the same as LAS 1.4, in projected coordinates where the place is known",
       false, Of::Map},
      {"metricmap", "map.metricmap", "map for MRPT programs", false, Of::Map,
       makeMetricMapExporter},
      {"planes", "map.planes", "map of planes, for fastlio-replay --map-in", true, Of::Result,
       makePlanesExporter},
      {"simplemap", "keyframes.simplemap", "keyframes with their raw scans, of one run", false,
       Of::Session},
      {"graph", "poses.graph", "pose graph with the closures, for MRPT", true, Of::Result},
      {"g2o", "poses.g2o", "the same for g2o", true, Of::Result},
      {"report", "report.html", "page that shows what was closed, and what was not", true, Of::Map},
      {"summary", "summary.json", "submaps, closures with their evidence, files", true, Of::Result},
  };
  return kinds;
}

bool isMapFileName(const std::string& name)
{
  const auto is_of = [&name](const MapFileKind& kind)
  {
    const fs::path file(kind.file), seen(name);
    if (name == kind.file) return true;
    // One of several sessions: "trajectory.walk.tum".
    const std::string start = file.stem().string() + ".";
    return isOfSession(kind) && seen.extension() == file.extension() &&
           seen.stem().string().size() > start.size() && name.rfind(start, 0) == 0;
  };
  return std::any_of(mapFileKinds().begin(), mapFileKinds().end(), is_of);
}

MapFiles::MapFiles(const MapArguments& arguments, const std::vector<std::string>& sessions)
    : directory_(arguments.output_directory), sessions_(sessions)
{
  const auto& names = arguments.exporters;
  for (const MapFileKind& kind : mapFileKinds())
  {
    const bool is_named = std::find(names.begin(), names.end(), kind.name) != names.end();
    // The record of the folder is always written.
    if ((names.empty() ? kind.standard : is_named) || std::string(kind.name) == "summary")
      kinds_.push_back(kind);
  }
}

bool MapFiles::wants(const std::string& kind) const
{
  return std::any_of(
      kinds_.begin(), kinds_.end(), [&kind](const MapFileKind& k) { return kind == k.name; });
}

bool MapFiles::wantsMap() const
{
  return std::any_of(
      kinds_.begin(), kinds_.end(),
      [](const MapFileKind& kind) { return kind.of == MapFileKind::Of::Map; });
}

std::string MapFiles::nameOf(const MapFileKind& kind, std::size_t session) const
{
  if (!isOfSession(kind) || sessions_.size() < 2) return kind.file;
  const std::string file = kind.file;
  const std::size_t dot = file.rfind('.');
  return file.substr(0, dot) + "." + sessions_.at(session) + file.substr(dot);
}

std::string MapFiles::path(const std::string& kind, std::size_t session) const
{
  const auto& all = mapFileKinds();
  const auto found = std::find_if(
      all.begin(), all.end(), [&kind](const MapFileKind& k) { return kind == k.name; });
  return (fs::path(directory_) / nameOf(*found, session)).string();
}

std::vector<std::string> MapFiles::names() const
{
  std::vector<std::string> names;
  for (const MapFileKind& kind : kinds_)
    for (std::size_t session = 0; session < (isOfSession(kind) ? sessions_.size() : 1); ++session)
      names.push_back(nameOf(kind, session));
  return names;
}

SubmapStoreOptions submapStoreOptions(const MapArguments& arguments, const Config& config)
{
  constexpr double kPerMillion = 1e6;
  return {
      static_cast<std::size_t>(config.exporters.submap_memory * kPerMillion),
      arguments.output_directory};
}

MapOutputs::MapOutputs(
    const MapArguments& arguments, const MapFiles& files, const std::vector<Session>& sessions)
    : plan_(files),
      frame_(arguments.frame),
      map_(outputMapOptions(
          sessions.front().config().exporters,
          sessions.front().config().odometry.map.output_spacing, arguments.output_directory))
{
  for (const MapFileKind& kind : files.wanted())
    if (kind.make != nullptr) of_map_.add(kind.make(files.path(kind.name)), files.path(kind.name));
  if (files.wants("planes"))
  {
    VoxelPlaneOptions options;
    options.voxel_size = voxelSize(sessions.front().config().odometry.map, false);
    planes_ = std::make_unique<VoxelPlaneMap>(options);
  }
}

bool MapOutputs::add(
    const Session& session, std::size_t number, const MappingResult& result, MovingObjects* moving,
    const PassHooks& hooks)
{
  ExporterSet& of_session = of_sessions_.emplace_back();
  const OutputFrame frame = outputFrameOf(frame_, session.plan().T_vehicle_imu);
  const auto path = [&](const char* kind) { return plan_.path(kind, number); };
  if (plan_.wants("trajectory"))
    of_session.add(makeTumExporter(path("trajectory"), frame), path("trajectory"));
  if (plan_.wants("states")) of_session.add(makeStatesExporter(path("states")), path("states"));
  if (plan_.wants("covariance"))
    of_session.add(makeCovarianceExporter(path("covariance"), frame), path("covariance"));
  if (plan_.wants("simplemap"))
    of_session.add(makeSimpleMapExporter(targetOf(plan_, session, frame)), path("simplemap"));
  return placeScans(
      session, number, result,
      [&](const PlacedScan& scan) { take(moving == nullptr ? scan : moving->withoutMoving(scan)); },
      hooks);
}

void MapOutputs::take(const PlacedScan& scan)
{
  of_sessions_.back().onScan(scan.result);
  if (scan.points.size() == 0) return;
  if (planes_) planes_->insert(scan.points, scan.sensor_origin);
  // A map with gaps is of no use, and what the disk refuses would pile up in memory.
  if (!plan_.wantsMap() || !map_problem_.empty()) return;
  try
  {
    map_.insert({scan.points, scan.fields});
  }
  catch (const std::exception& e)
  {
    map_problem_ = failureText(e);
    of_map_.giveUpMap(map_problem_);
  }
}

void MapOutputs::collect(RunSummary summary)
{
  written_.insert(written_.end(), summary.outputs.begin(), summary.outputs.end());
  problems_.insert(problems_.end(), summary.output_problems.begin(), summary.output_problems.end());
}

void MapOutputs::finish(
    const MappingResult& result, const OutputFrame& frame, const std::optional<Georeference>& place)
{
  for (ExporterSet& of_session : of_sessions_)
    collect(of_session.finish({}, map_));
  collect(of_map_.finish({}, map_, planes_.get()));
  const GraphContent graph = graphOf(result, frame.T_imu_body);
  const auto write = [&](const char* kind, const auto& make)
  {
    if (!plan_.wants(kind)) return;
    try
    {
      written_.push_back(make(plan_.path(kind)));
    }
    catch (const std::exception& e)
    {
      problems_.push_back(failureText(e));
    }
  };
  write(
      "graph", [&](const std::string& path)
      { return writeFileAtomically(path, mrptGraphText(graph.poses, graph.edges)); });
  write(
      "g2o", [&](const std::string& path)
      { return writeFileAtomically(path, g2oGraphText(graph.poses, graph.edges)); });
  write(
      "las",
      [&](const std::string& path)
      {
        if (!map_problem_.empty())
          throw std::runtime_error("cannot write '" + path + "': " + map_problem_);
        return writeLasMap(path, map_, place);
      });
}

}  // namespace fastlio
