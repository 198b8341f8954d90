// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file conditioned_samples.h Samples of a platform that tilts, and what the conditioner makes of
 * them. */
#pragma once

#include <fastlio/imu/imu_conditioner.h>
#include <fastlio/math/time.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace fastlio::testing
{
constexpr std::int64_t kStart = 1'700'000'000'000'000'000;
constexpr std::int64_t kPeriod = 5'000'000;
constexpr double kDown = 9.81;

/** A platform that tilts to and fro by 30 deg, with a known rate. */
inline std::vector<ImuSample> tilting(int count)
{
  std::vector<ImuSample> samples;
  for (int i = 0; i < count; ++i)
  {
    const double t = toSeconds(i * kPeriod);
    const double angle = 0.5 * std::sin(2.0 * t), rate = std::cos(2.0 * t);
    samples.push_back(
        {kStart + i * kPeriod, Vec3(rate, 0.001, -0.002),
         kDown * Vec3(0.0, std::sin(angle), std::cos(angle))});
  }
  return samples;
}

struct Conditioned
{
  std::vector<ConditionedSample> samples;
  ImuReport report;
  std::string diagnostics;
};

inline Conditioned conditioned(const std::vector<ImuSample>& raw, const ImuOptions& p = {})
{
  ImuConditioner conditioner(p, kDown);
  Conditioned result;
  const auto append = [&](const std::vector<ConditionedSample>& ready)
  { result.samples.insert(result.samples.end(), ready.begin(), ready.end()); };
  for (const ImuSample& sample : raw)
    append(conditioner.add(sample));
  append(conditioner.finish());
  result.report = conditioner.report();
  for (const Diagnostic& diagnostic : conditioner.takeDiagnostics())
    result.diagnostics += diagnostic.text + "\n";
  return result;
}

}  // namespace fastlio::testing
