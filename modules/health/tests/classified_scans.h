// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file classified_scans.h Scans and outcomes to be classified. */
#pragma once

#include <fastlio/health/classify.h>

#include <vector>

namespace fastlio::testing
{
constexpr std::int64_t kStamp = 1'700'000'000'000'000'000;
constexpr std::int64_t kScan = 100'000'000;

/** A scan as it should be. */
inline ScanResult goodScan(std::int64_t index = 1)
{
  ScanResult r;
  r.begin_ns = kStamp + (index - 1) * kScan;
  r.stamp_ns = kStamp + index * kScan;
  r.status = ScanStatus::Tracking;
  r.statistics.points_downsampled = 1000;
  r.statistics.points_effective = 600;
  r.statistics.usual_inlier_ratio = 0.5;
  r.statistics.normalized_innovation = 0.9;
  r.statistics.information_eigenvalues.setConstant(1e5);
  return r;
}

template <typename Change>
ScanHealth healthAfter(Change change, double inflated_ratio = 0.0)
{
  ScanResult r = goodScan();
  change(r);
  HealthContext context;
  context.since_ns = r.begin_ns;
  context.inflated_ratio = inflated_ratio;
  return healthOf(r, context);
}

/** The outcome of a scan that tracks. */
inline ScanOutcome goodOutcome()
{
  ScanOutcome outcome;
  outcome.updated = true;
  outcome.points = 1000;
  outcome.unaided_s = 0.0;
  outcome.position_std = 0.01;
  return outcome;
}

inline ScanResult classified(
    const ScanOutcome& outcome, ScanResult r = goodScan(),
    const std::vector<NoiseInflation>& inflations = {})
{
  ScanClassifier classifier{OdometryOptions{}};
  classifier.classify(outcome, inflations, r);
  return r;
}

}  // namespace fastlio::testing
