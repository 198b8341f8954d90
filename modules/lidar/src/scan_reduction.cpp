// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/scan_reduction.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace fastlio
{
namespace
{
// Multiples of the golden section, modulo one in 32-bit fixed point: the most even sequence there
// is.
constexpr std::uint32_t kGoldenSection = 0x9E3779B9U;
// Another irrational for the start of each scan, so that it is not a mere shift of the sequence.
constexpr std::uint32_t kScanStep = 0xB504F333U;
constexpr float kFixedPointOne = 4294967296.0F;

// Bins of a logarithmic histogram: exponent and the upper two bits of the mantissa, from 2^-16 m^2
// on.
constexpr int kMantissaBits = 2;
constexpr int kFirstExponent = 127 - 16;

std::size_t binOf(float squared_range, std::size_t bins)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &squared_range, sizeof bits);
  const auto bin =
      static_cast<std::int32_t>(bits >> (23 - kMantissaBits)) - (kFirstExponent << kMantissaBits);
  return static_cast<std::size_t>(std::clamp<std::int32_t>(bin, 0, static_cast<int>(bins) - 1));
}

/** Middle of a bin's squared ranges. */
float binValue(std::size_t bin)
{
  const int steps = 1 << kMantissaBits;
  const int exponent = static_cast<int>(bin) / steps - 16;
  const float mantissa =
      1.0F + (static_cast<float>(static_cast<int>(bin) % steps) + 0.5F) / static_cast<float>(steps);
  return std::ldexp(mantissa, exponent);
}
}  // namespace

void ScanReducer::gateRanges(
    const PointColumns& points, const ReductionLimits& limits, ScanSelection& selection)
{
  const float min2 = limits.min_range * limits.min_range;
  const float max2 = limits.max_range * limits.max_range;
  selection.dropped_invalid = selection.dropped_near = selection.dropped_far = 0;
  squared_ranges_.resize(points.size());
  counts_.fill(0);
  usable_ = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const float x = points.x[i], y = points.y[i], z = points.z[i];
    const float range2 = x * x + y * y + z * z;
    const bool usable = range2 >= min2 && range2 <= max2 && range2 > 0.0F;
    squared_ranges_[i] = usable ? range2 : 0.0F;
    if (usable)
    {
      ++counts_[binOf(range2, kBins)];
      ++usable_;
    }
    else if (!(range2 > 0.0F) || !std::isfinite(range2))
      ++selection.dropped_invalid;
    else
      ++(range2 < min2 ? selection.dropped_near : selection.dropped_far);
  }
}

float ScanReducer::densityFactor(std::size_t target) const
{
  // Bins from the farthest on are kept whole while the rest can be thinned to meet the target.
  double rest_sum = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin)
    rest_sum += static_cast<double>(counts_[bin]) * static_cast<double>(binValue(bin));
  double whole = 0.0;
  for (std::size_t bin = kBins; bin-- > 0;)
  {
    const double factor = (static_cast<double>(target) - whole) / std::max(rest_sum, 1e-30);
    if (factor * static_cast<double>(binValue(bin)) <= 1.0) return static_cast<float>(factor);
    whole += counts_[bin];
    rest_sum -= static_cast<double>(counts_[bin]) * static_cast<double>(binValue(bin));
  }
  return kFixedPointOne;
}

void ScanReducer::select(
    const PointColumns& points, const ReductionLimits& limits, ScanSelection& selection)
{
  gateRanges(points, limits, selection);
  selection.indices.clear();
  const bool keep_all = limits.target_points == 0 || usable_ <= limits.target_points;
  const float factor =
      keep_all ? kFixedPointOne : densityFactor(limits.target_points) * kFixedPointOne;
  const std::uint32_t start = ++scan_ * kScanStep;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::uint32_t draw = start + static_cast<std::uint32_t>(i) * kGoldenSection;
    const float range2 = squared_ranges_[i];
    if (range2 > 0.0F && (keep_all || static_cast<float>(draw) < factor * range2))
      selection.indices.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace fastlio
