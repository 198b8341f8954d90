// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "streaming.h"

#include <fastlio/math/time.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/rawlog/decode_ahead_source.h>
#include <fastlio/survey/sensor_selection.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>

namespace fastlio::benchmarks
{
namespace
{
/** A line of /proc/self/status such as "VmHWM:  1234 kB" in MB. */
double statusMegabytes(const std::string& key)
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
  {
    if (line.rfind(key + ":", 0) != 0) continue;
    double kilobytes = 0.0;
    std::istringstream(line.substr(key.size() + 1)) >> kilobytes;
    return kilobytes / 1024.0;
  }
  return 0.0;
}

/** Begin of the first and end of the last scan. */
struct Span
{
  std::int64_t begin_ns = 0, end_ns = 0;

  void add(const ScanResult& result)
  {
    if (begin_ns == 0) begin_ns = result.begin_ns;
    end_ns = std::max(end_ns, result.stamp_ns);
  }
};
}  // namespace

StreamingResult stream(const std::string& rawlog, const OdometryOptions& parameters)
{
  StreamingResult outcome;
  const double before = statusMegabytes("VmRSS");
  const auto start = std::chrono::steady_clock::now();
  const SensorPatterns any;
  DecodeAheadSource source(
      RawlogSource({rawlog}), ObservationBridge(selectSensors(surveySensors({rawlog}, any), any)));
  Odometry odometry(parameters);
  Span span;
  while (auto input = source.next())
  {
    if (const auto* sample = std::get_if<ImuSample>(&input->data))
      odometry.addImu(*sample);
    else
      odometry.addScan(std::get<LidarScan>(std::move(input->data)));
    while (const auto result = odometry.next())
      span.add(*result);
  }
  while (const auto result = odometry.flush())
    span.add(*result);
  const auto end = std::chrono::steady_clock::now();
  outcome.wall_seconds = std::chrono::duration<double>(end - start).count();
  outcome.recording_seconds = toSeconds(span.end_ns - span.begin_ns);
  outcome.memory_over_start_mb = statusMegabytes("VmHWM") - before;
  return outcome;
}

}  // namespace fastlio::benchmarks
