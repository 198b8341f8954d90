// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/mrpt_voxel_planes_map.h>

#include <Eigen/Eigenvalues>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CSetOfTriangles.h>

#include <cmath>

namespace fastlio
{
namespace
{
using mrpt::math::TPoint3Df;

/** Corners, in order around the rectangle. */
using Rectangle = std::array<TPoint3Df, 4>;

/** Points that are evenly spread over a width w have the standard deviation w / sqrt(12). */
const float kHalfWidthPerDeviation = std::sqrt(3.0F);

/** The area that the points of a plane cover, by their spread along its two axes. */
Rectangle rectangleOf(const VoxelPlane& plane)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(plane.leverageMatrix());
  const Eigen::Vector3f center(plane.qx, plane.qy, plane.qz);
  // The leverage's eigenvalues are 1 / (n variance), the normal's being zero.
  const auto axis = [&](int i) -> Eigen::Vector3f
  {
    const double variance = plane.inverse_count / solver.eigenvalues()[i];
    return kHalfWidthPerDeviation *
           (std::sqrt(variance) * solver.eigenvectors().col(i)).cast<float>();
  };
  const Eigen::Vector3f a = axis(1), b = axis(2);
  Rectangle corners;
  const std::array<Eigen::Vector3f, 4> positions{
      center - a - b, center + a - b, center + a + b, center - a + b};
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {positions[i].x(), positions[i].y(), positions[i].z()};
  return corners;
}

/** Walls along x and y and floors are red, green and blue; what lies between mixes them. */
mrpt::img::TColor colorOf(const VoxelPlane& plane)
{
  const auto part = [](float n) { return static_cast<std::uint8_t>(40.0F + 200.0F * std::abs(n)); };
  return {part(plane.nx), part(plane.ny), part(plane.nz)};
}

mrpt::opengl::TTriangle triangle(
    const TPoint3Df& a, const TPoint3Df& b, const TPoint3Df& c, const mrpt::img::TColor& color)
{
  mrpt::opengl::TTriangle t(a, b, c);
  t.computeNormals();
  t.setColor(color);
  return t;
}

mrpt::opengl::CSetOfTriangles::Ptr viewOf(const std::vector<VoxelPlane>& planes)
{
  auto view = mrpt::opengl::CSetOfTriangles::Create();
  for (const VoxelPlane& plane : planes)
  {
    const Rectangle r = rectangleOf(plane);
    const auto color = colorOf(plane);
    view->insertTriangle(triangle(r[0], r[1], r[2], color));
    view->insertTriangle(triangle(r[0], r[2], r[3], color));
  }
  return view;
}

mrpt::opengl::CPointCloud::Ptr viewOf(const mrpt::maps::CPointsMap& points, float point_size)
{
  auto view = mrpt::opengl::CPointCloud::Create();
  view->loadFromPointsMap(&points);
  view->enableColorFromZ(true);
  view->setPointSize(point_size);
  return view;
}
}  // namespace

void CVoxelPlanesMap::getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const
{
  if (!genericMapParams.enableSaveAs3DObject) return;
  if (renderOptions.points) scene.insert(viewOf(points(), renderOptions.point_size));
  if (renderOptions.planes) scene.insert(viewOf(planes_.bestPlanes()));
}

}  // namespace fastlio
