// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file alignment.h The transformation between the world frames of estimate and reference. */
#pragma once

#include <fastlio/evaluation/association.h>

#include <optional>
#include <string>

namespace fastlio
{
/** The degrees of freedom between the two world frames. */
enum class Alignment
{
  None,   //!< nothing: both share the world frame
  First,  //!< rotation and translation, so that the first poses coincide
  Yaw,    //!< translation and rotation about z: both know which way is up
  Se3,    //!< translation and rotation
  Sim3    //!< translation, rotation and scale
};

/** "none", "first", "yaw", "se3", "sim3". */
[[nodiscard]] std::string toString(Alignment alignment);

/** p_reference = scale * R * p_estimate + p, with R and p in \a T_ref_est. */
struct Similarity
{
  double scale = 1.0;
  Pose T_ref_est;

  /** A pose of the estimate in the reference's world frame. */
  [[nodiscard]] Pose operator*(const Pose& T_est_body) const;
};

/** The transformation that minimises the sum of squared position errors (Umeyama 1991; Yaw: the
 * same with the rotation restricted to the z axis); First: by the first pose alone. \exception
 * std::invalid_argument the positions do not determine it (all on a line or in one point); the
 * message names an alignment that works */
[[nodiscard]] Similarity align(const AssociatedTrajectories& trajectories, Alignment alignment);

/** Positions beside a nearly straight path hardly show the turn about it. Then the alignment
 * follows their errors, and its turn is part of the APE of the rotation.
 * \param rmse of the aligned positions [m] \return how wrong that turn may be [rad];
 * nothing where it is known to a degree, or where the alignment does not come from positions */
[[nodiscard]] std::optional<double> uncertainTurn(
    const AssociatedTrajectories& trajectories, Alignment alignment, double rmse);

}  // namespace fastlio
