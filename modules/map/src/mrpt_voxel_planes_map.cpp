// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/mrpt_voxel_planes_map.h>

#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservation;
using mrpt::poses::CPose3D;

WorldPoints transformed(const mrpt::maps::CPointsMap& cloud, const CPose3D& T_map_cloud)
{
  WorldPoints points;
  const auto& xs = cloud.getPointsBufferRef_x();
  const auto& ys = cloud.getPointsBufferRef_y();
  const auto& zs = cloud.getPointsBufferRef_z();
  for (std::size_t i = 0; i < xs.size(); ++i)
  {
    double x = 0, y = 0, z = 0;
    T_map_cloud.composePoint(xs[i], ys[i], zs[i], x, y, z);
    points.add({x, y, z});
  }
  return points;
}

/** The points of an observation in the map's frame; none when MRPT makes no points of its class. */
WorldPoints pointsOf(
    const CObservation& observation, const CPose3D& T_map_vehicle, const CPose3D& T_map_sensor)
{
  // MRPT 2.5 takes no notice of the vehicle's pose here.
  if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation))
    return cloud->pointcloud ? transformed(*cloud->pointcloud, T_map_sensor) : WorldPoints{};
  mrpt::maps::CSimplePointsMap map;
  map.insertionOptions.minDistBetweenLaserPoints = 0;
  map.insertObservation(observation, T_map_vehicle);
  return transformed(map, CPose3D());
}

std::vector<Neighbor> nearestOf(
    const CIncrementalPointsMap& map, const mrpt::math::TPoint3Df& query, std::size_t count,
    double radius)
{
  std::vector<Neighbor> found(std::min(count, map.size()));
  found.resize(map.nearest(query.x, query.y, query.z, found.size(), radius, found.data()));
  return found;
}

/** Neighbours in the three columns that MRPT's interface wants. */
void unpack(
    const std::vector<Neighbor>& neighbors, std::vector<mrpt::math::TPoint3Df>& points,
    std::vector<float>& distances_sqr, std::vector<std::uint64_t>& indices)
{
  points.clear();
  distances_sqr.clear();
  indices.clear();
  for (const Neighbor& n : neighbors)
  {
    points.emplace_back(n.x, n.y, n.z);
    distances_sqr.push_back(n.distance_sqr);
    indices.push_back(n.point_index);
  }
}
}  // namespace

CVoxelPlanesMap::CVoxelPlanesMap() : CVoxelPlanesMap(TCreationOptions{}) {}
CVoxelPlanesMap::CVoxelPlanesMap(const TCreationOptions& options) : planes_(options.planes) {}
CVoxelPlanesMap::CVoxelPlanesMap(const VoxelPlaneMap& planes) : planes_(planes) {}
CVoxelPlanesMap::~CVoxelPlanesMap() = default;

CVoxelPlanesMap::CVoxelPlanesMap(const CVoxelPlanesMap& other)
    : mrpt::maps::CMetricMap(other),
      insertionOptions(other.insertionOptions),
      likelihoodOptions(other.likelihoodOptions),
      renderOptions(other.renderOptions),
      planes_(other.planes_)
{
}

CVoxelPlanesMap& CVoxelPlanesMap::operator=(const CVoxelPlanesMap& other)
{
  if (this == &other) return *this;
  mrpt::maps::CMetricMap::operator=(other);
  insertionOptions = other.insertionOptions;
  likelihoodOptions = other.likelihoodOptions;
  renderOptions = other.renderOptions;
  planes_ = other.planes_;
  points_.reset();
  return *this;
}

// ---- Growing and shrinking ----

std::size_t CVoxelPlanesMap::insertPoints(const WorldPoints& points, const Vec3& sensor_origin)
{
  WorldPoints accepted;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (planes_.accepts(points.x[i], points.y[i], points.z[i]))
      accepted.add(points.x[i], points.y[i], points.z[i]);
  planes_.insert(accepted, sensor_origin);
  points_.reset();
  return accepted.size();
}

void CVoxelPlanesMap::removeOutside(const Vec3& center, double radius)
{
  for (std::size_t i = 0; i < VoxelPlaneMap::kCallsPerSweep; ++i)
    planes_.removeOutside(center, radius);
  points_.reset();
}

void CVoxelPlanesMap::internal_clear()
{
  planes_.clear();
  points_.reset();
}

bool CVoxelPlanesMap::internal_insertObservation(
    const CObservation& obs, const std::optional<const CPose3D>& robotPose)
{
  const CPose3D T_map_vehicle = robotPose ? *robotPose : CPose3D();
  const CPose3D T_map_sensor = T_map_vehicle + CPose3D(obs.sensorPose());
  const Vec3 origin(T_map_sensor.x(), T_map_sensor.y(), T_map_sensor.z());
  if (insertPoints(pointsOf(obs, T_map_vehicle, T_map_sensor), origin) == 0) return false;
  if (insertionOptions.radius > 0.0) removeOutside(origin, insertionOptions.radius);
  return true;
}

bool CVoxelPlanesMap::isEmpty() const
{
  return planes_.pointCount() == 0;
}

std::string CVoxelPlanesMap::asString() const
{
  return "fastlio::CVoxelPlanesMap of " + std::to_string(planes_.pointCount()) + " voxels of " +
         std::to_string(planes_.options().voxel_size) +
         " m, bounding box: " + boundingBox().asString();
}

// ---- As points ----

const CIncrementalPointsMap& CVoxelPlanesMap::points() const
{
  const std::lock_guard lock(points_mutex_);
  if (!points_)
  {
    auto made = std::make_unique<CIncrementalPointsMap>(*planes_.toPointsMap());
    made->likelihoodOptions = likelihoodOptions;
    points_ = std::move(made);
  }
  return *points_;
}

const mrpt::maps::CSimplePointsMap* CVoxelPlanesMap::getAsSimplePointsMap() const
{
  return &points();
}

mrpt::math::TBoundingBoxf CVoxelPlanesMap::boundingBox() const
{
  return points().boundingBox();
}

double CVoxelPlanesMap::internal_computeObservationLikelihood(
    const CObservation& obs, const CPose3D& takenFrom) const
{
  return points().computeObservationLikelihood(obs, takenFrom);
}

bool CVoxelPlanesMap::internal_canComputeObservationLikelihood(const CObservation& obs) const
{
  return points().canComputeObservationLikelihood(obs);
}

void CVoxelPlanesMap::determineMatching3D(
    const mrpt::maps::CMetricMap* other, const CPose3D& other_pose,
    mrpt::tfest::TMatchingPairList& pairs, const mrpt::maps::TMatchingParams& params,
    mrpt::maps::TMatchingExtraResults& extra) const
{
  points().determineMatching3D(other, other_pose, pairs, params, extra);
}

float CVoxelPlanesMap::compute3DMatchingRatio(
    const mrpt::maps::CMetricMap* other, const CPose3D& other_pose,
    const mrpt::maps::TMatchingRatioParams& params) const
{
  return points().compute3DMatchingRatio(other, other_pose, params);
}

// ---- Nearest neighbours ----

void CVoxelPlanesMap::nn_prepare_for_3d_queries() const
{
  (void)points();
}

bool CVoxelPlanesMap::nn_single_search(
    const mrpt::math::TPoint3Df& query, mrpt::math::TPoint3Df& result, float& out_dist_sqr,
    std::uint64_t& result_index) const
{
  const NeighborSet found = points().nearest(query.x, query.y, query.z, 1);
  if (found.empty()) return false;
  result = {found[0].x, found[0].y, found[0].z};
  out_dist_sqr = found[0].distance_sqr;
  result_index = found[0].point_index;
  return true;
}

void CVoxelPlanesMap::nn_multiple_search(
    const mrpt::math::TPoint3Df& query, const std::size_t count,
    std::vector<mrpt::math::TPoint3Df>& results, std::vector<float>& out_dists_sqr,
    std::vector<std::uint64_t>& result_indices) const
{
  constexpr double kEverywhere = std::numeric_limits<double>::infinity();
  unpack(nearestOf(points(), query, count, kEverywhere), results, out_dists_sqr, result_indices);
}

void CVoxelPlanesMap::nn_radius_search(
    const mrpt::math::TPoint3Df& query, const float search_radius_sqr,
    std::vector<mrpt::math::TPoint3Df>& results, std::vector<float>& out_dists_sqr,
    std::vector<std::uint64_t>& result_indices, std::size_t max_points) const
{
  const std::size_t count = max_points == 0 ? points().size() : max_points;
  const double radius = std::sqrt(static_cast<double>(search_radius_sqr));
  unpack(nearestOf(points(), query, count, radius), results, out_dists_sqr, result_indices);
}

#if FASTLIO_MRPT_HAS_NN_INTERFACE
// In the plane, MRPT's own k-d tree of the points searches.
void CVoxelPlanesMap::nn_prepare_for_2d_queries() const
{
  points().nn_prepare_for_2d_queries();
}

bool CVoxelPlanesMap::nn_single_search(
    const mrpt::math::TPoint2Df& query, mrpt::math::TPoint2Df& result, float& out_dist_sqr,
    std::uint64_t& result_index) const
{
  return points().nn_single_search(query, result, out_dist_sqr, result_index);
}

void CVoxelPlanesMap::nn_multiple_search(
    const mrpt::math::TPoint2Df& query, const std::size_t count,
    std::vector<mrpt::math::TPoint2Df>& results, std::vector<float>& out_dists_sqr,
    std::vector<std::uint64_t>& result_indices) const
{
  points().nn_multiple_search(query, count, results, out_dists_sqr, result_indices);
}

void CVoxelPlanesMap::nn_radius_search(
    const mrpt::math::TPoint2Df& query, const float search_radius_sqr,
    std::vector<mrpt::math::TPoint2Df>& results, std::vector<float>& out_dists_sqr,
    std::vector<std::uint64_t>& result_indices, std::size_t max_points) const
{
  points().nn_radius_search(
      query, search_radius_sqr, results, out_dists_sqr, result_indices, max_points);
}
#endif

}  // namespace fastlio
