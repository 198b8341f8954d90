// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bounded_queue.h"
#include <fastlio/rawlog/decode_ahead_source.h>
#include <fastlio/sensors/conversions.h>

#include <stdexcept>
#include <utility>

namespace fastlio
{
DecodeAheadSource::DecodeAheadSource(
    RawlogSource source, ObservationBridge bridge, std::size_t points_ahead)
    : source_(std::move(source)),
      bridge_(std::move(bridge)),
      queue_(std::make_unique<BoundedQueue<DecodedInput>>(points_ahead)),
      thread_([this] { run(); })
{
}

DecodeAheadSource::~DecodeAheadSource()
{
  stop();
}

std::optional<DecodedInput> DecodeAheadSource::next()
{
  auto input = queue_->pop();
  if (!input) join();
  if (!input && failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return input;
}

void DecodeAheadSource::stop()
{
  queue_->close();
  join();
  queue_->clear();
}

const std::vector<ReadProblem>& DecodeAheadSource::problems() const
{
  requireStopped();
  return source_.problems();
}

const BridgeStatistics& DecodeAheadSource::statistics() const
{
  requireStopped();
  return statistics_;
}

void DecodeAheadSource::run()
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
  queue_->close();
}

// False: nobody wants more.
bool DecodeAheadSource::deliver(const mrpt::obs::CObservation& observation)
{
  BridgeOutput output = bridge_.convert(observation);
  if (const auto* sample = std::get_if<ImuSample>(&output))
    if (!queue_->push({*sample, source_.progress()}, 1)) return false;
  if (auto* scan = std::get_if<LidarScan>(&output))
  {
    if (bridge_.selection().further_lidars.empty()) return deliver(std::move(*scan));
    merger_.add(bridge_.lidarOf(observation).value_or(0), std::move(*scan));
  }
  while (auto scan = merger_.next(toNanoseconds(observation.timestamp)))
    if (!deliver(std::move(*scan))) return false;
  return true;
}

bool DecodeAheadSource::deliver(LidarScan scan)
{
  const std::size_t points = scan.points.size();
  return queue_->push({std::move(scan), source_.progress()}, points);
}

void DecodeAheadSource::join()
{
  if (!thread_.joinable()) return;
  thread_.join();
  statistics_ = bridge_.statistics();
  statistics_.points_left_out = merger_.pointsLeftOut();
}

// The thread's work is visible to the others only once it has been joined.
void DecodeAheadSource::requireStopped() const
{
  if (thread_.joinable())
    throw std::logic_error(
        "DecodeAheadSource: ask after next() has returned nothing, or after stop().");
}

}  // namespace fastlio
