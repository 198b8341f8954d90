// mrpt_fastlio: the least that a program needs to run the odometry on its own sensors.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/odometry/odometry.h>
#include <fastlio/simulation/recording.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>

namespace
{
void print(const fastlio::ScanResult& result)
{
  const auto variances = result.filter.P.diagonal().segment<3>(fastlio::kPosition);
  std::cout << result.stamp_ns << " ns " << toString(result.status) << " at "
            << result.filter.x.p.transpose() << " m +- " << std::sqrt(variances.maxCoeff()) << " m "
            << result.message << "\n";
}

/** Status of the last scan. */
fastlio::ScanStatus run()
{
  // In the place of drivers: five seconds of a simulated IMU and LiDAR, at rest for the first two.
  fastlio::SimulationSettings settings = fastlio::defaultSettings("office");
  settings.duration = 5.0;
  const fastlio::Simulation sensors(settings);
  fastlio::ScanStatus status = fastlio::ScanStatus::Initializing;

  fastlio::Odometry odometry(fastlio::matchingParameters(settings));
  for (const fastlio::ImuSample& sample : sensors.imu().samples)
    odometry.addImu(sample);
  for (std::size_t i = 0; i < sensors.scanCount(); ++i)
  {
    odometry.addScan(sensors.scan(i));
    while (const auto result = odometry.next())
    {
      print(*result);
      status = result->status;
    }
  }
  return status;
}
}  // namespace

int main()
{
  try
  {
    return run() == fastlio::ScanStatus::Tracking ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
