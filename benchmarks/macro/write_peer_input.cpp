// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file write_peer_input.cpp A recording as the programs of benchmarks/peers read it, so that all
 * of them compute from the same numbers. */

#include "../peers/peer_input.h"
#include "inputs.h"

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>

using namespace fastlio;
using namespace fastlio::benchmarks;

namespace
{
peers::ImuRecord recordOf(const ImuSample& sample)
{
  peers::ImuRecord record;
  record.stamp_ns = sample.stamp_ns;
  for (int i = 0; i < 3; ++i)
  {
    record.gyro[i] = sample.gyro[i];
    record.accel[i] = sample.accel[i];
  }
  return record;
}

peers::ScanRecord recordOf(const LidarScan& scan)
{
  peers::ScanRecord record;
  const ScanSpan span = spanOf(scan);
  record.begin_ns = span.begin_ns;
  record.end_ns = span.end_ns;
  const Mat3 R = scan.T_imu_lidar.R.matrix();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
      record.R_imu_lidar[3 * row + column] = R(row, column);
    record.p_imu_lidar[row] = scan.T_imu_lidar.p[row];
  }
  const PointColumns& points = scan.points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::int64_t time_ns = scan.stamp_ns + points.time_offset_ns[i];
    record.points.push_back(
        {points.x[i], points.y[i], points.z[i],
         static_cast<std::int32_t>(time_ns - span.begin_ns)});
  }
  return record;
}
}  // namespace

int main(int argc, char** argv)
try
{
  if (argc != 3)
  {
    std::fprintf(stderr, "usage: fastlio-peer-input RECORDING OUTPUT\n");
    return 2;
  }
  std::ofstream output(argv[2], std::ios::binary);
  std::vector<peers::ScanRecord> waiting;
  for (const Input& input : inputsOfRecording(argv[1], Config()).data)
  {
    if (const auto* scan = std::get_if<LidarScan>(&input))
    {
      waiting.push_back(recordOf(*scan));
      continue;
    }
    const peers::ImuRecord sample = recordOf(std::get<ImuSample>(input));
    peers::write(output, sample);
    // A scan has the time of its first point; a peer uses it when the samples of all its points are
    // there.
    while (!waiting.empty() && waiting.front().end_ns <= sample.stamp_ns)
    {
      peers::write(output, waiting.front());
      waiting.erase(waiting.begin());
    }
  }
  output.close();
  if (!output) throw std::runtime_error(std::string(argv[2]) + " cannot be written");
  return 0;
}
catch (const std::exception& error)
{
  std::fprintf(stderr, "fastlio-peer-input: %s\n", error.what());
  return 1;
}
