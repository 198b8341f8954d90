// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file innovation_watch.h Do scans and inertial data go on agreeing as well as they did? */
#pragma once

#include <array>

namespace fastlio
{
/** Watches how large the innovations of scans are, as mean squares over their covariance. */
class InnovationWatch
{
 public:
  /** Takes the next scan. \param square mean over the elements of its innovation; about 1 when the
   * noise is what the filter takes it for \param residuals mean z^2/r of its points at the end.
   * Where scans do not fit the map, among trees, they are less certain of their poses, and
   * contradict the inertial data without a step of theirs
   * \param beyond_map the square, less where the map's own errors explain it: a place that is seen
   * again after a while lies elsewhere than the prediction, which has drifted */
  void add(double square, double residuals, double beyond_map);
  void add(double square, double residuals) { add(square, residuals, square); }

  /** The scan had a degenerate direction. When the next ones show that direction again, they
   * contradict a prediction that drifted along it: that is no step of the inertial sensor. */
  void interrupt();

  /** What the worst seconds so far make of the covariance, as a factor: what the poses lost in them
   * stays. 1 when no time stands out. */
  [[nodiscard]] double worst() const { return worst_; }

  /** The last scans contradict their predictions so much that the inertial sensor cannot be what it
   * was. \return true once for the scans that show it */
  [[nodiscard]] bool takeStep();

  /** How many times its covariance the square of the next innovation will be: as many as those of
   * the last two scans, where both stand out. Else 1. */
  [[nodiscard]] double expected() const;

  /** The scan did not match, so it says nothing about the next one. */
  void addUnmatched() { squares_ = {}; }

 private:
  int scans_ = 0;
  double recent_ = 0.0, worst_ = 1.0;
  double residuals_ = 0.0;              // of the recent scans
  std::array<double, 3> beyond_map_{};  // the latest first
  std::array<double, 2> squares_{};     // the same, with what the map explains
  int pause_ = 0;                       // so many scans to come show no step
};

}  // namespace fastlio
