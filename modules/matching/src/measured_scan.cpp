// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "information_lanes.h"
#include "measurement_lanes.h"
#include <fastlio/matching/measured_scan.h>

namespace fastlio
{
void MeasuredScan::measure(
    const Workers& workers, const Pose& T_world_scan, const BodyPoints& body,
    const std::vector<PlaneMatch>& matches, const ResidualModel& model)
{
  const std::size_t chunks = Workers::chunks(body.size());
  makeRoom(chunks_, chunks);
  makeRoom(blocks_, chunks * kBlocksPerChunk);
  chunks_.resize(chunks);
  blocks_.resize(chunks * kBlocksPerChunk);
  workers.forEachChunk(
      body.size(),
      [&](std::size_t chunk, std::size_t first, std::size_t last)
      {
        const std::size_t begin = chunk * kBlocksPerChunk;
        std::size_t next = begin;
        InformationLanes sums;
        forMatches<kLanes>(
            body, matches, first, last,
            [&](const MatchLanes<kLanes>& lanes, std::size_t filled)
            {
              MeasurementBlock& block = blocks_[next++];
              fastlio::measure(T_world_scan, lanes, filled, model, block);
              sums.add(block);
            });
        chunks_[chunk] = {next - begin, sums.sums()};
      });
  sums_ = {};
  for (const Chunk& chunk : chunks_)
    addSums(sums_, chunk.sums);
}

}  // namespace fastlio
