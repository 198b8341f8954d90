// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_constraints.h How well a scan constrains each direction of its pose. */
#pragma once

#include <fastlio/filter/state.h>

namespace fastlio
{
/** The information of a scan by direction of its pose, all lengths: rotations are multiplied by the
 * lever arm that the scan's points have on average. Directions by growing information. */
struct ScanConstraints
{
  double lever_arm = 1.0;                       //!< of rotations [m]
  Matrix6 directions = Matrix6::Identity();     //!< columns: (rotation * lever_arm, translation)
  Vector6 information = Vector6::Zero();        //!< along each direction [1/m^2]
  Vector6 noise_information = Vector6::Zero();  //!< what noisy normals alone make of it [1/m^2]
  /** Information of the weak directions that is left without the few planes that say most about
   * them; of the others all of it [1/m^2]. */
  Vector6 supported_information = Vector6::Zero();
  /** Of the weak directions, what all planes but the many that say most say together; of the others
   * 0 [1/m^2]. */
  Vector6 common_information = Vector6::Zero();
  int unconstrained = 0;  //!< number of directions that are left alone, the weakest ones
  Matrix6 projection = Matrix6::Identity();  //!< of a scan pose step on the constrained ones
};

}  // namespace fastlio
