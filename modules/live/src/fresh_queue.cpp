// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/live/fresh_queue.h>

#include <mrpt/obs/CObservationIMU.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostSamples = 100'000;  // minutes of any IMU, some tens of megabytes

bool isSample(const mrpt::obs::CObservation::Ptr& observation)
{
  return dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get()) != nullptr;
}
}  // namespace

void FreshQueue::dropOldest(bool samples)
{
  const auto oldest = std::find_if(
      waiting_.begin(), waiting_.end(),
      [samples](const auto& observation) { return isSample(observation) == samples; });
  waiting_.erase(oldest);
}

void FreshQueue::push(mrpt::obs::CObservation::Ptr observation)
{
  if (!observation) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (closed_) return;
    const bool sample = isSample(observation);
    waiting_.push_back(std::move(observation));
    if (sample)
      ++counts_.samples;
    else
      ++counts_.scans, ++waiting_scans_;
    if (waiting_scans_ > most_scans_)
    {
      dropOldest(false);
      --waiting_scans_;
      ++counts_.dropped_scans;
    }
    if (waiting_.size() - waiting_scans_ > kMostSamples)
    {
      dropOldest(true);
      ++counts_.dropped_samples;
    }
  }
  changed_.notify_one();
}

mrpt::obs::CObservation::Ptr FreshQueue::pop()
{
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
  if (waiting_.empty()) return nullptr;
  auto observation = std::move(waiting_.front());
  waiting_.pop_front();
  if (!isSample(observation)) --waiting_scans_;
  return observation;
}

void FreshQueue::close()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

FreshQueueCounts FreshQueue::counts() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

}  // namespace fastlio
