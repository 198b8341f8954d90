// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file registration.h The pose of one submap in another from their planes, with evidence. */
#pragma once

#include <fastlio/map/plane_voxel.h>
#include <fastlio/parallel/workers.h>
#include <fastlio/run/pose_track.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace fastlio
{
class PlaneAligner;

/** What speaks for a registration. */
struct RegistrationEvidence
{
  std::size_t planes = 0;      //!< of the source
  double overlap = 0.0;        //!< fraction of them beside a plane of the target with its direction
  double inlier_ratio = 0.0;   //!< fraction of those that agree with the target's
  double residual_rms = 0.0;   //!< of the inliers, across the planes [m]
  double score = 0.0;          //!< fraction of the source's planes that agree
  double upright_score = 0.0;  //!< likewise of upright planes: floors and ceilings fit anywhere
  /** How many of the planes that agree lie across a direction of the position, the least first:
   * eigenvalues of the sum of n n^T over their normals. */
  Vec3 planes_across = Vec3::Zero();
  std::size_t starts = 0;  //!< places and headings that were tried
  double cost = 0.0;       //!< minus the logarithm of the likelihood of all planes
  /** How much likelier the pose is than any other place that was found (natural logarithm);
   * infinite: there was none. */
  double margin = 0.0;
  Vec3 rival = Vec3::Zero();  //!< that place, from the pose [m]
  /** The same without places that lie along the least known direction of the position: a closure
   * that leaves this direction open does not have to tell them apart. */
  double margin_across = 0.0;
  Vector6 information_eigenvalues = Vector6::Zero();  //!< ascending
};

/** T_target_source, and how well it is known. */
struct Registration
{
  RelativePose motion;  //!< covariance: attitude in the source's frame, position in the target's
  RegistrationEvidence evidence;
  bool converged = false;
};

/** Planes of two submaps that lie beside each other and have the same normal. */
struct PlanePair
{
  std::size_t source = 0;  //!< its number
  VoxelPlane target;       //!< in the frame of the target
  Vec3 at = Vec3::Zero();  //!< centroid of the source's plane, in the frame of the target
};

/** Registers submaps with one target. Pairs of planes that point alike and lie beside each other
 * are aligned plane to plane, from a wide to a narrow search (point-to-plane distance of the source
 * planes' centroids; robust weights by Geman and McClure, graduated). */
class SubmapRegistration
{
 public:
  /** \param target its planes are copied
   * \param workers who share the starts; the result does not depend on them */
  explicit SubmapRegistration(
      const std::vector<VoxelPlane>& target,
      std::shared_ptr<const Workers> workers = std::make_shared<const Workers>(1));
  ~SubmapRegistration();
  SubmapRegistration(const SubmapRegistration&) = delete;
  SubmapRegistration& operator=(const SubmapRegistration&) = delete;

  /** Tries starts all over the places that the prediction allows, to 3 standard deviations, 3000
   * at most: the likeliest.
   * \param predicted T_target_source and its covariance: it also gives the likelihood of a place
   * \param up the direction against gravity in the target's frame: headings turn about it */
  [[nodiscard]] Registration search(
      const std::vector<VoxelPlane>& source, const RelativePose& predicted, const Vec3& up) const;

  /** Aligns again what search() has found, for a closure that leaves a direction open: along it,
   * the source is where the prediction has it. What the search says about rivals stays. It has not
   * converged where too few planes lie beside each other.
   * \param along of unit length, in the target's frame */
  [[nodiscard]] Registration alignedAcross(
      const Vec3& along, const std::vector<VoxelPlane>& source, const Registration& found,
      const RelativePose& predicted, const Vec3& up) const;

  /** What lies beside each other at a pose. */
  [[nodiscard]] std::vector<PlanePair> pairs(
      const std::vector<VoxelPlane>& source, const Pose& T_target_source) const;

  /** Median distance of the source's planes from those of the target beside them, across the
   * surface; 0 without any [m]. */
  [[nodiscard]] double medianDistance(
      const std::vector<VoxelPlane>& source, const Pose& T_target_source) const;

 private:
  std::unique_ptr<const PlaneAligner> aligner_;
};

}  // namespace fastlio
