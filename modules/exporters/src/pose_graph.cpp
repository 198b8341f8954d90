// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/graph_files.h>
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/number_text.h>
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/sensors/conversions.h>

#include <Eigen/Cholesky>

#include <array>

namespace fastlio
{
namespace
{
using Aligned6 = Eigen::Matrix<double, 6, 6>;

// Of standard deviations: a perfect edge has no information matrix.
constexpr double kLeastDeviation = 1e-6;

Aligned6 information(const Aligned6& covariance)
{
  const Aligned6 floor = kLeastDeviation * kLeastDeviation * Aligned6::Identity();
  const Aligned6 inverse = Aligned6(covariance + floor).ldlt().solve(Aligned6::Identity());
  return 0.5 * (inverse + inverse.transpose());
}

std::string upperTriangle(const Aligned6& m)
{
  std::string text;
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column)
      text += " " + roundTripText(m(row, column));
  return text;
}

/** x y z roll pitch yaw. */
std::string anglesText(const Pose& pose)
{
  const auto p = toMrptPose(pose);
  std::string text;
  for (const double v : {p.x(), p.y(), p.z(), p.roll(), p.pitch(), p.yaw()})
    text += " " + roundTripText(v);
  return text;
}

/** MRPT's order x, y, z, yaw, pitch, roll to that of the file: x, y, z, roll, pitch, yaw. */
Aligned6 anglesCovariance(const RelativePose& edge)
{
  constexpr std::array kOrder = {0, 1, 2, 5, 4, 3};
  return mrptCovariance(edge.T_a_b, edge.covariance).asEigen()(kOrder, kOrder);
}

/** g2o's error of an edge: its position in the frame of the measured pose, the vector part of the
 * quaternion, which is half the rotation vector. */
Aligned6 quaternionCovariance(const RelativePose& edge)
{
  Matrix6 J = Matrix6::Zero();
  J.topRightCorner<3, 3>() = edge.T_a_b.R.transpose();
  J.bottomLeftCorner<3, 3>() = 0.5 * Mat3::Identity();
  return J * edge.covariance * J.transpose();
}

std::string ids(const GraphFileEdge& edge)
{
  return std::to_string(edge.from) + " " + std::to_string(edge.to);
}

std::string mrptVertex(std::size_t id, const Pose& pose)
{
  return "VERTEX3 " + std::to_string(id) + anglesText(pose) + "\n";
}

std::string mrptEdge(const GraphFileEdge& edge)
{
  return "EDGE3 " + ids(edge) + anglesText(edge.motion.T_a_b) +
         upperTriangle(information(anglesCovariance(edge.motion))) + "\n";
}

std::string g2oVertex(std::size_t id, const Pose& pose)
{
  return "VERTEX_SE3:QUAT " + std::to_string(id) + " " + poseColumns(pose, ' ') + "\n";
}

std::string g2oEdge(const GraphFileEdge& edge)
{
  return "EDGE_SE3:QUAT " + ids(edge) + " " + poseColumns(edge.motion.T_a_b, ' ') +
         upperTriangle(information(quaternionCovariance(edge.motion))) + "\n";
}

template <typename Vertex, typename Edge>
std::string graphText(
    const std::vector<Pose>& poses, const std::vector<GraphFileEdge>& edges, const Vertex& vertex,
    const Edge& edge)
{
  std::string text;
  for (std::size_t i = 0; i < poses.size(); ++i)
    text += vertex(i, poses[i]);
  if (!poses.empty()) text += "FIX 0\n";
  for (const GraphFileEdge& one : edges)
    text += edge(one);
  return text;
}

using GraphFormat =
    std::string (*)(const std::vector<Pose>& poses, const std::vector<GraphFileEdge>& edges);

class GraphExporter : public Exporter
{
 public:
  GraphExporter(const std::string& path, const ExportTarget& options, GraphFormat format)
      : file_(path),
        format_(format),
        track_(options.frame),
        rule_(options.parameters.keyframe_distance, options.parameters.keyframe_angle)
  {
  }

  /** Keeps key frames only: with its covariances, a pose has 2 kB. */
  void onScan(const ScanResult& result) override
  {
    if (!hasPose(result.status)) return;
    const Pose T_world_body = result.filter.x.pose() * track_.frame().T_imu_body;
    if (rule_.accept(T_world_body)) track_.add(result);
  }

  std::vector<OutputFile> finish(const RunEnd& /*end*/) override
  {
    const std::vector<TrackedPose>& frames = track_.poses();
    std::vector<Pose> poses;
    std::vector<GraphFileEdge> edges;
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
      poses.push_back(frames[i].T_world_body);
      if (i > 0) edges.push_back({i - 1, i, relativePose(frames[i - 1], frames[i])});
    }
    file_.write(format_(poses, edges));
    return {file_.commit()};
  }

 private:
  AtomicFile file_;
  GraphFormat format_;
  PoseTrack track_;
  KeyFrameRule rule_;
};
}  // namespace

std::string mrptGraphText(const std::vector<Pose>& poses, const std::vector<GraphFileEdge>& edges)
{
  return graphText(poses, edges, mrptVertex, mrptEdge);
}

std::string g2oGraphText(const std::vector<Pose>& poses, const std::vector<GraphFileEdge>& edges)
{
  return graphText(poses, edges, g2oVertex, g2oEdge);
}

std::unique_ptr<Exporter> makeGraphExporter(const ExportTarget& options)
{
  return std::make_unique<GraphExporter>(options.path("poses.graph"), options, mrptGraphText);
}

std::unique_ptr<Exporter> makeG2oExporter(const ExportTarget& options)
{
  return std::make_unique<GraphExporter>(options.path("poses.g2o"), options, g2oGraphText);
}

}  // namespace fastlio
