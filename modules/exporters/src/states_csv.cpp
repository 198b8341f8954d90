// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/number_text.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr const char* kStatesHeader =
    "# State of the IMU body at each scan's end, from the LiDAR-inertial odometry.\n"
    "# Units: ns since the UNIX epoch, m, m/s, rad/s, m/s^2; sigma_rot in rad.\n"
    "# Position, velocity and gravity in the world frame; biases in the IMU frame. sigma_*: "
    "standard\n"
    "# deviation of the error state; attitude error in the IMU frame (R_true = R Exp(error)).\n"
    "stamp_ns,x,y,z,qx,qy,qz,qw,vx,vy,vz,bgx,bgy,bgz,bax,bay,baz,gx,gy,gz,"
    "sigma_rot_x,sigma_rot_y,sigma_rot_z,sigma_pos_x,sigma_pos_y,sigma_pos_z,"
    "sigma_vel_x,sigma_vel_y,sigma_vel_z,sigma_bg_x,sigma_bg_y,sigma_bg_z,"
    "sigma_ba_x,sigma_ba_y,sigma_ba_z,sigma_g_x,sigma_g_y,sigma_g_z\n";

std::string stateRow(const ScanResult& result)
{
  if (!hasPose(result.status)) return {};
  const NavState& x = result.filter.x;
  std::string row = std::to_string(result.stamp_ns) + "," + poseColumns(x.pose(), ',');
  for (const Vec3& v : {x.v, x.gyro_bias, x.accel_bias, x.g})
    for (int i = 0; i < 3; ++i)
      row += "," + roundTripText(v[i]);
  for (int i = 0; i < kNavigationDim; ++i)
    row += "," + roundTripText(std::sqrt(std::max(0.0, result.filter.P(i, i))));
  return row + "\n";
}
}  // namespace

std::unique_ptr<Exporter> makeStatesExporter(const std::string& path)
{
  return rowPerScan(path, kStatesHeader, stateRow);
}

}  // namespace fastlio
