// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "weighted_yaw_fit.h"

#include <cmath>

namespace fastlio
{
namespace
{
struct Centres
{
  Vec3 map = Vec3::Zero(), enu = Vec3::Zero();
  double information = 0;
};

Centres centresOf(const std::vector<Correspondence>& points, const std::vector<double>& information)
{
  Centres centres;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    centres.map += information[i] * points[i].map;
    centres.enu += information[i] * points[i].enu;
    centres.information += information[i];
  }
  centres.map /= centres.information;
  centres.enu /= centres.information;
  return centres;
}
}  // namespace

Pose weightedYawFit(
    const std::vector<Correspondence>& points, const std::vector<double>& information)
{
  const Centres centres = centresOf(points, information);
  double along = 0, across = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 a = points[i].map - centres.map, b = points[i].enu - centres.enu;
    along += information[i] * (a.x() * b.x() + a.y() * b.y());
    across += information[i] * (a.x() * b.y() - a.y() * b.x());
  }
  const double yaw = std::atan2(across, along);
  Pose pose;
  pose.R << std::cos(yaw), -std::sin(yaw), 0, std::sin(yaw), std::cos(yaw), 0, 0, 0, 1;
  pose.p = centres.enu - pose.R * centres.map;
  return pose;
}

YawObservability yawObservability(
    const std::vector<Correspondence>& points, const std::vector<double>& information)
{
  const Centres centres = centresOf(points, information);
  double about_centre = 0;  // information on yaw, with the position of the centre free [1/rad^2]
  for (std::size_t i = 0; i < points.size(); ++i)
    about_centre += information[i] * (points[i].map - centres.map).head<2>().squaredNorm();
  return {1.0 / std::sqrt(about_centre), std::sqrt(about_centre / centres.information)};
}

}  // namespace fastlio
