// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/live/live_sensors.h>
#include <fastlio/recordings/sensor_imu.h>
#include <fastlio/sensors/velodyne_decoder.h>

#include <array>
#include <charconv>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostClocks = 64;  // senders; more are not stamped by their clocks
constexpr std::size_t kSampleNumbers = 6;
constexpr std::string_view kBetween = " \t,;\r";

/** Takes the next number off the line. */
template <typename Number>
bool takeNumber(std::string_view& line, Number& number)
{
  const std::size_t begin = line.find_first_not_of(kBetween);
  if (begin == std::string_view::npos) return false;
  line.remove_prefix(begin);
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  if (error != std::errc()) return false;
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  return line.empty() || kBetween.find(line.front()) != std::string_view::npos;
}
}  // namespace

mrpt::obs::CObservation::Ptr sampleOfText(
    std::string_view line, std::int64_t arrival_ns, const std::string& label)
{
  std::int64_t stamp_ns = 0;
  std::array<double, kSampleNumbers> numbers{};
  bool good = takeNumber(line, stamp_ns);
  for (double& number : numbers)
    good = good && takeNumber(line, number) && std::isfinite(number);
  if (!good || stamp_ns < 0 || line.find_first_not_of(kBetween) != std::string_view::npos)
    return nullptr;
  return makeImu(
      label, stamp_ns == 0 ? arrival_ns : stamp_ns, Vec3(numbers[0], numbers[1], numbers[2]),
      Vec3(numbers[3], numbers[4], numbers[5]));
}

LiveSensors::LiveSensors(std::optional<std::uint16_t> imu_port, const std::string& metadata)
    : imu_port_(imu_port), streams_(metadata)
{
}

void LiveSensors::take(UdpPacket packet, ObservationQueue& out)
{
  if (imu_port_ == packet.port)
  {
    takeText(packet, out);
    return;
  }
  const bool known = clocks_.count(packet.source) > 0 || clocks_.size() < kMostClocks;
  if (known && isVelodynePacket(packet))
    packet.stamp_ns = clocks_[packet.source].stampOf(
        1000 * std::int64_t{velodyneTimeOf(packet.data)}, packet.stamp_ns);
  streams_.take(packet, out);
}

void LiveSensors::takeText(const UdpPacket& packet, ObservationQueue& out)
{
  std::string_view text(reinterpret_cast<const char*>(packet.data), packet.size);
  while (!text.empty())
  {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (line.find_first_not_of(kBetween) == std::string_view::npos) continue;
    if (auto sample = sampleOfText(line, packet.stamp_ns, "imu_" + packet.source))
      out.push_back(std::move(sample));
    else
      ++bad_lines_;
  }
}

}  // namespace fastlio
