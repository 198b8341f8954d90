// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/parallel/workers.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace fastlio
{
class Workers::Arena : public tbb::task_arena
{
 public:
  using tbb::task_arena::task_arena;
};

Workers::Workers(int threads)
{
  if (threads != 1)
    arena_ = std::make_unique<Arena>(
        threads > 0 ? threads : static_cast<int>(tbb::task_arena::automatic));
}

Workers::~Workers() = default;

void Workers::loop(std::size_t n, std::size_t chunk_size, ChunkCall call, const void* body) const
{
  const auto run = [&](std::size_t chunk)
  { call(body, chunk, chunk * chunk_size, std::min(n, (chunk + 1) * chunk_size)); };
  const std::size_t count = chunks(n, chunk_size);
  if (!arena_ || count < 2)
  {
    for (std::size_t chunk = 0; chunk < count; ++chunk)
      run(chunk);
    return;
  }
  arena_->execute([&] { tbb::parallel_for(std::size_t{0}, count, run); });
}

}  // namespace fastlio
