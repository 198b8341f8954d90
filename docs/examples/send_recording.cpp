// mrpt_fastlio: sends a recording of a Velodyne and an IMU over the network, as fast as the sensors
// did. SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/live/udp_receiver.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <arpa/inet.h>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <netinet/in.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

namespace
{
using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationVelodyneScan;

struct Message
{
  std::int64_t stamp_ns = 0;  // of the recording
  bool is_sample = false;
  std::string bytes;
};

/** Packets at their own times, after the stamp of their scan. */
void addPackets(const CObservationVelodyneScan& scan, std::vector<Message>& messages)
{
  constexpr std::int64_t kHour_us = 3'600'000'000;
  for (const auto& packet : scan.scan_packets)
  {
    const std::int64_t first_us = scan.scan_packets.front().gps_timestamp();
    const std::int64_t after_us = (packet.gps_timestamp() - first_us + kHour_us) % kHour_us;
    messages.push_back(
        {fastlio::toNanoseconds(scan.timestamp) + 1000 * after_us, false,
         std::string(reinterpret_cast<const char*>(&packet), sizeof packet)});
  }
}

/** The text after the stamp in a line. */
std::string numbersOf(const CObservationIMU& imu)
{
  using namespace mrpt::obs;
  std::ostringstream text;
  text.precision(12);
  for (const auto field : {IMU_WX, IMU_WY, IMU_WZ, IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC})
    text << ',' << imu.get(field);
  return text.str();
}

std::vector<Message> messagesOf(const std::string& file)
{
  std::vector<Message> messages;
  fastlio::RawlogSource source({file});
  while (const auto observation = source.next())
  {
    if (const auto* scan = dynamic_cast<const CObservationVelodyneScan*>(observation.get()))
      addPackets(*scan, messages);
    else if (const auto* imu = dynamic_cast<const CObservationIMU*>(observation.get()))
      messages.push_back({fastlio::toNanoseconds(imu->timestamp), true, numbersOf(*imu)});
  }
  if (messages.empty()) throw std::runtime_error(file + ": no packets of a Velodyne, no samples");
  const auto earlier = [](const Message& a, const Message& b) { return a.stamp_ns < b.stamp_ns; };
  std::stable_sort(messages.begin(), messages.end(), earlier);
  return messages;
}

class Sender
{
 public:
  explicit Sender(std::uint16_t port) : handle_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0))
  {
    address_.sin_family = AF_INET;
    address_.sin_port = htons(port);
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  }
  ~Sender() { close(handle_); }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;

  void send(const std::string& bytes) const
  {
    (void)sendto(
        handle_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address_),
        sizeof address_);
  }

 private:
  int handle_;
  sockaddr_in address_{};
};

void sleepUntil(std::int64_t time_ns)
{
  timespec time{};
  time.tv_sec = time_ns / 1'000'000'000;
  time.tv_nsec = time_ns % 1'000'000'000;
  while (clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &time, nullptr) != 0)
  {
  }
}

double speedOf(const std::string& text)
{
  const auto speed = fastlio::parsed<double>(text);
  if (!speed || !(*speed > 0.0))
    throw std::invalid_argument(
        "'" + text + "' is no speed; give a number above 0, 1 for that of the sensors");
  return *speed;
}

void run(const std::string& file, std::uint16_t lidar_port, std::uint16_t imu_port, double speed)
{
  const std::vector<Message> messages = messagesOf(file);
  const Sender lidar(lidar_port), imu(imu_port);
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const std::int64_t begin_ns = static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
  // Stamps of the samples are of now, like those that the receiver gives the packets.
  std::cerr << "shift_ns " << begin_ns - messages.front().stamp_ns << "\n";
  for (const Message& message : messages)
  {
    const std::int64_t after_ns = message.stamp_ns - messages.front().stamp_ns;
    sleepUntil(begin_ns + static_cast<std::int64_t>(static_cast<double>(after_ns) / speed));
    if (message.is_sample)
      imu.send(std::to_string(begin_ns + after_ns) + message.bytes + "\n");
    else
      lidar.send(message.bytes);
  }
}
}  // namespace

int main(int argc, char** argv)
{
  if (argc < 4 || argc > 5)
  {
    std::cerr << "Usage: send_recording RECORDING.rawlog LIDAR_PORT IMU_PORT [SPEED]\n"
                 "SPEED above 1 overloads the receiver; stamps stay those of the recording.\n";
    return EXIT_FAILURE;
  }
  try
  {
    run(argv[1], fastlio::udpPort(argv[2]), fastlio::udpPort(argv[3]),
        argc > 4 ? speedOf(argv[4]) : 1.0);
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
