// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file example_recordings.cpp A rawlog of Velodyne packets in the formats that the pages name.
 *
 * Usage: example_recordings WALK.rawlog FOLDER    writes walk.bag, vlp16.pcap and imu.csv */

#include "bag_writers.h"
#include "capture_writer.h"
#include "folder_writers.h"
#include "ros2_writers.h"
#include "test_files.h"
#include <fastlio/rawlog/rawlog_source.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

int main(int argc, char** argv)
try
{
  using namespace fastlio::testing;
  if (argc != 3) return 1;
  std::vector<Object> objects;
  fastlio::RawlogSource source({argv[1]}, {0.0});
  while (auto observation = source.next())
    objects.push_back(std::move(observation));
  const std::string folder = std::string(argv[2]) + "/";
  write(folder + "walk.bag", bagOf(messagesOf(objects, Wire::Ros1)));
  write(folder + "vlp16.pcap", captureOf(packetsOf(objects)));
  write(folder + "imu.csv", imuTableOf(objects));
  return 0;
}
catch (const std::exception& e)
{
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
