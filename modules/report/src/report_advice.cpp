// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_advice.h"

#include <string_view>
#include <utility>

namespace fastlio
{
namespace
{
using AdviceRow = std::pair<HealthCause, HealthAdvice>;

// One row per cause, as docs/troubleshooting.md has one section per cause.
const std::vector<AdviceRow>& adviceRows()
{
  static const std::vector<AdviceRow> rows = {
      {HealthCause::None, {"Nothing is wrong.", ""}},
      {HealthCause::Starting,
       {"The odometry has no pose yet.",
        "Let the platform rest for two seconds at the start, or move slowly where there is much to "
        "see. Check with fastlio-info that both sensors recorded at the same time."}},
      {HealthCause::Lost,
       {"The scans have not corrected the pose for too long, or the filter took a step that is "
        "no number. The pose cannot be trusted.",
        "Look at the cause in the seconds before. Check the pose of the LiDAR, units and clocks "
        "with fastlio-info."}},
      {HealthCause::NoMatch,
       {"The scan did not correct the predicted pose: too few points match the map.",
        "Check lidar.min_range and lidar.max_range, and that the LiDAR sees its surroundings. "
        "Indoors a smaller map.voxel_size gives more matches."}},
      {HealthCause::FewMatches,
       {"Far fewer points match the map than in the scans before: the pose is off, or "
        "something covers the LiDAR.",
        "Look at the times of the points and the pose of the LiDAR. Avoid people and objects close "
        "around the sensor."}},
      {HealthCause::LargeResidual,
       {"The points lie farther from the surfaces of the map than their noise explains.",
        "Check the pose of the LiDAR (input.T_vehicle_lidar), lidar.time_offset and the times of "
        "the points. A LiDAR with more noise needs a larger measurement.range_noise."}},
      {HealthCause::DegenerateDirection,
       {"The surroundings leave a direction of motion open, as in a tunnel or on a wide "
        "plain. Only the inertial data know it, and not for long.",
        "Use a LiDAR with a wider view or a longer range (lidar.max_range). Keep to places with "
        "structure in every direction."}},
      {HealthCause::InertialData,
       {"Inertial samples are missing, clipped or absurd.",
        "Look for lost samples in the recording, and for shocks. Give the sensor a larger "
        "range, or fasten it on a damper."}},
      {HealthCause::Bias,
       {"An estimated bias of the inertial sensor has run far away: it explains something else.",
        "Check the pose of the LiDAR, the units of the inertial sensor (imu.accel_unit, "
        "imu.gyro_unit) and the clocks of both sensors."}},
      {HealthCause::ScanTiming,
       {"There is a long time without a scan.",
        "Look for lost packets, a full disk or stamps that jump in the recording "
        "(fastlio-info). The pose in the gap comes from inertial data alone."}},
      {HealthCause::MotionDisagreement,
       {"Scans and inertial data see different motions.",
        "Check the pose of the LiDAR (input.T_vehicle_lidar), the units, the sign of the "
        "accelerometer (imu.invert_acceleration), the point times and the clocks; fastlio-info "
        "checks them by the motion."}},
  };
  return rows;
}
}  // namespace

HealthAdvice adviceOf(HealthCause cause)
{
  for (const AdviceRow& row : adviceRows())
    if (row.first == cause) return row.second;
  return {};
}

std::vector<HealthCause> allHealthCauses()
{
  std::vector<HealthCause> causes;
  for (const AdviceRow& row : adviceRows())
    if (row.first != HealthCause::None) causes.push_back(row.first);
  return causes;
}

std::string causeLink(HealthCause cause)
{
  const std::string_view name = toString(cause);
  if (cause == HealthCause::None) return std::string(name);
  return std::string("<a href=\"#").append(name).append("\">").append(name).append("</a>");
}

}  // namespace fastlio
