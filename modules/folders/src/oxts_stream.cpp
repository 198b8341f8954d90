// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// KITTI's files of the inertial and GNSS unit (dataformat.txt of the raw data).

#include "timed_stream.h"
#include <fastlio/options/number_text.h>
#include <fastlio/options/split_text.h>
#include <fastlio/recordings/byte_source.h>
#include <fastlio/recordings/sensor_imu.h>

#include <array>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::size_t kOxtsValues = 30, kAccelerationAt = 11, kRateAt = 17;
constexpr std::size_t kLongestOxts = 4096;

std::array<double, kOxtsValues> oxtsOf(const std::string& path)
{
  const std::string text = headOf(path, kLongestOxts);
  const auto words = splitAtBlanks(text, kOxtsValues);
  std::array<double, kOxtsValues> values{};
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const auto number = i < words.size() ? parsed<double>(words[i]) : std::nullopt;
    if (!number) throw std::runtime_error("does not hold the 30 numbers of an OXTS sample");
    values.at(i) = *number;
  }
  return values;
}
}  // namespace

std::unique_ptr<TimedStream> oxtsStream(std::vector<TimedFile> files)
{
  const auto read = [](const TimedFile& file)
  {
    const auto values = oxtsOf(file.path);
    const auto vectorAt = [&](std::size_t at)
    { return Vec3(values.at(at), values.at(at + 1), values.at(at + 2)); };
    return makeImu("oxts", file.stamp_ns, vectorAt(kRateAt), vectorAt(kAccelerationAt));
  };
  return std::make_unique<FileStream>(
      TopicReport{"oxts", "OXTS", 0, 0, "IMU"}, std::move(files), read);
}

}  // namespace fastlio
