// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "measurement_lanes.h"
#include <fastlio/matching/point_to_plane.h>

namespace fastlio
{
void transformToWorld(
    const BodyPoints& body, const Pose& T_world_imu, std::size_t first, std::size_t last,
    WorldPoints& world)
{
  const Mat3 R = T_world_imu.R;
  const Vec3 t = T_world_imu.p;
  const float *bx = body.x.data(), *by = body.y.data(), *bz = body.z.data();
  const auto row = [&](int k, float* result)
  {
    const double rx = R(k, 0), ry = R(k, 1), rz = R(k, 2), shift = t[k];
    for (std::size_t i = first; i < last; ++i)
      result[i] = static_cast<float>(
          rx * static_cast<double>(bx[i]) + ry * static_cast<double>(by[i]) +
          rz * static_cast<double>(bz[i]) + shift);
  };
  row(0, world.x.data());
  row(1, world.y.data());
  row(2, world.z.data());
}

PlaneMeasurement planeMeasurement(
    const Pose& T_world_imu, const BodyPoints& body, std::size_t i, const PlaneMatch& plane,
    const ResidualModel& model)
{
  MatchLanes<1> match;
  load(match, 0, body, i, plane);
  const MeasurementLanes<1> one = measure(T_world_imu, match, model);
  PlaneMeasurement m;
  for (int k = 0; k < 6; ++k)
    m.h[k] = one.h[k][0];
  m.z = one.z[0];
  m.variance = one.variance[0];
  return m;
}

bool isConsistent(const PlaneMeasurement& m, const ResidualModel& model)
{
  const double h[6] = {m.h[0], m.h[1], m.h[2], m.h[3], m.h[4], m.h[5]};
  return withinGate(m.z, m.variance, h, model);
}

void addSums(InformationSums& a, const InformationSums& b)
{
  a.HtRinvH += b.HtRinvH;
  a.HtRinvz += b.HtRinvz;
  a.weighted_squares += b.weighted_squares;
  a.squares += b.squares;
  a.count += b.count;
}

StackedMeasurements stack(
    const Pose& T_world_imu, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const ResidualModel& model)
{
  StackedMeasurements stacked;
  for (std::size_t i = 0; i < body.size(); ++i)
  {
    if (!matches[i].valid()) continue;
    const PlaneMeasurement m = planeMeasurement(T_world_imu, body, i, matches[i], model);
    if (!isConsistent(m, model)) continue;
    stacked.h.push_back(m.h);
    stacked.z.push_back(m.z);
    stacked.variance.push_back(m.variance / model.weight);
  }
  return stacked;
}

}  // namespace fastlio
