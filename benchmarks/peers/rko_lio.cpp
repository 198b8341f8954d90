// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rko_lio.cpp Runs rko_lio on one thread with its default parameters and its initialization
 * at rest. Its base is the IMU. */

#include "peer_run.h"
#include "rko_lio/core/lio.hpp"

namespace
{
using namespace rko_lio::core;

class RkoLio
{
 public:
  RkoLio() : lio_(config()) {}

  void addImu(const peers::ImuRecord& sample)
  {
    ImuControl control;
    control.time = Nsec(sample.stamp_ns);
    for (int i = 0; i < 3; ++i)
    {
      control.acceleration[i] = static_cast<Scalar>(sample.accel[i]);
      control.angular_velocity[i] = static_cast<Scalar>(sample.gyro[i]);
    }
    lio_.add_imu_measurement(control);
  }

  void prepare(const peers::ScanRecord& scan)
  {
    Eigen::Matrix3s R;
    Eigen::Vector3s p;
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
        R(row, column) = static_cast<Scalar>(scan.R_imu_lidar[3 * row + column]);
      p[row] = static_cast<Scalar>(scan.p_imu_lidar[row]);
    }
    T_imu_lidar_ = Sophus::SE3s(Eigen::Quaternions(R).normalized(), p);
    points_.clear();
    times_ = Timestamps{Nsec(scan.begin_ns), Nsec(scan.end_ns), {}};
    for (const peers::PointRecord& point : scan.points)
    {
      points_.emplace_back(point.x, point.y, point.z);
      times_.per_point.emplace_back(scan.begin_ns + point.offset_ns);
    }
  }

  void addScan() { lio_.register_scan(T_imu_lidar_, std::move(points_), times_); }

  bool pose(peers::TimedPose& pose) const
  {
    if (lio_.poses_with_timestamps.empty()) return false;
    const auto& [stamp, T_world_imu] = lio_.poses_with_timestamps.back();
    pose.stamp_ns = stamp.count();
    for (int i = 0; i < 3; ++i)
      pose.position[i] = T_world_imu.translation()[i];
    for (int i = 0; i < 4; ++i)
      pose.quaternion[i] = T_world_imu.unit_quaternion().coeffs()[i];
    return true;
  }

 private:
  static LIO::Config config()
  {
    LIO::Config config;
    config.max_num_threads = 1;
    config.initialization_phase = true;
    return config;
  }

  LIO lio_;
  Sophus::SE3s T_imu_lidar_;
  Vector3sVector points_;
  Timestamps times_;
};
}  // namespace

int main(int argc, char** argv)
{
  return peers::main(
      argc, argv, [](const std::vector<peers::Record>&, const std::string&) { return RkoLio(); });
}
