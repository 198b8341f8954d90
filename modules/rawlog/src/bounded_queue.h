// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bounded_queue.h Hands items from one thread to another. */
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace fastlio
{
/** First in, first out. It holds items of a weight of at most \a capacity together, or one heavier
 * item. After close() nothing more goes in. */
template <typename Item>
class BoundedQueue
{
 public:
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

  /** Waits for room. False: the queue is closed, the item is lost. */
  bool push(Item item, std::size_t weight)
  {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [&] { return closed_ || items_.empty() || weight_ + weight <= capacity_; });
    if (closed_) return false;
    items_.push_back({std::move(item), weight});
    weight_ += weight;
    lock.unlock();
    filled_.notify_one();
    return true;
  }

  /** Waits for an item. Nothing: the queue is closed and empty. */
  std::optional<Item> pop()
  {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [&] { return closed_ || !items_.empty(); });
    if (items_.empty()) return std::nullopt;
    std::optional<Item> item(std::move(items_.front().item));
    weight_ -= items_.front().weight;
    items_.pop_front();
    lock.unlock();
    room_.notify_one();
    return item;
  }

  void close()
  {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    filled_.notify_all();
    room_.notify_all();
  }

  void clear()
  {
    const std::lock_guard lock(mutex_);
    items_.clear();
    weight_ = 0;
  }

 private:
  struct Weighed
  {
    Item item;
    std::size_t weight;
  };

  std::size_t capacity_;
  std::size_t weight_ = 0;  // of all items
  std::mutex mutex_;
  std::condition_variable room_, filled_;
  std::deque<Weighed> items_;
  bool closed_ = false;
};

}  // namespace fastlio
