// mrpt_fastlio: the odometry in a loop of your own, on the observations of a rawlog.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/config/config_yaml.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/survey/sensor_selection.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <variant>

namespace
{
void print(const fastlio::ScanResult& result)
{
  std::cout << result.stamp_ns << " " << toString(result.status) << " "
            << result.filter.x.p.transpose() << "\n";
}

void run(const std::string& rawlog, const std::string& parameter_file)
{
  fastlio::Odometry odometry(fastlio::loadConfigFromFile(parameter_file).odometry);

  // Which LiDAR, which IMU: those that are found.
  const fastlio::SensorPatterns any;
  fastlio::ObservationBridge bridge(
      fastlio::selectSensors(fastlio::surveySensors({rawlog}, any), any));

  // Instead of a file, this may be a driver: any source of mrpt::obs::CObservation.
  fastlio::RawlogSource source({rawlog});
  while (const auto observation = source.next())
  {
    auto input = bridge.convert(*observation);
    if (const auto* sample = std::get_if<fastlio::ImuSample>(&input)) odometry.addImu(*sample);
    if (auto* scan = std::get_if<fastlio::LidarScan>(&input)) odometry.addScan(std::move(*scan));
    while (const auto result = odometry.next())
      print(*result);
  }
  while (const auto result = odometry.flush())
    print(*result);
}
}  // namespace

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "Usage: own_loop RECORDING.rawlog PARAMETERS.yaml\n";
    return EXIT_FAILURE;
  }
  try
  {
    run(argv[1], argv[2]);
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
