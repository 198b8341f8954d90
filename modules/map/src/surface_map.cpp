// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/surface_map.h>

namespace fastlio
{
void WorldPoints::resize(std::size_t n)
{
  x.resize(n);
  y.resize(n);
  z.resize(n);
}

void SurfaceMap::rematch(
    const WorldPoints& /*before*/, const WorldPoints& points, const Vec3& sensor_origin,
    std::size_t first, std::size_t last, std::vector<PlaneMatch>& matches) const
{
  match(points, sensor_origin, first, last, matches);
}

}  // namespace fastlio
