// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Gravity of a map that is built while the sensors measure.

#include "simulated_observations.h"
#include <fastlio/loops/CMetricMapBuilderLoops.h>
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace fastlio
{
namespace
{
SimulationSettings walk()
{
  SimulationSettings settings = defaultSettings("campus");
  settings.duration = 25.0;
  settings.lidar.stride = 16;
  return settings;
}

/** \param unit of the accelerometer [m/s^2] */
std::vector<Submap> submapsOfWalk(double unit)
{
  static const auto observations = testing::observationsOf(Simulation(walk()));
  CMetricMapBuilderLoops builder{matchingConfig(walk())};
  for (const auto& observation : observations)
  {
    const auto imu = std::dynamic_pointer_cast<mrpt::obs::CObservationIMU>(observation);
    if (!imu)
    {
      builder.processObservation(observation);
      continue;
    }
    const auto in_unit = mrpt::obs::CObservationIMU::Create(*imu);
    for (const auto axis : {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC, mrpt::obs::IMU_Z_ACC})
      in_unit->set(axis, imu->get(axis) / unit);
    builder.processObservation(in_unit);
  }
  return builder.mapping().submaps;
}
}  // namespace

/** Readings of the accelerometer count in the unit that the odometry has found. */
TEST(GravityInLoops, IsReadByAnImuInUnitsOfG)
{
  const std::vector<Submap> in_si = submapsOfWalk(1.0), in_g = submapsOfWalk(9.80665);
  ASSERT_GT(in_g.size(), 3U);
  ASSERT_EQ(in_g.size(), in_si.size());
  // Two stretches are needed for a reading.
  for (std::size_t i = 1; i < in_g.size(); ++i)
  {
    ASSERT_TRUE(in_si[i].gravity) << i;
    ASSERT_TRUE(in_g[i].gravity) << i;
    EXPECT_LT((in_g[i].gravity->force - in_si[i].gravity->force).norm(), 0.02) << i;
  }
}

}  // namespace fastlio
