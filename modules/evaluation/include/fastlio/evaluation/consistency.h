// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file consistency.h Is the covariance right? Normalised estimation error squared
 * (NEES).
 *
 * Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to Tracking and Navigation", 2001,
 * section 5.4: e^T P^-1 e of a consistent filter is chi-square distributed with dim(e) degrees of
 * freedom.
 */
#pragma once

#include <fastlio/evaluation/association.h>

#include <optional>

namespace fastlio
{
/** e^T P^-1 e of one pose; dof 6 (pose) and of its blocks, dof 3 each. */
struct NeesSample
{
  std::int64_t stamp_ns = 0;
  double pose = 0.0;
  double position = 0.0;
  double rotation = 0.0;
};

/** NEES of many samples against the chi-square distribution. */
struct NeesSummary
{
  std::size_t count = 0;
  int degrees = 0;  //!< of freedom of one sample: the expected mean
  double mean = 0.0;
  double mean_lower = 0.0;  //!< 95 % bounds of the mean of count independent samples
  double mean_upper = 0.0;
  double sample_bound = 0.0;  //!< 95 % of the samples of a consistent filter lie below
  double coverage = 0.0;      //!< fraction of the samples that do

  [[nodiscard]] bool meanInside() const { return mean >= mean_lower && mean <= mean_upper; }
};

/** \param nees at least one sample, may be pooled over several runs \param degrees of freedom of
 * each \exception std::invalid_argument no sample or degrees below 1 */
[[nodiscard]] NeesSummary summarizeNees(const std::vector<double>& nees, int degrees);

/** How the truth is expressed in the estimate's world frame, in which the covariance is given. */
enum class NeesAlignment
{
  First,  //!< first poses coincide: the filter's error is relative to its start, which it knows
  None    //!< both share the world frame
};

/** Truth minus estimate of one pose, and what the covariance says of it. Both: rotation [rad] in
 * the body frame, position [m] in the estimate's world frame. */
struct Deviation
{
  std::int64_t stamp_ns = 0;
  Vector6 error = Vector6::Zero();
  /** Standard deviations; negative without a covariance. */
  Vector6 sigma = Vector6::Constant(-1.0);
};

/** Of every pose. */
[[nodiscard]] std::vector<Deviation> deviations(
    const AssociatedTrajectories& trajectories, NeesAlignment alignment);

/** NEES over a trajectory. */
struct Consistency
{
  std::vector<NeesSample> samples;
  NeesSummary pose, position, rotation;
  std::size_t singular = 0;  //!< poses left out: their covariance is not positive definite
};

/** NEES of every pose. The error is e = (Log(R_mean^T R_true), p_true - p_mean), the truth
 * expressed in the estimate's world. With NeesAlignment::First the first pose is left out (its
 * error is zero by construction). \return nothing without covariances, or when none of them is
 * usable */
[[nodiscard]] std::optional<Consistency> consistency(
    const AssociatedTrajectories& trajectories, NeesAlignment alignment);

}  // namespace fastlio
