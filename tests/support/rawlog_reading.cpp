// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "rawlog_reading.h"

#include <fastlio/sensors/conversions.h>

#include <cmath>

namespace fastlio::testing
{
Reading readAll(const std::vector<std::string>& files, const fastlio::RawlogSourceOptions& options)
{
  fastlio::RawlogSource source(files, options);
  Reading reading;
  while (const auto observation = source.next())
  {
    const auto ns = fastlio::toNanoseconds(observation->timestamp) - kStart;
    reading.seconds.push_back(std::round(static_cast<double>(ns) * 1e-6) / 1e3);
    reading.labels.push_back(observation->sensorLabel);
  }
  EXPECT_EQ(source.next(), nullptr);
  reading.problems = source.problems();
  return reading;
}

std::vector<Object> samples(int count)
{
  std::vector<Object> objects;
  objects.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    objects.push_back(imuAt(0.005 * i));
  return objects;
}

}  // namespace fastlio::testing
