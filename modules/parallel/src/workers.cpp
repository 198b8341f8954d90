// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "team.h"
#include <fastlio/parallel/workers.h>

#include <algorithm>
#include <thread>

namespace fastlio
{
namespace
{
/** How many helpers the calling thread gets. */
std::size_t helpersFor(int threads)
{
  // Processors that this process may run on; 0 when that is not known.
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  return (threads > 0 ? static_cast<std::size_t>(threads) : cores) - 1;
}
}  // namespace

Workers::Workers(int threads)
{
  if (const std::size_t helpers = helpersFor(threads)) team_ = std::make_unique<Team>(helpers);
}

Workers::~Workers() = default;

void Workers::loop(std::size_t n, std::size_t chunk_size, ChunkCall call, const void* body) const
{
  const auto run = [&](std::size_t chunk)
  { call(body, chunk, chunk * chunk_size, std::min(n, (chunk + 1) * chunk_size)); };
  const std::size_t count = chunks(n, chunk_size);
  if (team_ && count > 1)
  {
    const auto run_chunk = [](const void* context, std::size_t chunk)
    { (*static_cast<decltype(&run)>(context))(chunk); };
    team_->loop(count, run_chunk, &run);
    return;
  }
  for (std::size_t chunk = 0; chunk < count; ++chunk)
    run(chunk);
}

void Workers::together(const Call& task, const Call& main) const
{
  if (!team_)
  {
    main.function(main.callable);
    task.function(task.callable);
    return;
  }
  team_->offer(task.function, task.callable);
  try
  {
    main.function(main.callable);
  }
  catch (...)
  {
    team_->withdraw();
    throw;
  }
  team_->settle();
}

}  // namespace fastlio
