// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file measurement_problems.h Measurements for the tests of the update: random ones, and planes
 * seen from a known pose. */
#pragma once

#include "random_problems.h"
#include <fastlio/filter/update.h>

#include <utility>
#include <vector>

namespace fastlio::testing
{
/** Rows of H, residuals and unequal variances around sigma^2, without any geometry behind them. */
inline StackedMeasurements randomMeasurements(Random& random, int count, double sigma)
{
  StackedMeasurements m;
  for (int i = 0; i < count; ++i)
  {
    Vector6 h;
    h << random.vector(5.0), random.axis();
    m.h.push_back(h);
    m.z.push_back(0.1 * random.normal());
    m.variance.push_back(sigma * sigma * random.uniform(0.25, 4.0));
  }
  return m;
}

/** The sums of eq. 20. */
inline InformationSums sumsOf(const StackedMeasurements& m)
{
  InformationSums s;
  for (std::size_t i = 0; i < m.h.size(); ++i)
  {
    s.HtRinvH += m.h[i] * m.h[i].transpose() / m.variance[i];
    s.HtRinvz += m.h[i] * (m.z[i] / m.variance[i]);
    s.weighted_squares += m.z[i] * m.z[i] / m.variance[i];
    s.squares += m.z[i] * m.z[i];
  }
  s.count = m.h.size();
  return s;
}

/** A point seen in the body frame that lies on a known plane of the world. */
struct PlaneMatch
{
  Vec3 p_body;
  Vec3 u;  //!< unit normal
  Vec3 q;  //!< point of the plane
};

/** Points within some metres of a body at \a truth, each on a plane with one of the normals. */
inline std::vector<PlaneMatch> planesSeenFrom(
    Random& random, const Pose& truth, int count, double noise,
    const std::vector<Vec3>& normals = {})
{
  std::vector<PlaneMatch> matches;
  for (int i = 0; i < count; ++i)
  {
    const Vec3 p_body = random.vector(6.0);
    const Vec3 u =
        normals.empty() ? random.axis() : normals[static_cast<std::size_t>(i) % normals.size()];
    matches.push_back({p_body, u, truth * p_body + noise * random.normal() * u});
  }
  return matches;
}

/** Eq. 12-14 for planes: z = u^T (p_G - q), H = u^T [-R [p_I]x, I]. */
inline StackedMeasurements residualsOf(
    const std::vector<PlaneMatch>& matches, const NavState& iterate, double sigma)
{
  StackedMeasurements m;
  for (const PlaneMatch& match : matches)
  {
    Vector6 h;
    h << (-iterate.R * skew(match.p_body)).transpose() * match.u, match.u;
    m.h.push_back(h);
    m.z.push_back(match.u.dot(iterate.pose() * match.p_body - match.q));
    m.variance.push_back(sigma * sigma);
  }
  return m;
}

/** The measurement model of fixed matches. */
inline MeasurementModel planeModel(std::vector<PlaneMatch> matches, double sigma)
{
  return [matches = std::move(matches), sigma](const NavState& iterate, int)
  {
    StackedMeasurements m = residualsOf(matches, iterate, sigma);
    MeasurementEvaluation e;
    e.sums = sumsOf(m);
    e.stacked = std::move(m);
    return e;
  };
}

constexpr double kSigma = 0.01;  //!< standard deviation of the plane residuals [m]

/** A prior whose pose is off by about sigma (m and rad) from a true state. */
struct Problem
{
  NavState truth;
  FilterState prior;
};

inline Problem problemOff(Random& random, double sigma)
{
  Problem p;
  p.truth = random.state();
  StateVector dx = StateVector::Zero();
  dx.head<6>() = sigma * random.stateVector(1.0).head<6>();
  p.prior.x = boxplus(p.truth, dx);
  p.prior.P = random.covariance(sigma, 4.0);
  return p;
}

inline IterationLimits tightLimits(int max_iterations = 30)
{
  return {max_iterations, 1e-10, 1e-10, 1e-10, 1e-10, 1e-10, 1e-10};
}
}  // namespace fastlio::testing
