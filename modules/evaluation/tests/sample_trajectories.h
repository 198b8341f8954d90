// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sample_trajectories.h Trajectories and files for the tests. */
#pragma once

#include "temporary_folder.h"
#include <fastlio/evaluation/trajectory.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>

namespace fastlio::testing
{
constexpr std::int64_t kStart = 1'700'000'000'000'000'000;
constexpr std::int64_t kTenHz = 100'000'000;

/** A curve in space with varying attitude, no symmetry. */
inline Trajectory curve(std::size_t poses = 200, std::int64_t step_ns = kTenHz)
{
  Trajectory t;
  t.source = "curve";
  for (std::size_t i = 0; i < poses; ++i)
  {
    const std::int64_t offset_ns = static_cast<std::int64_t>(i) * step_ns;
    const double s = toSeconds(offset_ns);
    const Vec3 p(3.0 * std::sin(0.7 * s), 2.0 * s, 0.8 * std::cos(1.1 * s));
    t.poses.push_back({kStart + offset_ns, {expSO3({0.2 * std::sin(s), 0.1 * s, 0.3 * s}), p}});
  }
  return t;
}

/** Along x at 1 m per pose, level. */
inline Trajectory line(std::size_t poses = 101, std::int64_t step_ns = kTenHz)
{
  Trajectory t;
  t.source = "line";
  for (std::size_t i = 0; i < poses; ++i)
    t.poses.push_back(
        {kStart + static_cast<std::int64_t>(i) * step_ns,
         {Mat3::Identity(), Vec3(static_cast<double>(i), 0.0, 0.0)}});
  return t;
}

/** The same motion seen from another world frame: T_new_old from the left. */
inline Trajectory moved(const Pose& T_new_old, Trajectory t)
{
  for (StampedPose& pose : t.poses)
    pose.T_world_body = T_new_old * pose.T_world_body;
  return t;
}

/** Position error added in the world frame. */
inline Trajectory shifted(Trajectory t, const Vec3& offset)
{
  for (StampedPose& pose : t.poses)
    pose.T_world_body.p += offset;
  return t;
}

inline Vec3 gaussian(std::mt19937& random, double sigma = 1.0)
{
  std::normal_distribution<double> normal(0.0, sigma);
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

inline Pose randomPose(std::mt19937& random)
{
  return {expSO3(gaussian(random)), gaussian(random, 20.0)};
}

/** Expects that f() throws E with every one of the parts in its message. */
template <typename E, typename F>
void expectThrows(F f, std::initializer_list<const char*> parts)
{
  try
  {
    f();
    ADD_FAILURE() << "nothing was thrown";
  }
  catch (const E& e)
  {
    for (const char* part : parts)
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos)
          << "'" << part << "' is missing in: " << e.what();
  }
}

}  // namespace fastlio::testing
