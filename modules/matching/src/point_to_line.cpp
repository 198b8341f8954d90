// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/matching/point_to_line.h>

#include <Eigen/Geometry>

#include <algorithm>

namespace fastlio
{
namespace
{
using LineRows = std::array<PlaneMeasurement, 2>;

bool areConsistent(const LineRows& rows, const ResidualModel& model)
{
  return std::all_of(
      rows.begin(), rows.end(), [&](const PlaneMeasurement& m) { return isConsistent(m, model); });
}
}  // namespace

LineRows lineMeasurements(
    const Pose& T_world_imu, const BodyPoints& body, std::size_t i, const LineMatch& line)
{
  const Vec3 p_imu(body.x[i], body.y[i], body.z[i]);
  const Vec3 u = Vec3(line.ux, line.uy, line.uz).normalized();
  const Vec3 from_line = T_world_imu * p_imu - Vec3(line.qx, line.qy, line.qz);
  const Vec3 first = u.unitOrthogonal();
  LineRows rows;
  for (const bool second : {false, true})
  {
    const Vec3 e = second ? Vec3(u.cross(first)) : first;
    const Vec3 e_imu = T_world_imu.R.transpose() * e;
    PlaneMeasurement& row = rows[second ? 1 : 0];
    row.h << p_imu.cross(e_imu), e;
    row.z = e.dot(from_line);
    row.variance = line.variance;
  }
  return rows;
}

InformationSums accumulateLines(
    const Pose& T_world_imu, const BodyPoints& body, const std::vector<LineMatch>& matches,
    const ResidualModel& model, std::size_t first, std::size_t last)
{
  InformationSums sums;
  for (std::size_t i = first; i < last; ++i)
  {
    if (!matches[i].valid()) continue;
    const LineRows rows = lineMeasurements(T_world_imu, body, i, matches[i]);
    if (!areConsistent(rows, model)) continue;
    for (const PlaneMeasurement& row : rows)
    {
      const double weight = model.weight / row.variance;
      sums.HtRinvH += weight * row.h * row.h.transpose();
      sums.HtRinvz += weight * row.z * row.h;
      sums.weighted_squares += weight * row.z * row.z;
      sums.squares += row.z * row.z;
      ++sums.count;
    }
  }
  return sums;
}

void stackLines(
    const Pose& T_world_imu, const BodyPoints& body, const std::vector<LineMatch>& matches,
    const ResidualModel& model, StackedMeasurements& stacked)
{
  for (std::size_t i = 0; i < body.size(); ++i)
  {
    if (!matches[i].valid()) continue;
    const LineRows rows = lineMeasurements(T_world_imu, body, i, matches[i]);
    if (!areConsistent(rows, model)) continue;
    for (const PlaneMeasurement& row : rows)
    {
      stacked.h.push_back(row.h);
      stacked.z.push_back(row.z);
      stacked.variance.push_back(row.variance / model.weight);
    }
  }
}

}  // namespace fastlio
