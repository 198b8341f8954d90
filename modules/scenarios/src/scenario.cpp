// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/options/nearest_name.h>
#include <fastlio/scenarios/scenario.h>

#include <algorithm>
#include <stdexcept>

namespace fastlio
{
namespace
{
/** Yaw, pitch and roll in degrees: R = Rz Ry Rx. */
Pose mounting(const Vec3& p, double yaw, double pitch, double roll)
{
  return {
      expSO3({0, 0, yaw * kRadPerDeg}) * expSO3({0, pitch * kRadPerDeg, 0}) *
          expSO3({roll * kRadPerDeg, 0, 0}),
      p};
}

void handHeld(SimulationSettings& s)
{
  s.lidar.T_imu_lidar = mounting({0.03, -0.01, 0.09}, 5.0, 8.0, -2.0);
}

void indoors(SimulationSettings& s)
{
  handHeld(s);
  s.lidar.min_range = 0.5;
}

void bySolidState(SimulationSettings& s)
{
  s.lidar.kind = LidarKind::Livox;
  s.lidar.T_imu_lidar = mounting({0.08, 0.02, -0.04}, 0.0, 25.0, 0.0);
  s.imu.noise = {3e-4, 5e-3, 2e-5, 2e-4};
  s.imu.vibration_gyro = 0.02;
  s.imu.vibration_accel = 0.6;
}

void onCarRoof(SimulationSettings& s)
{
  s.lidar.kind = LidarKind::Os64;
  s.lidar.T_imu_lidar = mounting({0.9, 0.1, 0.45}, -3.0, 1.0, 0.5);
  s.lidar.min_range = 1.5;
  s.imu.rate = 100.0;
}

void onScooter(SimulationSettings& s)
{
  s.lidar.T_imu_lidar = mounting({0.15, 0.0, 0.4}, 2.0, 1.5, -1.0);
}

void shaken(SimulationSettings& s)
{
  indoors(s);
  s.lidar.kind = LidarKind::Os64;
  s.imu.rate = 400.0;
}

void atSeaport(SimulationSettings& s)
{
  handHeld(s);
  s.imu.rate = 100.0;
}

CarrierPath startOf(const CarrierPath& path)
{
  CarrierPath still;
  for (std::size_t i = 0; i < still.channels.size(); ++i)
    still.channels[i].offset = path.channels[i].value(0.0);
  return still;
}

/** A scene that no setting changes. */
template <Scene (*scene)()>
Scene always(const WorldSettings& /*settings*/)
{
  return scene();
}

Scene restScene()
{
  Scene scene = officeScene();
  scene.path = startOf(scene.path);
  return scene;
}

Scene crowdAtRest()
{
  Scene scene = crowdScene();
  scene.path = startOf(scene.path);
  return scene;
}

std::vector<Scenario> makeTable()
{
  return {
      {"campus", "hand-held walk of 140 m between buildings and trees, back to the start; VLP-16",
       always<campusScene>, handHeld},
      {"office", "hand-held walk through rooms and a corridor, back to the start; VLP-16",
       always<officeScene>, indoors},
      {"uav", "multirotor at 6 m/s around buildings, tilting and vibrating; Livox",
       always<uavScene>, bySolidState},
      {"car", "car at 8.5 m/s around city blocks; 64 lines, IMU at 100 Hz", always<streetScene>,
       onCarRoof},
      {"shake", "shaken by hand in a room, above 500 deg/s; 64 lines, IMU at 400 Hz",
       always<shakeScene>, shaken, 20.0},
      {"spin", "turning at more than 1000 deg/s in a hall; VLP-16", always<spinScene>, indoors,
       25.0},
      {"stairs", "four flights of stairs up and down again, hand-held; VLP-16", always<stairsScene>,
       indoors},
      {"tunnel", "straight tunnel without any feature along its axis, hand-held; VLP-16",
       always<tunnelScene>, handHeld},
      {"open_area", "seaport-like wide area with few things to see; VLP-16, IMU at 100 Hz",
       always<openAreaScene>, atSeaport},
      {"crowd", "the campus walk among people and vans in motion; VLP-16", always<crowdScene>,
       handHeld},
      {"park", "hand-held walk over hills among trees, bushes and round buildings; VLP-16",
       always<parkScene>, handHeld},
      {"rotunda", "hand-held walk around the drum of a round, cluttered hall; VLP-16",
       always<rotundaScene>, indoors},
      {"ramp", "drive up four turns of a car park's round ramp and down again; VLP-16",
       always<rampScene>, onScooter},
      {"town", "ride of 1.2 km through the streets of a town, some of them again; VLP-16",
       townScene, onScooter},
      {"facades", "ride along a street whose facades repeat every 17.5 m, there and back; VLP-16",
       always<facadesScene>, onScooter},
      {"corridors", "hand-held walk through six corridors that look alike on two floors; VLP-16",
       always<corridorsScene>, indoors},
      {"rest", "stands still in the office; VLP-16", always<restScene>, indoors, 30.0},
      {"rest_crowd", "stands still on the campus among people and vans in motion; VLP-16",
       always<crowdAtRest>, handHeld, 30.0},
  };
}
}  // namespace

const std::vector<Scenario>& scenarioTable()
{
  static const std::vector<Scenario> table = makeTable();
  return table;
}

const Scenario& findScenario(std::string_view name)
{
  std::vector<std::string_view> names;
  for (const auto& row : scenarioTable())
  {
    if (row.name == name) return row;
    names.push_back(row.name);
  }
  throw std::invalid_argument(
      "There is no scenario '" + std::string(name) + "'. Did you mean '" +
      std::string(nearestName(name, names)) + "'? fastlio-sim --list lists all.");
}

SimulationSettings defaultSettings(std::string_view scenario)
{
  const Scenario& row = findScenario(scenario);
  SimulationSettings settings;
  settings.scenario = row.name;
  row.adapt(settings);
  return settings;
}

}  // namespace fastlio
