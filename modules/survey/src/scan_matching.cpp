// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/state.h>
#include <fastlio/math/columns.h>
#include <fastlio/survey/motion_check.h>

#include <Eigen/Geometry>
#include <mrpt/maps/CSimplePointsMap.h>

#include <cmath>
#include <unordered_set>

namespace fastlio
{
namespace
{
constexpr double kNearest = 1.0, kFarthest = 60.0;  // ranges that are used [m]
constexpr double kMapSpacing = 0.2;                 // of the earlier scan's points [m]
constexpr double kPointSpacing = 0.6;               // of the later scan's points [m]
constexpr std::size_t kMostPoints = 500;
constexpr std::size_t kNeighbors = 8;
constexpr int kIterations = 12;
constexpr double kReach = 1.0;  // of the neighbours [m]
constexpr double kThin = 0.03;  // thickness of a plane, fraction of the second variance
constexpr double kWide = 0.05;  // second variance of a plane, fraction of the first
constexpr double kSoft = 0.1;   // residuals beyond count less and less [m]
constexpr std::size_t kFewestMatches = 40;
constexpr double kConverged = 1e-4;  // step [rad, m]

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** One point per cube, of those in range. */
std::vector<Vec3> thinned(const PointColumns& points, double spacing)
{
  std::unordered_set<std::int64_t> taken;
  std::vector<Vec3> kept;
  const auto cell = [spacing](double x)
  { return static_cast<std::int64_t>(std::floor(x / spacing)) + (1 << 20); };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p = pointAt(points, i);
    const double range = p.norm();
    if (!(range > kNearest && range < kFarthest)) continue;
    const std::int64_t key = (cell(p.x()) << 42) ^ (cell(p.y()) << 21) ^ cell(p.z());
    if (taken.insert(key).second) kept.push_back(p);
  }
  return kept;
}

struct Plane
{
  Vec3 center, normal;
};

/** The earlier scan, asked for planes. */
class PlaneFinder
{
 public:
  explicit PlaneFinder(const std::vector<Vec3>& points)
  {
    map_.reserve(points.size());
    for (const Vec3& p : points)
      map_.insertPointFast(
          static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
    map_.mark_as_modified();
  }

  [[nodiscard]] std::optional<Plane> planeNear(const Vec3& p) const
  {
    std::vector<std::size_t> indices;
    std::vector<float> squares;
    map_.kdTreeNClosestPoint3DIdx(
        static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), kNeighbors,
        indices, squares);
    if (indices.size() < kNeighbors || squares.back() > kReach * kReach) return std::nullopt;
    return planeThrough(indices);
  }

 private:
  [[nodiscard]] Vec3 point(std::size_t i) const
  {
    return {
        map_.getPointsBufferRef_x()[i], map_.getPointsBufferRef_y()[i],
        map_.getPointsBufferRef_z()[i]};
  }

  [[nodiscard]] std::optional<Plane> planeThrough(const std::vector<std::size_t>& indices) const
  {
    Vec3 center = Vec3::Zero();
    for (const std::size_t i : indices)
      center += point(i) / static_cast<double>(indices.size());
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const std::size_t i : indices)
      scatter += (point(i) - center) * (point(i) - center).transpose();
    const Eigensystem3 axes = symmetricEigensystem(scatter);
    const Vec3& values = axes.values;
    const bool is_plane = values[0] < kThin * values[1] && values[1] > kWide * values[2];
    if (!is_plane) return std::nullopt;
    return Plane{center, axes.vectors.col(0)};
  }

  mrpt::maps::CSimplePointsMap map_;
};

/** One step of Gauss and Newton. */
struct Step
{
  std::size_t matches = 0;
  Vector6 change = Vector6::Zero();  // rotation, translation
};

Step stepFrom(const Pose& T, const PlaneFinder& planes, const std::vector<Vec3>& points)
{
  Step step;
  Matrix6 information = 1e-6 * Matrix6::Identity();
  Vector6 gradient = Vector6::Zero();
  for (const Vec3& point : points)
  {
    const Vec3 p = T * point;
    const auto plane = planes.planeNear(p);
    if (!plane) continue;
    const double residual = plane->normal.dot(p - plane->center);
    const double weight = 1.0 / (1.0 + std::pow(residual / kSoft, 2));
    Vector6 row;
    row << p.cross(plane->normal), plane->normal;
    information += weight * row * row.transpose();
    gradient += weight * residual * row;
    ++step.matches;
  }
  step.change = -solveSymmetric(information, gradient);
  return step;
}

std::vector<Vec3> everySoMany(const std::vector<Vec3>& points)
{
  std::vector<Vec3> kept;
  const std::size_t stride = points.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < points.size(); i += stride)
    kept.push_back(points[i]);
  return kept;
}
}  // namespace

std::optional<Pose> matchScans(
    const PointColumns& earlier, const PointColumns& later, const Pose& guess)
{
  const std::vector<Vec3> map = thinned(earlier, kMapSpacing);
  if (map.size() < kNeighbors) return std::nullopt;  // a search in an empty map throws
  const PlaneFinder planes(map);
  const std::vector<Vec3> points = everySoMany(thinned(later, kPointSpacing));
  Pose T = guess;
  for (int i = 0; i < kIterations; ++i)
  {
    const Step step = stepFrom(T, planes, points);
    if (step.matches < kFewestMatches || !step.change.allFinite()) return std::nullopt;
    T = Pose{expSO3(step.change.head<3>()), step.change.tail<3>()} * T;
    if (step.change.norm() < kConverged) break;
  }
  T.R = normalizeRotation(T.R);
  return T;
}

}  // namespace fastlio
