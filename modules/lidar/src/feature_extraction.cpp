// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/feature_extraction.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastlio
{
namespace
{
// The smoothness is 0 on a plane and 0.7 at a right angle; what lies between is neither feature.
constexpr double kMaxPlanarSmoothness = 0.2, kMinEdgeSmoothness = 0.4;
// A mean of fewer neighbours on a side is as noisy as the points.
constexpr std::size_t kMinNeighbors = 3;
// Of the line of unit beams: beyond, the beam itself turns and bends a line on a flat wall.
constexpr double kMaxBeamTurn = 0.1;
// Neighbours farther apart lie on different things [m].
constexpr double kMaxSpacing = 1.0;
// Noise of two ranges, and what rough surfaces add, beyond the jump that the incidence allows [m].
constexpr double kRangeJump = 0.1;

/** Whether a surface that runs along \a direction is met at no less than the least incidence. */
bool isWellMet(const Vec3& direction, const Vec3& beam, double max_cosine)
{
  return std::abs(direction.dot(beam)) <= max_cosine * direction.norm();
}

/** The smoothness c of the file's head, from the vectors to the neighbours' centroids; infinite
 * where the points coincide or the line turns back on itself: no surface does that. */
double smoothnessOf(const Vec3& left, const Vec3& right)
{
  const Vec3 chord = right - left;
  const double distance = 0.5 * (left.norm() + right.norm());
  if (!(chord.norm() > 1e-3 * distance)) return std::numeric_limits<double>::infinity();
  return left.cross(chord).norm() / (chord.norm() * distance);
}
}  // namespace

void FeatureExtractor::gateRanges(
    const PointColumns& points, const FeatureLimits& limits, ScanFeatures& features)
{
  const float min2 = limits.min_range * limits.min_range;
  const float max2 = limits.max_range * limits.max_range;
  usable_.clear();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const float x = points.x[i], y = points.y[i], z = points.z[i];
    const float range2 = x * x + y * y + z * z;
    if (range2 >= min2 && range2 <= max2 && range2 > 0.0F)
      usable_.push_back(static_cast<std::uint32_t>(i));
    else if (!(range2 > 0.0F) || !std::isfinite(range2))
      ++features.dropped_invalid;
    else
      ++(range2 < min2 ? features.dropped_near : features.dropped_far);
  }
}

void FeatureExtractor::loadLine(const PointColumns& points, std::size_t line)
{
  const std::size_t n = lines_.begin[line + 1] - lines_.begin[line];
  const auto first = lines_.order.begin() + lines_.begin[line];
  index_.assign(first, first + static_cast<std::ptrdiff_t>(n));
  point_.resize(n);
  range_.resize(n);
  beam_.resize(n);
  point_sum_.assign(n + 1, Vec3::Zero());
  beam_sum_.assign(n + 1, Vec3::Zero());
  for (std::size_t k = 0; k < n; ++k)
  {
    point_[k] = {points.x[index_[k]], points.y[index_[k]], points.z[index_[k]]};
    range_[k] = point_[k].norm();
    beam_[k] = point_[k] / range_[k];
    point_sum_[k + 1] = point_sum_[k] + point_[k];
    beam_sum_[k + 1] = beam_sum_[k] + beam_[k];
  }
  window_.assign(n, {});
  shape_.assign(n, {});
}

/** Whether points k - 1 and k of the line lie on one surface. */
bool FeatureExtractor::isConnected(std::size_t k) const
{
  const double beam_gap2 = (beam_[k] - beam_[k - 1]).squaredNorm();
  if (beam_gap2 > bounds_.beam_chord * bounds_.beam_chord) return false;
  if ((point_[k] - point_[k - 1]).squaredNorm() > kMaxSpacing * kMaxSpacing) return false;
  const double step = std::min(range_[k - 1], range_[k]) * std::sqrt(beam_gap2);
  return std::abs(range_[k] - range_[k - 1]) <= step * bounds_.jump_per_step + kRangeJump;
}

bool FeatureExtractor::isComplete(
    std::size_t i, std::size_t outermost, const FeatureLimits& limits) const
{
  const std::size_t neighbors = i > outermost ? i - outermost : outermost - i;
  return neighbors >= kMinNeighbors &&
         (point_[outermost] - point_[i]).squaredNorm() >= limits.half_width * limits.half_width;
}

// Both walks start where the window of the point before ended, so that a line costs time in
// proportion to its points.
std::size_t FeatureExtractor::windowFirst(
    std::size_t i, std::size_t begin, std::size_t guess, const FeatureLimits& limits) const
{
  std::size_t first = std::min(guess, i);
  while (first < i && isComplete(i, first + 1, limits))
    ++first;
  while (first > begin && !isComplete(i, first, limits))
    --first;
  return first;
}

std::size_t FeatureExtractor::windowLast(
    std::size_t i, std::size_t end, std::size_t guess, const FeatureLimits& limits) const
{
  std::size_t last = std::max(guess, i);
  while (last > i && isComplete(i, last - 1, limits))
    --last;
  while (last + 1 < end && !isComplete(i, last, limits))
    ++last;
  return last;
}

FeatureExtractor::Sides FeatureExtractor::sidesOf(
    std::size_t i, const Window& window, const std::vector<Vec3>& values,
    const std::vector<Vec3>& sums)
{
  return {
      (sums[i] - sums[window.first]) / static_cast<double>(i - window.first) - values[i],
      (sums[window.last + 1] - sums[i + 1]) / static_cast<double>(window.last - i) - values[i]};
}

FeatureExtractor::Shape FeatureExtractor::shapeOf(std::size_t i, const Window& window) const
{
  const Sides beams = sidesOf(i, window, beam_, beam_sum_);
  if (smoothnessOf(beams.left, beams.right) > kMaxBeamTurn) return {};
  const Sides points = sidesOf(i, window, point_, point_sum_);
  Shape shape;
  shape.smoothness = smoothnessOf(points.left, points.right);
  shape.usable = shape.smoothness <= 1.0 && isWellMet(points.left, beam_[i], bounds_.max_cosine) &&
                 isWellMet(points.right, beam_[i], bounds_.max_cosine);
  return shape;
}

void FeatureExtractor::describePiece(
    std::size_t begin, std::size_t end, const FeatureLimits& limits)
{
  std::size_t first = begin, last = begin;
  for (std::size_t i = begin; i < end; ++i)
  {
    first = windowFirst(i, begin, first, limits);
    last = windowLast(i, end, last, limits);
    const bool complete = isComplete(i, first, limits) && isComplete(i, last, limits);
    window_[i] = {first, last, complete};
    if (complete) shape_[i] = shapeOf(i, window_[i]);
  }
}

/** Whether no usable point among the neighbours is as sharp; the first one of equals wins. */
bool FeatureExtractor::isSharpest(std::size_t i) const
{
  const double c = shape_[i].smoothness;
  for (std::size_t k = window_[i].first; k <= window_[i].last; ++k)
  {
    if (!shape_[k].usable || k == i) continue;
    if (shape_[k].smoothness > c || (shape_[k].smoothness == c && k < i)) return false;
  }
  return true;
}

void FeatureExtractor::classifyLine(ScanFeatures& features) const
{
  for (std::size_t i = 0; i < index_.size(); ++i)
  {
    if (!shape_[i].usable) continue;
    if (shape_[i].smoothness <= kMaxPlanarSmoothness)
      features.planar.push_back(index_[i]);
    else if (shape_[i].smoothness >= kMinEdgeSmoothness && isSharpest(i))
      features.edges.push_back(index_[i]);
  }
}

void FeatureExtractor::extract(
    const PointColumns& points, const FeatureLimits& limits, ScanFeatures& features)
{
  features.planar.clear();
  features.edges.clear();
  features.dropped_invalid = features.dropped_near = features.dropped_far = 0;
  bounds_ = {
      2.0 * std::sin(0.5 * limits.max_beam_gap), 1.0 / std::tan(limits.min_incidence),
      std::cos(limits.min_incidence)};
  gateRanges(points, limits, features);
  features.line_order = sorter_.sort(points, usable_, limits.line_order, lines_);
  for (std::size_t line = 0; line < lines_.count(); ++line)
  {
    loadLine(points, line);
    std::size_t begin = 0;
    for (std::size_t k = 1; k <= index_.size(); ++k)
    {
      if (k < index_.size() && isConnected(k)) continue;
      describePiece(begin, k, limits);
      begin = k;
    }
    classifyLine(features);
  }
  std::sort(features.planar.begin(), features.planar.end());
  std::sort(features.edges.begin(), features.edges.end());
}

}  // namespace fastlio
