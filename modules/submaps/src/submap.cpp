// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/voxel_plane_map.h>
#include <fastlio/math/columns.h>
#include <fastlio/math/statistics.h>
#include <fastlio/run/pose_output.h>
#include <fastlio/submaps/submap.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kShortest = 3.0,
                 kLongest = 12.0;  // of a submap, where the rule leaves it open [m]
constexpr double kLengthOverRange = 0.5;

double medianRange(const WorldPoints& points, const Vec3& sensor)
{
  std::vector<double> ranges;
  ranges.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    ranges.push_back((pointAt(points, i) - sensor).norm());
  return median(std::move(ranges));
}

/** How far the reference is off as seen from the surfaces of one scan: both in its frame. */
Matrix6 referenceCovariance(const TrackedPose& reference, TrackedPose pose)
{
  // The scans' own noise averages out over the surfaces.
  pose.covariance = pose.map_covariance;
  const RelativePose back = reversed(relativePose(reference, pose));
  return withPositionTurned(back.T_a_b.R.transpose(), back.covariance);
}
}  // namespace

TrackedPose mappingPoseOf(const ScanResult& result)
{
  TrackedPose pose;
  pose.stamp_ns = result.stamp_ns;
  pose.T_world_body = result.filter.x.pose();
  pose.covariance = result.filter.P.topLeftCorner<6, 6>() - result.calibration_covariance;
  pose.map_covariance = result.map_covariance - result.calibration_covariance;
  pose.ambiguity_covariance = result.ambiguity_covariance;
  pose.pose_by_beams = result.pose_by_beams;
  return pose;
}

void moved(const WorldPoints& points, const Vec3& origin, const Pose& motion, WorldPoints& result)
{
  result.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p = motion * (origin + pointAt(points, i));
    result.x[i] = static_cast<float>(p.x());
    result.y[i] = static_cast<float>(p.y());
    result.z[i] = static_cast<float>(p.z());
  }
}

SubmapBuilder::SubmapBuilder(
    std::size_t session, SubmapRule rule, std::shared_ptr<SubmapStore> store)
    : session_(session),
      rule_(rule),
      store_(std::move(store)),
      surfaces_(std::make_unique<VoxelPlaneMap>(VoxelPlaneOptions{}))
{
}

SubmapBuilder::~SubmapBuilder() = default;
SubmapBuilder::SubmapBuilder(SubmapBuilder&&) noexcept = default;
SubmapBuilder& SubmapBuilder::operator=(SubmapBuilder&&) noexcept = default;

void SubmapBuilder::begin(
    const TrackedPose& pose, const WorldPoints& registered, const Vec3& origin)
{
  current_ = {};
  current_.session = session_;
  current_.reference = pose;
  current_.travel = travel_;
  surfaces_->clear();
  current_.range = medianRange(registered, pose.T_world_body.p - origin);
  length_ = rule_.length > 0.0 ? rule_.length
                               : std::clamp(kLengthOverRange * current_.range, kShortest, kLongest);
}

std::optional<Submap> SubmapBuilder::add(
    const ScanResult& result, const WorldPoints& registered, const Vec3& origin)
{
  gravity_.addScan(result);
  if (!hasPose(result.status)) return std::nullopt;
  const TrackedPose pose = mappingPoseOf(result);
  if (last_.stamp_ns != 0) travel_ += (pose.T_world_body.p - last_.T_world_body.p).norm();
  last_ = pose;
  std::optional<Submap> ended;
  const Pose& reference = current_.reference.T_world_body;
  const bool is_full = travel_ - current_.travel >= length_ ||
                       logSO3(reference.R.transpose() * pose.T_world_body.R).norm() >= rule_.turn;
  const bool may_end = current_.scans >= rule_.least_scans;
  if (current_.scans > 0 && may_end && is_full) ended = finish();
  if (current_.scans == 0)
  {
    begin(pose, registered, origin);
    current_.pose_by_calibration = result.pose_by_calibration;
  }
  moved(registered, origin, current_.reference.T_world_body.inverse(), local_);
  if (local_.size() > 0)
    surfaces_->insert(local_, current_.reference.T_world_body.inverse() * pose.T_world_body.p);
  current_.last_ns = pose.stamp_ns;
  current_.calibration_moment = result.calibration_moment;
  addToReference(pose);
  return ended;
}

/** The mean of covariances is that of the mean of errors that all scans share, and a bound for
 * others. */
void SubmapBuilder::addToReference(const TrackedPose& pose)
{
  Matrix6& mean = current_.reference_covariance;
  if (current_.scans > 0)
    mean += (referenceCovariance(current_.reference, pose) - mean) /
            static_cast<double>(current_.scans);
  ++current_.scans;
}

std::optional<Submap> SubmapBuilder::finish()
{
  if (current_.scans == 0) return std::nullopt;
  Submap ended = std::move(current_);
  ended.gravity = gravity_.take();
  SubmapSurfaces surfaces;
  surfaces.planes = surfaces_->bestPlanes(surfaces.spreads);
  ended.surfaces = StoredSurfaces(store_, std::move(surfaces));
  current_ = {};
  return ended;
}

}  // namespace fastlio
