// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plane_voxel.h Incremental sums over the points of a voxel and the plane fitted to them. */
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace fastlio
{
/** The rule that makes a plane of a voxel's points. */
struct PlaneRules
{
  float point_noise = 0.02F;   //!< standard deviation of a point along its beam [m]
  float max_thickness = 0.1F;  //!< largest standard deviation across a plane [m]
  float min_incidence = 0.1F;  //!< least cosine between the normal and the mean beam
  float min_points = 6.0F;     //!< fewer points give no plane
};

/** Least cosine between a normal and a beam that tells the side of a plane: it is 3 degrees, as
 * normals are not exact, and beams begin where the sensor is at the scan's end. */
inline constexpr float kAlongThePlane = 0.05F;

/** A plane with what is needed to predict where a point of it lies: one cache line. */
struct VoxelPlane
{
  /** Unit normal n, world frame, on the side that the surface was seen from. */
  float nx = 0, ny = 0, nz = 0;
  float qx = 0, qy = 0, qz = 0;     //!< centroid q of the points [m]: n . (p - q) = 0
  float variance = -1;              //!< of a point across the plane [m^2]; negative: no plane
  float roughness = 0;              //!< part of it that the noise along the beams leaves over [m^2]
  float inverse_count = 0;          //!< 1 / number of points; those of repeated views count less
  std::array<float, 6> leverage{};  //!< (e1 e1^T/l1 + e2 e2^T/l2)/n: xx xy xz yy yz zz [1/m^2]
  std::uint32_t created_insertion = 0;  //!< scan in the middle of those that made the first plane

  [[nodiscard]] bool valid() const { return variance >= 0; }
  /** A beam of this direction (of any length) that meets this surface would come through it. What
   * it meets is another one: the other side of a wall or a door. Beams along the plane may come
   * from either side. */
  [[nodiscard]] bool isSeenFromBehind(const Eigen::Vector3f& beam) const
  {
    const float across = nx * beam.x() + ny * beam.y() + nz * beam.z();
    // Most planes face the beam: its length is seldom needed.
    return across > 0.0F && valid() &&
           across * across > kAlongThePlane * kAlongThePlane * beam.squaredNorm();
  }
  /** -n . q [m] */
  [[nodiscard]] float offset() const { return -(nx * qx + ny * qy + nz * qz); }

  [[nodiscard]] Eigen::Vector3d normal() const
  {
    return Eigen::Vector3f(nx, ny, nz).cast<double>();
  }
  [[nodiscard]] Eigen::Vector3d centroid() const
  {
    return Eigen::Vector3f(qx, qy, qz).cast<double>();
  }
  [[nodiscard]] Eigen::Matrix3d leverageMatrix() const
  {
    const auto& m = leverage;
    Eigen::Matrix3f matrix;
    matrix << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
    return matrix.cast<double>();
  }

  /** Variance of the normal, summed over its two free directions [rad^2]. */
  [[nodiscard]] float normalVariance() const
  {
    return variance * (leverage[0] + leverage[3] + leverage[5]);
  }

  /** Variance of the plane's offset at a point, as of a regression's prediction: of its mean, and
   * of its tilt with the distance from the centroid [m^2]. */
  [[nodiscard]] float offsetVariance(float x, float y, float z) const
  {
    const float dx = x - qx, dy = y - qy, dz = z - qz;
    const auto& m = leverage;
    const float distance = dx * (m[0] * dx + 2 * (m[1] * dy + m[2] * dz)) +
                           dy * (m[3] * dy + 2 * m[4] * dz) + dz * m[5] * dz;
    return variance * (inverse_count + distance);
  }
};

/** The sums of a voxel, relative to its centre so that single precision suffices. */
class PlaneVoxel
{
 public:
  /** \param offset point minus voxel centre [m] \param beam unit vector from the sensor
   * \param from_new_view the sensor has moved since the last view that was new */
  void add(const Eigen::Vector3f& offset, const Eigen::Vector3f& beam, bool from_new_view = true)
  {
    const float x = offset.x(), y = offset.y(), z = offset.z();
    count_ += 1;
    telling_count_ += from_new_view ? 1.0F : kRepeated;
    sum_ = {sum_[0] + x, sum_[1] + y, sum_[2] + z};
    beams_ = {beams_[0] + beam.x(), beams_[1] + beam.y(), beams_[2] + beam.z()};
    products_ = {products_[0] + x * x, products_[1] + x * y, products_[2] + x * z,
                 products_[3] + y * y, products_[4] + y * z, products_[5] + z * z};
  }

  /** True once after enough points have joined since the last fit to make another one worth it. */
  [[nodiscard]] bool claimRefit()
  {
    if (refit_pending_ || count_ < kRefitGrowth * fitted_count_ + 1.0F) return false;
    refit_pending_ = true;
    return true;
  }

  /** Fits the plane by the rules: smallest eigenvector of the scatter. A voxel that is too thick, a
   * line, or seen edge-on has none. */
  void fit(const Eigen::Vector3f& center, const PlaneRules& rules, std::uint32_t scan);

  [[nodiscard]] const VoxelPlane& plane() const { return plane_; }
  [[nodiscard]] float count() const { return count_; }
  /** Everything that it holds, in the order of its members, for archives. */
  struct Contents
  {
    VoxelPlane plane;
    float count = 0, telling_count = 0, fitted_count = 0;
    std::array<float, 3> sum{};
    std::array<float, 6> products{};
    std::array<float, 3> beams{};
  };
  [[nodiscard]] Contents contents() const;
  /** \exception std::invalid_argument a number is not finite, or a count negative */
  void setContents(const Contents& contents);

  /** Mean of the points minus the voxel's centre [m]. */
  [[nodiscard]] Eigen::Vector3f meanOffset() const;

 private:
  // A beam that is repeated averages its noise. It does not say what lies between the beams.
  static constexpr float kRepeated = 0.3F;
  // A plane is fitted anew when its points have grown by this factor.
  static constexpr float kRefitGrowth = 1.1F;

  VoxelPlane plane_;
  float count_ = 0;
  float telling_count_ = 0;  // the same, with points of repeated views for less
  float fitted_count_ = 0;
  std::array<float, 3> sum_{};
  std::array<float, 6> products_{};  //!< xx xy xz yy yz zz
  std::array<float, 3> beams_{};
  bool refit_pending_ = false;
};

}  // namespace fastlio
