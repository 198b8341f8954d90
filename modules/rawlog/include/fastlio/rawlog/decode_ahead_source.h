// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file decode_ahead_source.h Reading, decompressing and decoding on a thread of their own. */
#pragma once

#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/sensors/scan_merger.h>

#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <variant>
#include <vector>

namespace fastlio
{
template <typename Item>
class BoundedQueue;

/** One input of the odometry, and how far reading had come when it was made. */
struct DecodedInput
{
  std::variant<ImuSample, LidarScan> data;
  ReadProgress progress;
};

/** Runs a RawlogSource and an ObservationBridge ahead of the consumer, through a bounded queue. The
 * order of the inputs is that of the source; of several LiDARs the scans are merged (ScanMerger).
 * One thread consumes. */
class DecodeAheadSource
{
 public:
  /** Some scans ahead are enough for reading and odometry not to wait for each other, and so many
   * points need about 10 MB, whatever the rates of the sensors are. */
  static constexpr std::size_t kPointsAhead = 300'000;

  /** Starts reading. \param points_ahead of the scans that are kept ready; an inertial sample
   * counts as one. A single scan may have more. */
  DecodeAheadSource(
      RawlogSource source, ObservationBridge bridge, std::size_t points_ahead = kPointsAhead);

  /** Stops reading if it has not come to the end. */
  ~DecodeAheadSource();
  DecodeAheadSource(const DecodeAheadSource&) = delete;
  DecodeAheadSource& operator=(const DecodeAheadSource&) = delete;

  /** Waits for the next input; nothing after the last one or after stop().
   * \exception whatever the reading thread could not handle, e.g. std::bad_alloc */
  [[nodiscard]] std::optional<DecodedInput> next();

  /** Stops reading early; next() returns nothing from then on. */
  void stop();

  /** The problems on the way: call after next() has returned nothing, or after stop().
   * \exception std::logic_error called earlier */
  [[nodiscard]] const std::vector<ReadProblem>& problems() const;
  [[nodiscard]] const BridgeStatistics& statistics() const;

 private:
  void run();
  bool deliver(const mrpt::obs::CObservation& observation);
  bool deliver(LidarScan scan);
  void join();
  void requireStopped() const;

  RawlogSource source_;
  ObservationBridge bridge_;
  ScanMerger merger_;  // idle with a single LiDAR
  std::unique_ptr<BoundedQueue<DecodedInput>> queue_;
  std::exception_ptr failure_;
  BridgeStatistics statistics_;  // of everything, once the thread has been joined
  std::thread thread_;           // last: starts when all else is there
};

}  // namespace fastlio
