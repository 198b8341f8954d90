// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file common_elevation.h All elevations of a LiDAR are off by the same angle: what it does to the
 * rest of a calibration.
 *
 * Such beams move every point up by that angle times its range. As far as the walls are equally far
 * away, a LiDAR that sits higher does the same, and no data distinguish the two. So the priors
 * share out what the data show, and both stay uncertain. */
#pragma once

#include <Eigen/Core>

namespace fastlio
{
/** One standard deviation of the common elevation. */
struct CommonElevation
{
  Eigen::VectorXd direction;  //!< of all unknowns: what it is; zero where too few beams are known
  Eigen::VectorXd response;   //!< how the best values of the other unknowns change with it
};

/** An error of theta that its prior finds unlikely may be one of the common elevation: which it is,
 * the priors decide.
 * \param prior_std of theta, the first unknowns; zero where it is known
 * \param x the best values while the common elevation is zero; gets its share
 * \param covariance of \a x; gets what is not known of it
 * \return one standard deviation of what is not known of it */
Eigen::VectorXd shareOut(
    const CommonElevation& common, const Eigen::VectorXd& prior_std, Eigen::VectorXd& x,
    Eigen::MatrixXd& covariance);

}  // namespace fastlio
