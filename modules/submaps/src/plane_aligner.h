// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plane_aligner.h Planes of one submap against those of another (internal). */
#pragma once

#include "plane_tree.h"
#include <fastlio/math/linear_algebra.h>
#include <fastlio/submaps/registration.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace fastlio
{
// Of the eigenvectors and products of this file.
using Aligned6 = Eigen::Matrix<double, 6, 6>;
using AlignedVector6 = Eigen::Matrix<double, 6, 1>;

// Normals of one surface differ by less than this, seen twice [cosine of 25 deg].
inline constexpr double kLeastCosine = 0.906;
// Centroids of one surface lie within the width of the widest voxels of each other [m].
inline constexpr double kBeside = 1.2;
// Errors that all points on a surface share: range and elevation of the beams, incidence [m].
inline constexpr double kSurfaceBias = 0.015;
// Neighbouring planes share such errors: so many count as one.
inline constexpr double kPlanesPerMeasurement = 8.0;
// A registration is not better than the submaps' own shape.
inline constexpr double kPositionFloor = 0.005;    // [m]
inline constexpr double kAttitudeFloor = 0.0003;   // [rad]
inline constexpr double kLeastInformation = 1e-2;  // [1/m^2, 1/rad^2]
inline constexpr double kUprightCosine = 0.5;      // cosine between normal and gravity
inline constexpr double kInlier = 3.0;             // standard deviations

/** How wide to look for partners, and what counts as far from a plane. */
struct Stage
{
  double reach = 0.0;  //!< between centroids [m]
  double scale = 0.0;  //!< of the robust weight [m]
  int iterations = 0;
};

// From a wide to a narrow search.
inline constexpr std::array kWide = {Stage{2.5, 0.8, 4}};
inline constexpr std::array kCoarse = {Stage{1.6, 0.3, 5}};
inline constexpr std::array kFine = {
    Stage{1.6, 0.3, 5}, Stage{kBeside, 0.1, 6}, Stage{kBeside, 0.05, 8}};

struct Pair
{
  const Patch* source = nullptr;
  const Patch* target = nullptr;
  Vec3 at;                //!< source centroid in the target's frame
  double distance = 0.0;  //!< across the target's plane [m]
  double variance = 0.0;  //!< of the distance [m^2]
};

/** The normal equations of plane-to-plane pairs. */
struct Alignment
{
  Aligned6 information = Aligned6::Zero();
  AlignedVector6 gradient = AlignedVector6::Zero();
  std::size_t pairs = 0, inliers = 0;
  double squares = 0.0;     //!< of the inliers' distances [m^2]
  double normalized = 0.0;  //!< sum of the inliers' squared distances over their variance

  /** Minus the logarithm of the likelihood: truncated squares, of \a planes planes. */
  [[nodiscard]] double cost(std::size_t planes) const
  {
    const auto outliers = static_cast<double>(planes - inliers);
    return 0.5 * (normalized + kInlier * kInlier * outliers) / kPlanesPerMeasurement;
  }
};

[[nodiscard]] inline Aligned6 floorOf()
{
  AlignedVector6 diagonal;
  diagonal.head<3>().setConstant(kAttitudeFloor * kAttitudeFloor);
  diagonal.tail<3>().setConstant(kPositionFloor * kPositionFloor);
  return diagonal.asDiagonal();
}
/** Aligns planes with those of one submap. */
class PlaneAligner
{
 public:
  PlaneAligner(const std::vector<VoxelPlane>& target, std::shared_ptr<const Workers> workers)
      : cloud_{patchesOf(target)},
        workers_(std::move(workers)),
        tree_(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(10))
  {
    tree_.buildIndex();
  }

  [[nodiscard]] bool empty() const { return cloud_.patches.empty(); }
  [[nodiscard]] const Workers& workers() const { return *workers_; }

  /** The nearest plane with the same normal: the other side of a wall or of a ceiling is another
   * surface. */
  [[nodiscard]] std::optional<Pair> partnerOf(
      const Patch& source, const Pose& T, double reach) const
  {
    constexpr std::size_t kLookAt = 6;
    const Vec3 at = T * source.centroid;
    const Vec3 normal = T.R * source.normal;
    // Mostly the nearest one will do, and costs a fraction of the search for six.
    const auto nearest = nearestWithin<1>(tree_, at, reach);
    if (nearest.empty()) return std::nullopt;
    if (const auto pair = firstLike(nearest, source, at, normal)) return pair;
    return firstLike(nearestWithin<kLookAt>(tree_, at, reach), source, at, normal);
  }

  [[nodiscard]] Alignment align(
      const std::vector<Patch>& source, const Pose& T, const Stage& stage) const
  {
    Alignment sums;
    for (const Patch& patch : source)
    {
      const auto pair = partnerOf(patch, T, stage.reach);
      if (!pair) continue;
      add(*pair, T, stage.scale, sums);
    }
    return sums;
  }

  /** Moves the source along the stages, but not along a direction that is held (zero: none). */
  template <typename Stages>
  [[nodiscard]] std::optional<Pose> follow(
      const std::vector<Patch>& source, Pose T, const Stages& stages,
      const Vec3& held = Vec3::Zero()) const
  {
    for (const Stage& stage : stages)
      for (int i = 0; i < stage.iterations; ++i)
      {
        const Alignment sums = align(source, T, stage);
        if (sums.pairs < 20) return std::nullopt;
        const auto step = stepOf(sums, held);
        T.R = normalizeRotation(T.R * expSO3(step.head<3>()));
        T.p += step.tail<3>();
        if (step.lpNorm<Eigen::Infinity>() < 1e-5) break;
      }
    return T;
  }

  /** Fraction of the source's upright planes that agree with the target's. */
  [[nodiscard]] double uprightScore(
      const std::vector<Patch>& source, const Pose& T, const Vec3& up) const
  {
    std::vector<Patch> upright;
    const Vec3 up_in_source = T.R.transpose() * up;
    std::copy_if(
        source.begin(), source.end(), std::back_inserter(upright),
        [&](const Patch& patch)
        { return std::abs(patch.normal.dot(up_in_source)) < kUprightCosine; });
    if (upright.empty()) return 0.0;
    return static_cast<double>(align(upright, T, kFine.back()).inliers) /
           static_cast<double>(upright.size());
  }

  [[nodiscard]] double costOf(const std::vector<Patch>& source, const Pose& T) const
  {
    return align(source, T, kFine.back()).cost(source.size());
  }

  /** Information that only the noise of the normals adds: it is not known. */
  [[nodiscard]] Aligned6 noiseOf(const std::vector<Patch>& source, const Pose& T) const
  {
    Aligned6 noise = Aligned6::Zero();
    for (const Patch& patch : source)
    {
      const auto pair = partnerOf(patch, T, kFine.back().reach);
      if (!pair) continue;
      const Vec3& n = pair->target->normal;
      const double each = 0.5 * static_cast<double>(pair->target->plane.normalVariance());
      const Mat3 of_normal = each * (Mat3::Identity() - n * n.transpose());
      Eigen::Matrix<double, 6, 3> by_normal;
      by_normal << skew(pair->source->centroid) * T.R.transpose(), Mat3::Identity();
      noise.noalias() +=
          weightOf(*pair, kFine.back().scale) * by_normal * of_normal * by_normal.transpose();
    }
    return noise;
  }

  [[nodiscard]] Vec3 planesAcross(const std::vector<Patch>& source, const Pose& T) const
  {
    Mat3 sum = Mat3::Zero();
    for (const Patch& patch : source)
    {
      const auto pair = partnerOf(patch, T, kFine.back().reach);
      if (pair && isInlier(*pair)) sum += pair->target->normal * pair->target->normal.transpose();
    }
    return symmetricEigensystem(sum).values;
  }

  [[nodiscard]] Registration finish(const std::vector<Patch>& source, const Pose& T) const
  {
    const Alignment sums = align(source, T, kFine.back());
    Registration result;
    result.motion.T_a_b = T;
    RegistrationEvidence& evidence = result.evidence;
    evidence.planes = source.size();
    const auto count = static_cast<double>(std::max<std::size_t>(source.size(), 1));
    const auto pairs = static_cast<double>(std::max<std::size_t>(sums.pairs, 1));
    const auto inliers = static_cast<double>(std::max<std::size_t>(sums.inliers, 1));
    evidence.overlap = static_cast<double>(sums.pairs) / count;
    evidence.inlier_ratio = static_cast<double>(sums.inliers) / pairs;
    evidence.residual_rms = std::sqrt(sums.squares / inliers);
    evidence.cost = sums.cost(source.size());
    evidence.score = static_cast<double>(sums.inliers) / count;
    evidence.planes_across = planesAcross(source, T);
    // What the planes' own variances do not explain makes the result less certain.
    const double excess = std::max(1.0, sums.normalized / inliers);
    const Eigensystem6 system = symmetricEigensystem(
        Matrix6((sums.information - noiseOf(source, T)) / (kPlanesPerMeasurement * excess)));
    evidence.information_eigenvalues = system.values;
    // Directions that nothing constrains get a large covariance, not an infinite one.
    const Aligned6 V = system.vectors;
    const AlignedVector6 variances = system.values.cwiseMax(kLeastInformation).cwiseInverse();
    result.motion.covariance = V * variances.asDiagonal() * V.transpose() + floorOf();
    result.converged = true;
    return result;
  }

 private:
  template <typename Nearest>
  [[nodiscard]] std::optional<Pair> firstLike(
      const Nearest& nearest, const Patch& source, const Vec3& at, const Vec3& normal) const
  {
    for (std::size_t i = 0; i < nearest.size(); ++i)
    {
      const Patch& target = cloud_.patches[nearest[i]];
      if (target.normal.dot(normal) >= kLeastCosine) return pairOf(source, target, at);
    }
    return std::nullopt;
  }

  static Pair pairOf(const Patch& source, const Patch& target, const Vec3& at)
  {
    const Eigen::Vector3f p = at.cast<float>();
    const double own = static_cast<double>(source.plane.variance * source.plane.inverse_count);
    const double targets = static_cast<double>(target.plane.offsetVariance(p.x(), p.y(), p.z()));
    return {
        &source, &target, at, target.normal.dot(at - target.centroid),
        own + targets + kSurfaceBias * kSurfaceBias};
  }

  static bool isInlier(const Pair& pair)
  {
    return pair.distance * pair.distance < kInlier * kInlier * pair.variance;
  }

  /** By Geman and McClure. */
  static double weightOf(const Pair& pair, double scale)
  {
    const double scale2 = scale * scale;
    const double geman = scale2 / (scale2 + pair.distance * pair.distance);
    return geman * geman / pair.variance;
  }

  static void add(const Pair& pair, const Pose& T, double scale, Alignment& sums)
  {
    ++sums.pairs;
    const double squared = pair.distance * pair.distance;
    if (isInlier(pair))
    {
      ++sums.inliers;
      sums.squares += squared;
      sums.normalized += squared / pair.variance;
    }
    const double weight = weightOf(pair, scale);
    AlignedVector6 J;
    const Vec3& n = pair.target->normal;
    J << pair.source->centroid.cross(Vec3(T.R.transpose() * n)), n;
    sums.information.noalias() += weight * J * J.transpose();
    sums.gradient += weight * pair.distance * J;
  }

  static AlignedVector6 stepOf(const Alignment& sums, const Vec3& held)
  {
    // Keeps the guess where nothing constrains it, and, 10,000 times stiffer, where it is held.
    const double mean = sums.information.trace() / 6.0;
    Aligned6 H = sums.information + 1e-4 * mean * Aligned6::Identity();
    H.bottomRightCorner<3, 3>() += 1e4 * mean * held * held.transpose();
    return -H.ldlt().solve(sums.gradient);
  }

  CentroidCloud cloud_;
  std::shared_ptr<const Workers> workers_;
  PlaneTree tree_;
};

}  // namespace fastlio
