// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/run/bounded_path.h>

#include <cmath>

namespace fastlio
{
void BoundedPath::add(std::int64_t stamp_ns, const Vec3& position)
{
  const bool after_gap = last_ && toSeconds(stamp_ns - last_ns_) > gap_s_;
  last_ = position;
  last_ns_ = stamp_ns;
  if (after_gap) path_.emplace_back(Vec3::Constant(std::nan("")));
  if (seen_++ % stride_ == 0) path_.push_back(position);
  if (path_.size() <= most_) return;
  for (std::size_t i = 0; 2 * i < path_.size(); ++i)
    path_[i] = path_[2 * i];
  path_.resize((path_.size() + 1) / 2);
  stride_ *= 2;
}

std::vector<Vec3> BoundedPath::positions() const
{
  std::vector<Vec3> positions = path_;
  if (last_ && (positions.empty() || positions.back() != *last_)) positions.push_back(*last_);
  return positions;
}

}  // namespace fastlio
