// mrpt_fastlio: the odometry on sensors that send now: a LiDAR on the network, and an IMU.
// SPDX-License-Identifier: BSD-3-Clause
//
// One thread receives; the other one computes. What is between them never holds more than two
// scans, so that a pose is late by two scans at most, however slow the machine is.

#include <fastlio/config/config_yaml.h>
#include <fastlio/live/fresh_queue.h>
#include <fastlio/live/live_sensors.h>
#include <fastlio/live/udp_receiver.h>
#include <fastlio/slam/CLidarInertialOdometry.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace
{
std::atomic<bool> stop_asked{false};

void askToStop(int /*signal*/)
{
  stop_asked = true;
}

std::int64_t now_ns()
{
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

/** Packets in, observations out, until a signal, or until the sensors have been silent for a while.
 */
void receive(
    fastlio::UdpReceiver& receiver, fastlio::LiveSensors& sensors, fastlio::FreshQueue& queue)
{
  constexpr std::chrono::milliseconds kPatience(200);
  constexpr int kSilences = 15;  // three seconds
  fastlio::ObservationQueue observations;
  bool begun = false;
  for (int silences = 0; !stop_asked && silences < kSilences;)
  {
    const auto packet = receiver.next(kPatience);
    if (!packet)
    {
      if (begun) ++silences;
      continue;
    }
    begun = true;
    silences = 0;
    sensors.take(*packet, observations);
    for (; !observations.empty(); observations.pop_front())
      queue.push(std::move(observations.front()));
    for (const std::string& problem : sensors.takeProblems())
      std::cerr << problem << "\n";
  }
  queue.close();
}

/** Prints each pose, and keeps how late it was after the last point of its scan. */
class Printer
{
 public:
  void operator()(const fastlio::OdometryEstimate& estimate)
  {
    if (!estimate.vehicle) return;
    // The scans of the start wait for it to be known; they say nothing about the pace.
    if (first_pose_ns_ == 0) first_pose_ns_ = now_ns();
    if (estimate.result.stamp_ns > first_pose_ns_)
      late_ms_.push_back(1e-6 * static_cast<double>(now_ns() - estimate.result.stamp_ns));
    ++poses_;
    const fastlio::Pose& T = estimate.vehicle->T_world_body;
    const Eigen::Quaterniond q(T.R);
    std::printf(
        "%lld.%09lld %.4f %.4f %.4f %.6f %.6f %.6f %.6f\n",
        static_cast<long long>(estimate.result.stamp_ns / 1'000'000'000),
        static_cast<long long>(estimate.result.stamp_ns % 1'000'000'000), T.p.x(), T.p.y(), T.p.z(),
        q.x(), q.y(), q.z(), q.w());
    std::fflush(stdout);
  }

  void summarize(const fastlio::FreshQueueCounts& counts, std::size_t bad_lines)
  {
    std::sort(late_ms_.begin(), late_ms_.end());
    const auto quantile = [this](double q)
    {
      return late_ms_.empty()
                 ? 0.0
                 : late_ms_[static_cast<std::size_t>(q * static_cast<double>(late_ms_.size() - 1))];
    };
    std::fprintf(
        stderr,
        "scans: %zu, %zu of them dropped because newer ones waited; samples: %zu, bad lines: %zu\n"
        "poses: %zu; after the last point of the scan: %.1f ms median, %.1f ms p99, %.1f ms max\n",
        counts.scans, counts.dropped_scans, counts.samples, bad_lines, poses_, quantile(0.5),
        quantile(0.99), quantile(1.0));
  }

 private:
  std::int64_t first_pose_ns_ = 0;
  std::size_t poses_ = 0;
  std::vector<double> late_ms_;
};

void run(std::uint16_t lidar_port, std::uint16_t imu_port, const std::string& parameter_file)
{
  fastlio::UdpReceiver receiver({lidar_port, imu_port});
  fastlio::LiveSensors sensors(imu_port);
  fastlio::FreshQueue queue;

  fastlio::CLidarInertialOdometry odometry;
  odometry.logging_enable_console_output = false;  // the poses have standard output
  odometry.logRegisterCallback([](std::string_view message, auto&&...)
                               { std::cerr << message << "\n"; });
  odometry.initialize(
      parameter_file.empty() ? fastlio::Config{} : fastlio::loadConfigFromFile(parameter_file));
  Printer printer;
  odometry.setCallback([&printer](const fastlio::OdometryEstimate& estimate)
                       { printer(estimate); });

  std::cerr << "listening on UDP ports " << lidar_port << " (LiDAR) and " << imu_port << " (IMU)\n";
  std::thread receiving([&] { receive(receiver, sensors, queue); });
  while (const auto observation = queue.pop())
    odometry.onNewObservation(observation);
  odometry.finish();
  receiving.join();
  for (const fastlio::TopicReport& sensor : sensors.reports())
    std::cerr << sensor.name << ": " << sensor.type << ", " << sensor.messages << " packets, "
              << sensor.reason << "\n";
  printer.summarize(queue.counts(), sensors.badLines());
}
}  // namespace

int main(int argc, char** argv)
{
  if (argc < 3 || argc > 4)
  {
    std::cerr << "Usage: live LIDAR_PORT IMU_PORT [PARAMETERS.yaml]\n";
    return EXIT_FAILURE;
  }
  std::signal(SIGINT, askToStop);
  std::signal(SIGTERM, askToStop);
  try
  {
    run(fastlio::udpPort(argv[1]), fastlio::udpPort(argv[2]), argc > 3 ? argv[3] : "");
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
