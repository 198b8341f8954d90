// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/json_text.h>
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/simulation/recording.h>

#include <nlohmann/json.hpp>

namespace fastlio
{
namespace
{
Json biasJson(const ImuBias& bias)
{
  return {{"gyro_rad_s", vectorJson(bias.gyro)}, {"accel_m_s2", vectorJson(bias.accel)}};
}

Json settingsJson(const SimulationSettings& settings)
{
  Json all = Json::object();
  for (const auto& row : settingsTable())
    all[std::string(row.key)] = jsonValue(valueText(row, settings));
  return all;
}

Json matrixJson(const Mat3& m)
{
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < 3; ++i)
    rows.push_back(vectorJson(m.row(i)));
  return rows;
}

Json imuErrorsJson(const ImuErrors& errors)
{
  return {
      {"gyro_matrix", matrixJson(errors.gyro)},
      {"accel_matrix", matrixJson(errors.accel)},
      {"g_sensitivity_rad_s_per_m_s2", matrixJson(errors.g_sensitivity)}};
}

Json lasersJson(const LidarErrors& errors)
{
  return {
      {"range_offset_m", errors.range_offset},
      {"elevation_offset_rad", errors.elevation_offset},
      {"azimuth_offset_rad", errors.azimuth_offset}};
}

/** Times [s] from the start of the first to the end of the last of successive fixes for which
 * something holds. */
template <typename Predicate>
Json spansJson(const Simulation& simulation, Predicate holds)
{
  Json spans = Json::array();
  bool held = false;
  for (const SimulatedFix& fix : simulation.gnss())
  {
    const double t = simulation.secondsSinceStart(fix.stamp_ns);
    if (holds(fix) && !held) spans.push_back({t, t});
    if (holds(fix)) spans.back()[1] = t;
    held = holds(fix);
  }
  return spans;
}

Json gnssJson(const Simulation& simulation)
{
  const GnssSettings& s = simulation.settings().gnss;
  return {
      {"world", "x east, y north, z up; origin: the datum"},
      {"datum",
       {{"latitude_deg", s.latitude}, {"longitude_deg", s.longitude}, {"height_m", s.height}}},
      {"geoid_m", s.geoid},
      {"lever_arm_m", vectorJson(s.lever_arm)},
      {"outages_s", spansJson(simulation, [](const SimulatedFix& f) { return !f.known; })},
      {"multipath_s", spansJson(simulation, [](const SimulatedFix& f) { return f.multipath; })}};
}

double pathLength(const Simulation& simulation)
{
  constexpr double kStep = 0.01;
  double length = 0.0;
  for (double t = 0.5 * kStep; t < simulation.settings().duration; t += kStep)
    length += kStep * simulation.motion().at(t).velocity.norm();
  return length;
}

Json truthJson(const Simulation& simulation)
{
  const SimulationSettings& s = simulation.settings();
  const auto& bias = simulation.imu().true_bias;
  Json truth{
      {"gravity_world_m_s2", {0.0, 0.0, -s.gravity}},
      {"T_imu_lidar", poseJson(simulation.lidarErrors().T_imu_lidar)},
      {"lidar_clock_minus_imu_clock_s", clockOffset(s.lidar, 0.0)},
      {"imu_errors", imuErrorsJson(simulation.imu().errors)},
      {"laser_lines", lasersJson(simulation.lidarErrors())},
      {"start_pose", poseJson(simulation.motion().pose(0.0))},
      {"end_pose", poseJson(simulation.motion().pose(s.duration))},
      {"path_length_m", pathLength(simulation)}};
  if (!simulation.gnss().empty()) truth["gnss"] = gnssJson(simulation);
  if (bias.empty()) return truth;
  truth["initial_bias"] = biasJson(bias.front());
  truth["final_bias"] = biasJson(bias.back());
  return truth;
}
}  // namespace

std::string scenarioJson(const Simulation& simulation)
{
  const SimulationSettings& s = simulation.settings();
  return jsonText(
      {{"scenario", s.scenario},
       {"start_ns", s.start_ns},
       {"duration_s", s.duration},
       {"frames",
        "world: z up; vehicle = IMU; poses T_world_imu of the IMU, R = Rz(yaw) Ry(pitch) Rx(roll)"},
       {"settings", settingsJson(s)},
       {"truth", truthJson(simulation)},
       {"counts",
        {{"sweeps", simulation.scanCount()},
         {"imu_samples", simulation.imu().samples.size()},
         {"imu_samples_lost", simulation.imu().lost},
         {"gnss_fixes", simulation.gnss().size()},
         {"wheel_readings", simulation.wheels().size()}}}});
}

}  // namespace fastlio
