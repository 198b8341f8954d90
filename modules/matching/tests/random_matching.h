// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file random_matching.h A scan of random points and a plane for most of them. */
#pragma once

#include "random_numbers.h"
#include <fastlio/matching/measured_scan.h>
#include <fastlio/matching/point_to_plane.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace fastlio
{
/** A scan at a pose and a plane for each of its points. */
struct Matching
{
  NavState x;
  BodyPoints body;
  std::vector<PlaneMatch> matches;
};

inline PlaneMatch planeThrough(const Vec3& point, const Vec3& normal, double variance)
{
  PlaneMatch plane;
  plane.nx = float(normal.x());
  plane.ny = float(normal.y());
  plane.nz = float(normal.z());
  plane.d = float(-normal.dot(point));
  plane.variance = float(variance);
  return plane;
}

/** No residual is too large. */
inline ResidualModel wideOpen()
{
  ResidualModel model;
  model.gate = 1e6;
  return model;
}

inline Matching randomMatching(unsigned seed, std::size_t n, double residual_sigma = 0.02)
{
  Random random(seed);
  Matching m;
  m.x.R = expSO3(random.vector());
  m.x.p = random.vector(20.0);
  m.body.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec3 p = random.vector(8.0), beam = (p - Vec3(0.1, 0.2, 0.3)).normalized();
    m.body.x[i] = float(p.x());
    m.body.y[i] = float(p.y());
    m.body.z[i] = float(p.z());
    m.body.ux[i] = float(beam.x());
    m.body.uy[i] = float(beam.y());
    m.body.uz[i] = float(beam.z());
    const Vec3 normal = random.vector().normalized();
    const Vec3 q = m.x.pose() * p + random.normal(residual_sigma) * normal;
    m.matches.push_back(planeThrough(q, normal, random.uniform(1e-5, 1e-3)));
    if (i % 7 == 3) m.matches.back().variance = -1.0F;  // no plane there
  }
  return m;
}

/** To within the order of summation. */
inline void expectEqual(const InformationSums& a, const InformationSums& b)
{
  EXPECT_EQ(a.count, b.count);
  EXPECT_LT((a.HtRinvH - b.HtRinvH).norm(), 1e-9 * b.HtRinvH.norm());
  EXPECT_LT((a.HtRinvz - b.HtRinvz).norm(), 1e-9 * b.HtRinvz.norm());
  EXPECT_NEAR(a.weighted_squares, b.weighted_squares, 1e-9 * b.weighted_squares);
  EXPECT_NEAR(a.squares, b.squares, 1e-9 * b.squares);
}

inline MeasuredScan measured(
    const Pose& T_world_scan, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const ResidualModel& model)
{
  MeasuredScan scan;
  scan.measure(Workers(1), T_world_scan, body, matches, model);
  return scan;
}

inline MeasuredScan measured(const Matching& m, const ResidualModel& model)
{
  return measured(m.x.pose(), m.body, m.matches, model);
}

}  // namespace fastlio
