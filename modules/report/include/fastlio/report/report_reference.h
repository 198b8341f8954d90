// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file report_reference.h A run against its reference trajectory (internal). */
#pragma once

#include <fastlio/evaluation/evaluate.h>
#include <fastlio/run/pose_output.h>

#include <optional>
#include <string>

namespace fastlio
{
/** The comparison of a run with a reference. */
struct ReferenceFindings
{
  std::string file;     //!< empty: there is no reference
  std::string body;     //!< whose poses are compared
  std::string problem;  //!< why it could not be used, or empty
  std::optional<EvaluationReport> report;
  std::size_t poses_per_sample = 1;  //!< of a long run, only each n-th pose is compared, n is this
};

/** Poses of a run with their covariances, in bounded memory: of a long run only some. */
class ReferenceComparison
{
 public:
  static constexpr std::size_t kMaxPoses = 20'000;
  static constexpr std::uintmax_t kLargestFile = 200'000'000;  //!< [byte]

  /** \param file the reference (any format of fastlio-eval); empty: nothing is collected */
  ReferenceComparison(std::string file, OutputFrame frame);

  void add(const ScanResult& result);

  /** Whatever the reference is, nothing is thrown: the findings hold the problem. */
  [[nodiscard]] ReferenceFindings findings() const;

 private:
  std::string file_;
  OutputFrame frame_;
  Trajectory poses_;
  std::size_t poses_per_sample_ = 1, seen_ = 0;
};

}  // namespace fastlio
