// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/run/bounded_path.h>

#include <cmath>
#include <utility>

namespace fastlio
{
void BoundedPath::add(std::int64_t stamp_ns, const Vec3& position)
{
  gap_ = gap_ || (last_ && toSeconds(stamp_ns - last_ns_) > gap_s_);
  last_ = position;
  last_ns_ = stamp_ns;
  if (seen_++ % stride_ == 0) path_.push_back({position, std::exchange(gap_, false)});
  if (path_.size() > most_) leaveOutEverySecond();
}

/** A gap before one that is left out is before the next one. */
void BoundedPath::leaveOutEverySecond()
{
  const bool ends_in_left_out = path_.size() % 2 == 0;
  gap_ = gap_ || (ends_in_left_out && path_.back().is_after_gap);
  const std::size_t kept = (path_.size() + 1) / 2;
  for (std::size_t i = 1; i < kept; ++i)
  {
    const bool is_after_gap = path_[2 * i].is_after_gap || path_[2 * i - 1].is_after_gap;
    path_[i] = {path_[2 * i].position, is_after_gap};
  }
  path_.resize(kept);
  stride_ *= 2;
}

std::vector<Vec3> BoundedPath::positions() const
{
  std::vector<Vec3> positions;
  positions.reserve(path_.size() + 1);
  const auto add = [&positions](const Vec3& position, bool is_after_gap)
  {
    if (is_after_gap) positions.emplace_back(Vec3::Constant(std::nan("")));
    positions.push_back(position);
  };
  for (const Place& place : path_)
    add(place.position, place.is_after_gap);
  if (last_ && (positions.empty() || positions.back() != *last_)) add(*last_, gap_);
  return positions;
}

}  // namespace fastlio
