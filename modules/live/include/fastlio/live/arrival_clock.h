// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file arrival_clock.h Times of a sensor's own clock as times of this machine. */
#pragma once

#include <cstdint>
#include <optional>

namespace fastlio
{
/** Of a clock that begins again at zero each hour, as Velodyne's does.
 *
 * Packets come late by a varying time, and never early. So the least delay so far gives the offset
 * between both clocks, up to the time that a packet needs at least. Clocks drift apart by less than
 * 100 ppm: the least delay is allowed to grow by that. */
class ArrivalClock
{
 public:
  /** When this machine's clock showed it. A sensor that starts again, or whose clock jumps by more
   * than a second, starts a new offset.
   * \param sensor_ns of the sensor's clock; times of a sensor grow from call to call
   * \param arrival_ns when the packet arrived, of this machine's clock */
  [[nodiscard]] std::int64_t stampOf(std::int64_t sensor_ns, std::int64_t arrival_ns);

 private:
  std::int64_t wrapped_ns_ = 0;          // whole turns of the sensor's clock
  std::optional<std::int64_t> last_ns_;  // of the sensor's clock, without the turns
  std::int64_t offset_ns_ = 0;           // this machine's clock less the sensor's
  std::int64_t offset_since_ns_ = 0;     // arrival at which the offset was found
};

}  // namespace fastlio
