// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bounded_queue.h"
#include <fastlio/rawlog/decode_ahead_source.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/scan_merger.h>

#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

namespace fastlio
{
class DecodeAheadSource::Impl
{
 public:
  Impl(RawlogSource source, ObservationBridge bridge, std::size_t points_ahead)
      : source_(std::move(source)),
        bridge_(std::move(bridge)),
        queue_(points_ahead),
        thread_([this] { run(); })
  {
  }

  ~Impl() { stop(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::optional<DecodedInput> next()
  {
    auto input = queue_.pop();
    if (!input) join();
    if (!input && failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return input;
  }

  void stop()
  {
    queue_.close();
    join();
    queue_.clear();
  }

  [[nodiscard]] const RawlogSource& source() const
  {
    requireStopped();
    return source_;
  }

  [[nodiscard]] const BridgeStatistics& statistics() const
  {
    requireStopped();
    return statistics_;
  }

 private:
  void run()
  {
    try
    {
      while (const auto observation = source_.next())
        if (!deliver(*observation)) break;
      while (auto scan = merger_.flush())
        if (!deliver(std::move(*scan))) break;
    }
    catch (...)
    {
      failure_ = std::current_exception();
    }
    queue_.close();
  }

  // False: nobody wants more.
  bool deliver(const mrpt::obs::CObservation& observation)
  {
    BridgeOutput output = bridge_.convert(observation);
    if (const auto* sample = std::get_if<ImuSample>(&output))
      if (!queue_.push({*sample, source_.progress()}, 1)) return false;
    if (auto* scan = std::get_if<LidarScan>(&output))
    {
      if (bridge_.selection().further_lidars.empty()) return deliver(std::move(*scan));
      merger_.add(bridge_.lidarOf(observation).value_or(0), std::move(*scan));
    }
    while (auto scan = merger_.next(toNanoseconds(observation.timestamp)))
      if (!deliver(std::move(*scan))) return false;
    return true;
  }

  bool deliver(LidarScan scan)
  {
    const std::size_t points = scan.points.size();
    return queue_.push({std::move(scan), source_.progress()}, points);
  }

  void join()
  {
    if (!thread_.joinable()) return;
    thread_.join();
    statistics_ = bridge_.statistics();
    statistics_.points_left_out = merger_.pointsLeftOut();
  }

  // The thread's work is visible to the others only once it has been joined.
  void requireStopped() const
  {
    if (thread_.joinable())
      throw std::logic_error(
          "DecodeAheadSource: ask after next() has returned nothing, or after stop().");
  }

  RawlogSource source_;
  ObservationBridge bridge_;
  ScanMerger merger_;  // idle with a single LiDAR
  BoundedQueue<DecodedInput> queue_;
  std::exception_ptr failure_;
  BridgeStatistics statistics_;  // of everything, once the thread has been joined
  std::thread thread_;           // last: starts when all else is there
};

DecodeAheadSource::DecodeAheadSource(
    RawlogSource source, ObservationBridge bridge, std::size_t points_ahead)
    : impl_(std::make_unique<Impl>(std::move(source), std::move(bridge), points_ahead))
{
}

DecodeAheadSource::~DecodeAheadSource() = default;

std::optional<DecodedInput> DecodeAheadSource::next()
{
  return impl_->next();
}
void DecodeAheadSource::stop()
{
  impl_->stop();
}

const std::vector<ReadProblem>& DecodeAheadSource::problems() const
{
  return impl_->source().problems();
}

const BridgeStatistics& DecodeAheadSource::statistics() const
{
  return impl_->statistics();
}

}  // namespace fastlio
