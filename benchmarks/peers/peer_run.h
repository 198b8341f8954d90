// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file peer_run.h What the programs of all peers have in common: they take a file of records,
 * feed it to the peer and write its poses and the time that each scan needed. */
#pragma once

#include "peer_input.h"

#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

namespace peers
{
/** A pose of the IMU: position [m] and quaternion x, y, z, w. */
struct TimedPose
{
  std::int64_t stamp_ns = 0;
  double position[3] = {};
  double quaternion[4] = {};
};

/** Feeds a peer and measures it: the time of a scan has that of the inertial samples since the scan
 * before in it. Reading and the conversion to the types of the peer (prepare()) are not measured.
 * \tparam Peer has addImu(ImuRecord), prepare(ScanRecord), addScan() and pose(TimedPose&), which
 *   returns whether there is a pose for the last scan */
template <typename Peer>
void run(Peer& peer, const std::vector<Record>& records, const std::string& output)
{
  using Clock = std::chrono::steady_clock;
  std::FILE* trajectory = std::fopen((output + ".tum").c_str(), "w");
  std::FILE* times = std::fopen((output + ".ms").c_str(), "w");
  if (trajectory == nullptr || times == nullptr)
    throw std::runtime_error(output + ".* cannot be written");
  double milliseconds = 0.0;
  const auto measure = [&](const auto& work)
  {
    const auto start = Clock::now();
    work();
    milliseconds += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  };
  for (const Record& record : records)
  {
    if (const auto* sample = std::get_if<ImuRecord>(&record))
    {
      measure([&] { peer.addImu(*sample); });
      continue;
    }
    peer.prepare(std::get<ScanRecord>(record));
    measure([&] { peer.addScan(); });
    TimedPose pose;
    if (peer.pose(pose))
    {
      std::fprintf(
          trajectory, "%lld.%09lld %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n",
          static_cast<long long>(pose.stamp_ns / 1000000000),
          static_cast<long long>(pose.stamp_ns % 1000000000), pose.position[0], pose.position[1],
          pose.position[2], pose.quaternion[0], pose.quaternion[1], pose.quaternion[2],
          pose.quaternion[3]);
      std::fprintf(times, "%.6f\n", milliseconds);
    }
    milliseconds = 0.0;
  }
  std::fclose(trajectory);
  std::fclose(times);
}

/** Reads argv[1], runs the peer on it, writes argv[2].tum and argv[2].ms. */
template <typename MakePeer>
int main(int argc, char** argv, const MakePeer& make_peer)
try
{
  if (argc < 3)
  {
    std::fprintf(stderr, "usage: %s INPUT OUTPUT [CONFIG]\n", argv[0]);
    return 2;
  }
  std::ifstream input(argv[1], std::ios::binary);
  if (!input) throw std::runtime_error(std::string(argv[1]) + " cannot be read");
  const std::vector<Record> records = readAll(input);
  auto peer = make_peer(records, argc > 3 ? argv[3] : "");
  run(peer, records, argv[2]);
  return 0;
}
catch (const std::exception& error)
{
  std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
  return 1;
}
}  // namespace peers
