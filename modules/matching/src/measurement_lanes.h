// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file measurement_lanes.h Eq. 12-14 for several points side by side: loops over the lanes are
 * what a compiler turns into vector instructions, and the order of every sum stays the same
 * whatever their width is. */
#pragma once

#include <fastlio/matching/measurement_block.h>
#include <fastlio/matching/point_to_plane.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** Points and the planes that they were matched with; one point per lane. */
template <std::size_t N>
struct MatchLanes
{
  std::size_t index[N];      //!< of the points in the scan
  double p[3][N];            //!< points, body frame [m]
  double beam[3][N];         //!< unit vectors along the beams, body frame
  double u[3][N];            //!< normals, world frame
  double d[N];               //!< planes' offsets [m]
  double plane_variance[N];  //!< [m^2]
};

template <std::size_t N>
void load(
    MatchLanes<N>& lanes, std::size_t lane, const BodyPoints& body, std::size_t i,
    const PlaneMatch& plane)
{
  lanes.index[lane] = i;
  lanes.p[0][lane] = body.x[i];
  lanes.p[1][lane] = body.y[i];
  lanes.p[2][lane] = body.z[i];
  lanes.beam[0][lane] = body.ux[i];
  lanes.beam[1][lane] = body.uy[i];
  lanes.beam[2][lane] = body.uz[i];
  lanes.u[0][lane] = plane.nx;
  lanes.u[1][lane] = plane.ny;
  lanes.u[2][lane] = plane.nz;
  lanes.d[lane] = plane.d;
  lanes.plane_variance[lane] = plane.variance;
}

/** Calls use(lanes, filled) with the matched ones of the points [first, last), N at a time and in
 * their order; lanes from \a filled on may hold anything that is in the scan. */
template <std::size_t N, typename Use>
void forMatches(
    const BodyPoints& body, const std::vector<PlaneMatch>& matches, std::size_t first,
    std::size_t last, const Use& use)
{
  MatchLanes<N> lanes = {};
  std::size_t filled = 0;
  for (std::size_t i = first; i < last; ++i)
  {
    if (!matches[i].valid()) continue;
    load(lanes, filled++, body, i, matches[i]);
    if (filled < N) continue;
    use(lanes, filled);
    filled = 0;
  }
  if (filled > 0) use(lanes, filled);
}

/** PlaneMeasurement, one per lane. */
template <std::size_t N>
struct MeasurementLanes
{
  double h[6][N];
  double z[N];
  double variance[N];
};

template <std::size_t N>
MeasurementLanes<N> measure(
    const Pose& T_world_imu, const MatchLanes<N>& match, const ResidualModel& model)
{
  const Mat3 R = T_world_imu.R;
  const Vec3 t = T_world_imu.p;
  MeasurementLanes<N> m;
  for (std::size_t l = 0; l < N; ++l)
  {
    const double x = match.p[0][l], y = match.p[1][l], z = match.p[2][l];
    const double ux = match.u[0][l], uy = match.u[1][l], uz = match.u[2][l];
    // R^T u: the normal in the body frame.
    const double bx = R(0, 0) * ux + R(1, 0) * uy + R(2, 0) * uz;
    const double by = R(0, 1) * ux + R(1, 1) * uy + R(2, 1) * uz;
    const double bz = R(0, 2) * ux + R(1, 2) * uy + R(2, 2) * uz;
    m.h[0][l] = y * bz - z * by;
    m.h[1][l] = z * bx - x * bz;
    m.h[2][l] = x * by - y * bx;
    m.h[3][l] = ux;
    m.h[4][l] = uy;
    m.h[5][l] = uz;
    m.z[l] = (bx * x + by * y + bz * z) + (ux * t.x() + uy * t.y() + uz * t.z()) + match.d[l];
    const double cosine = bx * match.beam[0][l] + by * match.beam[1][l] + bz * match.beam[2][l];
    const double lever = m.h[0][l] * m.h[0][l] + m.h[1][l] * m.h[1][l] + m.h[2][l] * m.h[2][l];
    m.variance[l] = model.range_variance * cosine * cosine + match.plane_variance[l] +
                    model.direction_variance * lever;
  }
  return m;
}

/** Measures the first \a filled lanes. Those that are not consistent with the model become zero in
 * every respect, as a NaN times a weight of zero would not. */
inline void measure(
    const Pose& T_world_scan, const MatchLanes<kLanes>& lanes, std::size_t filled,
    const ResidualModel& model, MeasurementBlock& block)
{
  const MeasurementLanes<kLanes> m = measure(T_world_scan, lanes, model);
  bool counts[kLanes];
  for (std::size_t l = 0; l < kLanes; ++l)
  {
    const double h[6] = {m.h[0][l], m.h[1][l], m.h[2][l], m.h[3][l], m.h[4][l], m.h[5][l]};
    counts[l] = l < filled && withinGate(m.z[l], m.variance[l], h, model);
    block.weight[l] = counts[l] ? model.weight / m.variance[l] : 0.0;
    block.z[l] = counts[l] ? m.z[l] : 0.0;
    block.index[l] = static_cast<std::uint32_t>(lanes.index[l]);
  }
  for (std::size_t k = 0; k < 6; ++k)
    for (std::size_t l = 0; l < kLanes; ++l)
      block.h[k][l] = counts[l] ? m.h[k][l] : 0.0;
}

}  // namespace fastlio
