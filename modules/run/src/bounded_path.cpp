// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/run/bounded_path.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
const Vec3 kBreak = Vec3::Constant(std::nan(""));
}

void BoundedPath::add(std::int64_t stamp_ns, const Vec3& position)
{
  gap_ = gap_ || (last_ && toSeconds(stamp_ns - last_ns_) > gap_s_);
  last_ = position;
  last_ns_ = stamp_ns;
  if (seen_++ % stride_ == 0) path_.push_back({stamp_ns, position, std::exchange(gap_, false)});
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
    path_[i] = {path_[2 * i].stamp_ns, path_[2 * i].position, is_after_gap};
  }
  path_.resize(kept);
  stride_ *= 2;
}

std::vector<BoundedPath::Place> BoundedPath::places() const
{
  std::vector<Place> places = path_;
  if (last_ && (places.empty() || places.back().stamp_ns != last_ns_))
    places.push_back({last_ns_, *last_, gap_});
  return places;
}

std::vector<Vec3> BoundedPath::positions() const
{
  std::vector<Vec3> positions;
  for (const Place& place : places())
  {
    if (place.is_after_gap) positions.push_back(kBreak);
    positions.push_back(place.position);
  }
  return positions;
}

std::vector<Vec3> BoundedPath::positionsWithin(const std::vector<UntrustedStretch>& stretches) const
{
  std::vector<Vec3> positions;
  const UntrustedStretch* previous = nullptr;
  for (const Place& place : places())
  {
    const auto around = std::find_if(
        stretches.begin(), stretches.end(),
        [&](const UntrustedStretch& stretch)
        { return stretch.begin_ns <= place.stamp_ns && place.stamp_ns <= stretch.end_ns; });
    const UntrustedStretch* stretch = around == stretches.end() ? nullptr : &*around;
    const bool goes_on = stretch == std::exchange(previous, stretch) && !place.is_after_gap;
    if (stretch == nullptr) continue;
    if (!goes_on && !positions.empty()) positions.push_back(kBreak);
    positions.push_back(place.position);
  }
  return positions;
}

}  // namespace fastlio
