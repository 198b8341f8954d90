// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scene_objects.h"
#include <fastlio/compat/mrpt_scene.h>
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/gzip_file.h>
#include <fastlio/run/bounded_path.h>
#include <fastlio/run/pose_track.h>

#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostLines = 20'000;
constexpr std::size_t kMostKeyFrames = 1000;
constexpr double kPathGap = 1.0;  // [s]

mrpt::opengl::CRenderizable::Ptr groundGrid(const std::vector<Vec3>& positions, const Vec3& origin)
{
  constexpr double kMargin = 10.0, kGridStep = 5.0;  // [m]
  double low_x = 0.0, high_x = 0.0, low_y = 0.0, high_y = 0.0;
  for (const Vec3& position : positions)
  {
    if (!position.allFinite()) continue;
    const Vec3 p = position - origin;
    low_x = std::min(low_x, p.x());
    high_x = std::max(high_x, p.x());
    low_y = std::min(low_y, p.y());
    high_y = std::max(high_y, p.y());
  }
  // Not more lines than can be seen, however far the run went.
  const double step = std::max(kGridStep, std::max(high_x - low_x, high_y - low_y) / 100.0);
  const auto edge = [](double v) { return static_cast<float>(v); };
  auto grid = mrpt::opengl::CGridPlaneXY::Create(
      edge(low_x - kMargin), edge(high_x + kMargin), edge(low_y - kMargin), edge(high_y + kMargin),
      0.0F, edge(step));
  grid->setName("grid");
  return grid;
}

class SceneExporter : public Exporter
{
 public:
  explicit SceneExporter(const ExportTarget& options)
      : file_(options.path("scene.3Dscene")),
        T_imu_body_(options.frame.T_imu_body),
        rule_(options.parameters.keyframe_distance, options.parameters.keyframe_angle)
  {
  }

  [[nodiscard]] bool needsMap() const override { return true; }

  void onScan(const ScanResult& result) override
  {
    if (!hasPose(result.status)) return;
    const PoseEstimate body = poseEstimateOf(result.filter, T_imu_body_);
    if (!body.T_world_body.p.allFinite() || !body.T_world_body.R.allFinite()) return;
    path_.add(result.stamp_ns, body.T_world_body.p);
    if (!rule_.accept(body.T_world_body) || accepted_++ % key_frame_stride_ != 0) return;
    key_frames_.push_back(body);
    if (key_frames_.size() < kMostKeyFrames) return;
    for (std::size_t i = 0; 2 * i < key_frames_.size(); ++i)
      key_frames_[i] = key_frames_[2 * i];
    key_frames_.resize((key_frames_.size() + 1) / 2);
    key_frame_stride_ *= 2;
  }

  std::vector<OutputFile> finish(const RunEnd& end) override
  {
    const Vec3& origin = end.map.origin();
    const std::vector<Vec3> positions = path_.positions();
    MrptScene scene;
    scene.insert(groundGrid(positions, origin));
    scene.insert(scenePoints(end.map));
    scene.insert(sceneTrajectory(positions, origin));
    scene.insert(sceneKeyFrames(key_frames_, origin));
    scene.insert(sceneCovariances(key_frames_, origin));
    mrpt::serialization::archiveFrom(file_) << scene;
    return {file_.commit()};
  }

 private:
  GzipFile file_;
  Pose T_imu_body_;
  KeyFrameRule rule_;
  BoundedPath path_{kMostLines, kPathGap};
  std::vector<PoseEstimate> key_frames_;
  std::size_t accepted_ = 0, key_frame_stride_ = 1;
};
}  // namespace

std::unique_ptr<Exporter> makeSceneExporter(const ExportTarget& options)
{
  return std::make_unique<SceneExporter>(options);
}

}  // namespace fastlio
