// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/odometry/point_to_plane.h>

#include <Eigen/Geometry>

#include <cmath>

namespace fastlio
{
void transformToWorld(
    const BodyPoints& body, const Pose& T_world_imu, std::size_t first, std::size_t last,
    WorldPoints& world)
{
  const Mat3& R = T_world_imu.R;
  const Vec3& t = T_world_imu.p;
  for (std::size_t i = first; i < last; ++i)
  {
    const double x = body.x[i], y = body.y[i], z = body.z[i];
    world.x[i] = static_cast<float>(R(0, 0) * x + R(0, 1) * y + R(0, 2) * z + t.x());
    world.y[i] = static_cast<float>(R(1, 0) * x + R(1, 1) * y + R(1, 2) * z + t.y());
    world.z[i] = static_cast<float>(R(2, 0) * x + R(2, 1) * y + R(2, 2) * z + t.z());
  }
}

PlaneMeasurement planeMeasurement(
    const Pose& T_world_imu, const BodyPoints& body, std::size_t i, const PlaneMatch& plane,
    const ResidualModel& model)
{
  const Vec3 p_imu(body.x[i], body.y[i], body.z[i]);
  const Vec3 beam(body.ux[i], body.uy[i], body.uz[i]);
  const Vec3 u(plane.nx, plane.ny, plane.nz);
  const Vec3 u_imu = T_world_imu.R.transpose() * u;
  PlaneMeasurement m;
  m.h << p_imu.cross(u_imu), u;
  m.z = u_imu.dot(p_imu) + u.dot(T_world_imu.p) + plane.d;
  const double cos_incidence = u_imu.dot(beam);
  m.variance = model.range_variance * cos_incidence * cos_incidence + plane.variance;
  return m;
}

bool isConsistent(const PlaneMeasurement& m, const ResidualModel& model)
{
  const double prior_variance =
      model.prior_position_variance + model.prior_attitude_variance * m.h.head<3>().squaredNorm();
  return m.z * m.z <= model.gate * model.gate * (m.variance + prior_variance);
}

double weightOf(const PlaneMeasurement& m, const ResidualModel& model)
{
  return robustWeight(model.kernel, m.z * m.z / m.variance, model.kernel_scale) / m.variance;
}

InformationSums accumulate(
    const Pose& T_world_imu, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const ResidualModel& model, std::size_t first, std::size_t last)
{
  InformationSums sums;
  // Upper triangle only, mirrored at the end.
  Eigen::Matrix<double, 6, 6> upper = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t i = first; i < last; ++i)
  {
    if (!matches[i].valid()) continue;
    const PlaneMeasurement m = planeMeasurement(T_world_imu, body, i, matches[i], model);
    if (!isConsistent(m, model)) continue;
    const double weight = weightOf(m, model);
    for (int c = 0; c < 6; ++c)
      upper.col(c).head(c + 1) += weight * m.h[c] * m.h.head(c + 1);
    sums.HtRinvz += weight * m.z * m.h;
    sums.weighted_squares += weight * m.z * m.z;
    sums.squares += m.z * m.z;
    ++sums.count;
  }
  sums.HtRinvH = upper.selfadjointView<Eigen::Upper>();
  return sums;
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
    stacked.variance.push_back(1.0 / weightOf(m, model));
  }
  return stacked;
}

}  // namespace fastlio
