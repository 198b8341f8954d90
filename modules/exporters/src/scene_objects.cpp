// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scene_objects.h"

#include <fastlio/sensors/conversions.h>

#include <mrpt/img/color_maps.h>
#include <mrpt/opengl/CEllipsoid3D.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/stock_objects.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr float kPointSize = 2.0F;
constexpr float kLineWidth = 3.0F;
constexpr float kEllipsoidSigmas = 3.0F;
constexpr float kAxesLength = 0.3F;  // [m]

std::pair<float, float> heightRange(const OutputMap& map)
{
  float low = 0.0F, high = 0.0F;
  bool first = true;
  map.forEachTile(
      [&](const OutputPoints& points)
      {
        for (const float z : points.z)
        {
          low = first ? z : std::min(low, z);
          high = first ? z : std::max(high, z);
          first = false;
        }
      });
  return {low, high};
}

/** The pose counted from the origin of the scene, because drawings are of single precision. */
mrpt::poses::CPose3D posedFrom(const Vec3& origin, const Pose& pose)
{
  return toMrptPose({pose.R, Vec3(pose.p - origin)});
}
}  // namespace

mrpt::opengl::CRenderizable::Ptr scenePoints(const OutputMap& map)
{
  auto cloud = mrpt::opengl::CPointCloudColoured::Create();
  cloud->setName("map");
  cloud->setPointSize(kPointSize);
  const auto [low, high] = heightRange(map);
  const float span = std::max(high - low, 1e-3F), begin = low;
  const std::size_t stride = (map.size() + kMostScenePoints - 1) / kMostScenePoints;
  std::size_t index = 0;
  map.forEachTile(
      [&](const OutputPoints& points)
      {
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          if (index++ % stride != 0) continue;
          float r = 0.0F, g = 0.0F, b = 0.0F;
          mrpt::img::jet2rgb((points.z[i] - begin) / span, r, g, b);
          cloud->push_back(points.x[i], points.y[i], points.z[i], r, g, b);
        }
      });
  return cloud;
}

mrpt::opengl::CRenderizable::Ptr sceneTrajectory(
    const std::vector<Vec3>& positions, const Vec3& origin)
{
  auto lines = mrpt::opengl::CSetOfLines::Create();
  lines->setName("trajectory");
  lines->setLineWidth(kLineWidth);
  lines->setColor_u8(0xD0, 0x20, 0x20);
  for (std::size_t i = 1; i < positions.size(); ++i)
  {
    if (!positions[i - 1].allFinite() || !positions[i].allFinite()) continue;
    const Vec3 a = positions[i - 1] - origin, b = positions[i] - origin;
    lines->appendLine(a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
  }
  return lines;
}

mrpt::opengl::CRenderizable::Ptr sceneCovariances(
    const std::vector<PoseEstimate>& key_frames, const Vec3& origin)
{
  auto set = mrpt::opengl::CSetOfObjects::Create();
  set->setName("covariances");
  for (const PoseEstimate& frame : key_frames)
  {
    const Mat3 covariance = frame.covariance.bottomRightCorner<3, 3>();
    // A covariance that is none cannot be drawn.
    if (!covariance.allFinite() || !(covariance.diagonal().minCoeff() > 0.0)) continue;
    auto ellipsoid = mrpt::opengl::CEllipsoid3D::Create();
    ellipsoid->setCovMatrix(mrpt::math::CMatrixDouble33(covariance));
    ellipsoid->setQuantiles(kEllipsoidSigmas);
    ellipsoid->enableDrawSolid3D(false);
    ellipsoid->setColor_u8(0x20, 0x60, 0xD0);
    const Vec3 p = frame.T_world_body.p - origin;
    ellipsoid->setLocation(p.x(), p.y(), p.z());
    set->insert(ellipsoid);
  }
  return set;
}

mrpt::opengl::CRenderizable::Ptr sceneKeyFrames(
    const std::vector<PoseEstimate>& key_frames, const Vec3& origin)
{
  auto set = mrpt::opengl::CSetOfObjects::Create();
  set->setName("keyframes");
  for (const PoseEstimate& frame : key_frames)
  {
    auto axes = mrpt::opengl::stock_objects::CornerXYZSimple(kAxesLength);
    axes->setPose(posedFrom(origin, frame.T_world_body));
    set->insert(axes);
  }
  return set;
}

}  // namespace fastlio
