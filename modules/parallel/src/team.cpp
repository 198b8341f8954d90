// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "team.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace fastlio
{
namespace
{
// Longer than the steps of a scan that run on one thread, short against the time between scans.
constexpr std::chrono::microseconds kPatience{200};
// Looks before other threads get a chance.
constexpr int kLooks = 64;

void pauseProcessor()
{
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

/** Looks until it sees what it waits for; gives way to other threads between the looks. */
template <typename Condition>
void waitActively(const Condition& condition)
{
  for (;;)
  {
    for (int i = 0; i < kLooks; ++i)
    {
      if (condition()) return;
      pauseProcessor();
    }
    std::this_thread::yield();
  }
}
}  // namespace

Team::Team(std::size_t helpers) : shares_(helpers + 1)
{
  helpers_.reserve(helpers);
  try
  {
    while (helpers_.size() < helpers)
      helpers_.emplace_back([this, member = helpers_.size() + 1] { help(member); });
  }
  catch (const std::system_error&)
  {
    // The work is done by those that there are.
  }
}

Team::~Team()
{
  {
    const std::lock_guard lock(sleep_mutex_);
    stop_ = true;
  }
  wake_up_.notify_all();
  for (std::thread& helper : helpers_)
    helper.join();
}

void Team::keepFailure()
{
  for (Share& share : shares_)
    share.next = share.end;  // nobody begins another chunk
  const std::lock_guard lock(failure_mutex_);
  if (!failure_) failure_ = std::current_exception();
}

void Team::share(std::size_t count)
{
  const std::size_t members = shares_.size();
  for (std::size_t i = 0; i < members; ++i)
  {
    shares_[i].next = i * count / members;
    shares_[i].end = (i + 1) * count / members;
  }
}

/** First the member's own share, then what is left of the others'. */
void Team::takeChunks(std::size_t member)
{
  try
  {
    for (std::size_t i = 0; i < shares_.size(); ++i)
    {
      Share& share = shares_[(member + i) % shares_.size()];
      for (std::size_t chunk = share.next++; chunk < share.end; chunk = share.next++)
        call_(context_, chunk);
    }
  }
  catch (...)
  {
    keepFailure();
  }
}

/** Waits for a loop or task that is newer than \a seen. False: the team ends. */
bool Team::awaitNews(std::size_t seen)
{
  const auto news = [&] { return stop_ || news_ != seen; };
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  waitActively([&] { return news() || std::chrono::steady_clock::now() > deadline; });
  if (!news())
  {
    std::unique_lock lock(sleep_mutex_);
    ++sleeping_;
    wake_up_.wait(lock, news);
    --sleeping_;
  }
  return !stop_;
}

bool Team::join()
{
  std::uint32_t gate = gate_;
  while ((gate & kOpen) != 0)
    if (gate_.compare_exchange_weak(gate, gate + 1)) return true;
  return false;
}

void Team::help(std::size_t member)
{
  std::size_t seen = 0;
  while (awaitNews(seen))
  {
    seen = news_;
    if (takeTask()) doTask();
    if (!join()) continue;
    takeChunks(member);
    --gate_;
  }
}

void Team::announce()
{
  ++news_;
  // Either a helper on its way to sleep sees the new number, or it is seen here.
  if (sleeping_ == 0) return;
  const std::lock_guard lock(sleep_mutex_);
  wake_up_.notify_all();
}

bool Team::takeTask()
{
  TaskState state = TaskState::Offered;
  return task_state_.compare_exchange_strong(state, TaskState::Taken);
}

void Team::doTask()
{
  try
  {
    task_(task_context_);
  }
  catch (...)
  {
    task_failure_ = std::current_exception();
  }
  task_state_ = TaskState::Done;
}

void Team::awaitTask()
{
  waitActively([&] { return task_state_ == TaskState::Done; });
  task_state_ = TaskState::None;
}

void Team::offer(TaskCall call, const void* context)
{
  task_ = call;
  task_context_ = context;
  task_state_ = TaskState::Offered;
  announce();
}

void Team::settle()
{
  if (takeTask()) doTask();
  awaitTask();
  if (task_failure_) std::rethrow_exception(std::exchange(task_failure_, nullptr));
}

void Team::withdraw() noexcept
{
  if (takeTask()) task_state_ = TaskState::Done;
  awaitTask();
  task_failure_ = nullptr;
}

void Team::loop(std::size_t count, ChunkCall call, const void* context)
{
  call_ = call;
  context_ = context;
  share(count);
  gate_ = kOpen;
  announce();
  takeChunks(0);
  gate_ &= ~kOpen;
  waitActively([&] { return gate_ == 0; });
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

}  // namespace fastlio
