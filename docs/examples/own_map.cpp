// mrpt_fastlio: a map of your own: what a SurfaceMap has to answer.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/scan.h>
#include <fastlio/map/plane_fit.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/simulation/simulation.h>

#include <mrpt/maps/CSimplePointsMap.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>

namespace
{
using fastlio::Vec3;

/** The simplest map that works: cubes of the world, each with its points and the plane through
 * them. A point is answered by the cube that it lies in. */
class CubeMap : public fastlio::SurfaceMap
{
 public:
  explicit CubeMap(double edge) : edge_(edge) {}

  void match(
      const fastlio::WorldPoints& points, const Vec3& /*sensor_origin*/, std::size_t first,
      std::size_t last, std::vector<fastlio::PlaneMatch>& matches) const override
  {
    for (std::size_t i = first; i < last; ++i)
      matches[i] = matchOf(Vec3(points.x[i], points.y[i], points.z[i]));
  }

  void insert(const fastlio::WorldPoints& points, const Vec3& /*sensor_origin*/) override
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Vec3 point(points.x[i], points.y[i], points.z[i]);
      cubes_[cubeOf(point)].points.push_back(point);
    }
    for (auto& [key, cube] : cubes_)
      cube.plane = planeThrough(cube.points);
  }

  void removeOutside(const Vec3& center, double radius) override
  {
    for (auto it = cubes_.begin(); it != cubes_.end();)
      it = (it->second.points.front() - center).norm() > radius ? cubes_.erase(it) : std::next(it);
  }

  [[nodiscard]] std::size_t pointCount() const override
  {
    std::size_t count = 0;
    for (const auto& [key, cube] : cubes_)
      count += cube.points.size();
    return count;
  }

  [[nodiscard]] mrpt::maps::CSimplePointsMap::Ptr toPointsMap() const override
  {
    auto map = mrpt::maps::CSimplePointsMap::Create();
    for (const auto& [key, cube] : cubes_)
      for (const Vec3& p : cube.points)
        map->insertPoint(
            static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
    return map;
  }

 private:
  using Key = std::array<int, 3>;
  struct Cube
  {
    std::vector<Vec3> points;                  // [m], world frame
    std::optional<fastlio::PlaneFit> plane{};  // none while the points do not make one
  };

  static constexpr std::size_t kLeastPoints = 6;
  static constexpr double kMaxThickness = 0.05;  // [m], standard deviation across the plane
  static constexpr double kPointNoise = 0.02;    // [m]

  [[nodiscard]] Key cubeOf(const Vec3& point) const
  {
    const Eigen::Vector3i cell = (point / edge_).array().floor().cast<int>();
    return {cell.x(), cell.y(), cell.z()};
  }

  [[nodiscard]] static std::optional<fastlio::PlaneFit> planeThrough(
      const std::vector<Vec3>& points)
  {
    if (points.size() < kLeastPoints) return std::nullopt;
    auto plane = fastlio::fitPlane(fastlio::momentsOf(points.data(), points.size()), 0.01);
    if (plane && plane->eigenvalues[0] > kMaxThickness * kMaxThickness) plane.reset();
    return plane;
  }

  /** No match keeps the negative variance that a PlaneMatch begins with. */
  [[nodiscard]] fastlio::PlaneMatch matchOf(const Vec3& point) const
  {
    fastlio::PlaneMatch match;
    const auto found = cubes_.find(cubeOf(point));
    if (found == cubes_.end() || !found->second.plane) return match;
    const fastlio::PlaneFit& plane = *found->second.plane;
    match.nx = static_cast<float>(plane.normal.x());
    match.ny = static_cast<float>(plane.normal.y());
    match.nz = static_cast<float>(plane.normal.z());
    match.d = static_cast<float>(-plane.normal.dot(plane.centroid));
    match.variance =
        static_cast<float>(fastlio::planeOffsetVariance(plane, point, kPointNoise * kPointNoise));
    return match;
  }

  double edge_;  // [m]
  std::map<Key, Cube> cubes_;
};

/** A simulated scan in the world frame, each point with the true pose at its own time. */
fastlio::WorldPoints inWorld(const fastlio::Simulation& simulation, std::size_t index)
{
  const fastlio::LidarScan scan = simulation.scan(index);
  fastlio::WorldPoints world;
  world.resize(scan.points.size());
  for (std::size_t i = 0; i < scan.points.size(); ++i)
  {
    const auto stamp = scan.stamp_ns + scan.points.time_offset_ns[i];
    const Vec3 p_lidar(scan.points.x[i], scan.points.y[i], scan.points.z[i]);
    const Vec3 p = simulation.truth(stamp).T_world_imu * (scan.T_imu_lidar * p_lidar);
    world.x[i] = static_cast<float>(p.x());
    world.y[i] = static_cast<float>(p.y());
    world.z[i] = static_cast<float>(p.z());
  }
  return world;
}

/** Whether the map of ten scans answers most points of the next one, with small residuals. */
bool run()
{
  fastlio::SimulationSettings settings = fastlio::defaultSettings("office");
  settings.duration = 5.0;
  const fastlio::Simulation simulation(settings);
  constexpr std::size_t kMapScans = 10;

  CubeMap map(0.4);  // [m]
  for (std::size_t i = 0; i < kMapScans; ++i)
    map.insert(inWorld(simulation, i), Vec3::Zero());

  const fastlio::WorldPoints points = inWorld(simulation, kMapScans);
  std::vector<fastlio::PlaneMatch> matches(points.size());
  map.match(points, Vec3::Zero(), 0, points.size(), matches);

  std::size_t inliers = 0;
  double sum_of_squares = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const fastlio::PlaneMatch& m = matches[i];
    if (!m.valid()) continue;
    const double z = m.nx * points.x[i] + m.ny * points.y[i] + m.nz * points.z[i] + m.d;  // eq. 12
    sum_of_squares += z * z;
    ++inliers;
  }
  const double ratio = static_cast<double>(inliers) / static_cast<double>(points.size());
  const double rms = std::sqrt(sum_of_squares / static_cast<double>(inliers));
  std::cout << map.pointCount() << " points in the map; inlier ratio " << ratio << ", residual "
            << rms << " m (rms)\n";
  return ratio > 0.5 && rms < 0.05;
}
}  // namespace

int main()
{
  try
  {
    return run() ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
