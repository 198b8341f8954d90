// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mapping/rigs.h>
#include <fastlio/math/so3.h>

#include <algorithm>

namespace fastlio
{
namespace
{
// Formats that hold poses in other ways change them by less, and a calibration by more [m], [rad].
constexpr double kSamePose = 1e-6;

bool isSameSensor(const SensorPlace& a, const SensorPlace& b)
{
  return a.kind == b.kind && a.label == b.label;
}
}  // namespace

bool isOneRig(const InputPlan& a, const InputPlan& b)
{
  if (!std::equal(a.places.begin(), a.places.end(), b.places.begin(), b.places.end(), isSameSensor))
    return false;
  for (std::size_t i = 0; i < a.places.size(); ++i)
  {
    const Pose T_a = a.T_vehicle_imu.inverse() * a.places[i].T_vehicle_sensor,
               T_b = b.T_vehicle_imu.inverse() * b.places[i].T_vehicle_sensor;
    if ((T_a.p - T_b.p).norm() > kSamePose || (T_a.R - T_b.R).norm() > kSamePose) return false;
  }
  return true;
}

std::vector<std::size_t> rigsOf(const std::vector<Session>& sessions)
{
  const auto is_constant = [](const Session& session)
  { return !session.config().odometry.calibration.estimate_extrinsic; };
  std::vector<std::size_t> rigs;
  for (std::size_t i = 0; i < sessions.size(); ++i)
  {
    std::size_t rig = i;
    for (std::size_t before = 0; before < i && rig == i; ++before)
      if (is_constant(sessions[i]) && is_constant(sessions[before]) &&
          isOneRig(sessions[i].plan(), sessions[before].plan()))
        rig = rigs[before];
    rigs.push_back(rig);
  }
  return rigs;
}

}  // namespace fastlio
