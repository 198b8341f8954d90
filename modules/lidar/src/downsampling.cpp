// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/downsampling.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

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
// Times any squared range this exceeds every draw.
constexpr float kKeepAll = std::numeric_limits<float>::infinity();

// Bins of a logarithmic histogram: exponent and the upper two bits of the mantissa, from 2^-16 m^2
// on.
constexpr int kMantissaBits = 2;
constexpr int kFirstExponent = 127 - 16;

// RMS range from where on lines of lasers that are 5 deg apart are a metre apart [m].
constexpr double kSparseRange = 12.0;
// Every so many-th point is enough for that: a prime, or some lasers would never count.
constexpr std::size_t kSampled = 7;

/** Some points on their way through the gates: short loops over columns, of which the compiler
 * makes vector instructions. */
struct Block
{
  static constexpr std::size_t kSize = 256;
  float squared_range[kSize];
  std::uint32_t bin[kSize];
};

void squareRanges(const PointColumns& points, std::size_t first, std::size_t n, Block& block)
{
  const float *x = &points.x[first], *y = &points.y[first], *z = &points.z[first];
  for (std::size_t i = 0; i < n; ++i)
    block.squared_range[i] = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
}

bool areFar(const PointColumns& points, const DownsamplingLimits& limits)
{
  const float least = limits.min_range * limits.min_range;
  const float most = limits.max_range * limits.max_range;
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); i += kSampled)
  {
    const float x = points.x[i], y = points.y[i], z = points.z[i];
    const float range2 = x * x + y * y + z * z;
    if (!std::isfinite(range2) || range2 < least || range2 > most) continue;
    squares += static_cast<double>(range2);
    ++count;
  }
  return squares > kSparseRange * kSparseRange * static_cast<double>(count);
}

/** Bins of squared ranges; a 0 falls into the first one. */
void findBins(const float* squared_ranges, std::size_t n, std::size_t bins, Block& block)
{
  // Clamped as numbers, which is a vector instruction, while clamping bins is none.
  const auto valueAt = [](std::size_t bin)
  {
    const auto bits = (static_cast<std::uint32_t>(bin) + (kFirstExponent << kMantissaBits))
                      << (23 - kMantissaBits);
    float value = 0.0F;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  const float low = valueAt(0), high = valueAt(bins - 1);
  for (std::size_t i = 0; i < n; ++i)
  {
    const float at_least = squared_ranges[i] < low ? low : squared_ranges[i];
    const float clamped = high < at_least ? high : at_least;
    std::uint32_t bits = 0;
    std::memcpy(&bits, &clamped, sizeof bits);
    block.bin[i] = (bits >> (23 - kMantissaBits)) - (kFirstExponent << kMantissaBits);
  }
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

Downsampler::Downsampler(std::shared_ptr<const Workers> workers) : workers_(std::move(workers)) {}

Downsampler::Ranges Downsampler::gateRanges(
    const PointColumns& points, const DownsamplingLimits& limits, std::size_t first,
    std::size_t last)
{
  // Nothing is kept of a range of 0, wherever the near limit is.
  const float min2 =
      std::max(limits.min_range * limits.min_range, std::numeric_limits<float>::denorm_min());
  const float max2 = limits.max_range * limits.max_range;
  Ranges ranges;
  // Neighbours mostly fall into the same bin, and a counter has to be written before it is read.
  constexpr std::size_t kCounters = 4;
  std::array<std::array<std::uint32_t, kBins>, kCounters> counts{};
  Block block;
  for (std::size_t begin = first; begin < last; begin += Block::kSize)
  {
    const std::size_t n = std::min(Block::kSize, last - begin);
    squareRanges(points, begin, n, block);
    float* kept = &areas_[begin];
    std::uint32_t usable = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      const float range2 = block.squared_range[i];
      const std::uint32_t passes = (range2 >= min2 ? 1U : 0U) & (range2 <= max2 ? 1U : 0U);
      kept[i] = passes != 0 ? range2 : 0.0F;
      usable += passes;
    }
    for (std::size_t i = 0; i < n && usable < n; ++i)
      if (kept[i] == 0.0F) ranges.countDropped(block.squared_range[i], min2);
    if (sparse_lines_) ranges.area_excess += weighByWidth(&points.ring[begin], n, kept);
    findBins(kept, n, kBins, block);
    for (std::size_t i = 0; i < n; ++i)
      ++counts[i % kCounters][block.bin[i]];
    ranges.counts[0] -= static_cast<std::uint32_t>(n) - usable;  // they stand there as 0
    ranges.usable += usable;
  }
  for (const auto& counter : counts)
    for (std::size_t bin = 0; bin < kBins; ++bin)
      ranges.counts[bin] += counter[bin];
  return ranges;
}

/** Times the width of each laser.
 * \return by how much their sum has grown */
double Downsampler::weighByWidth(const std::uint16_t* rings, std::size_t n, float* areas) const
{
  double excess = 0.0;
  for (std::size_t i = 0; i < n; ++i)
  {
    const float area = areas[i] * widths_.of(rings[i]);
    excess += static_cast<double>(area) - static_cast<double>(areas[i]);
    areas[i] = area;
  }
  return excess;
}

void Downsampler::Ranges::countDropped(float squared_range, float least_squared_range)
{
  if (!(squared_range > 0.0F) || !std::isfinite(squared_range))
    ++invalid;
  else
    ++(squared_range < least_squared_range ? near : far);
}

Downsampler::Ranges Downsampler::gateRanges(
    const PointColumns& points, const DownsamplingLimits& limits)
{
  areas_.resize(points.size());
  chunk_ranges_.resize(Workers::chunks(points.size(), kChunk));
  workers_->forEachChunk(
      points.size(), kChunk,
      [&](std::size_t chunk, std::size_t first, std::size_t last)
      { chunk_ranges_[chunk] = gateRanges(points, limits, first, last); });
  Ranges total;
  for (const Ranges& part : chunk_ranges_)
  {
    for (std::size_t bin = 0; bin < kBins; ++bin)
      total.counts[bin] += part.counts[bin];
    total.usable += part.usable;
    total.invalid += part.invalid;
    total.near += part.near;
    total.far += part.far;
    total.area_excess += part.area_excess;
  }
  return total;
}

std::size_t Downsampler::targetOf(const Ranges& ranges, const DownsamplingLimits& limits)
{
  if (limits.wide_points <= limits.target_points || ranges.usable == 0) return limits.target_points;
  double squares = -ranges.area_excess;
  for (std::size_t bin = 0; bin < kBins; ++bin)
    squares += static_cast<double>(ranges.counts[bin]) * static_cast<double>(binValue(bin));
  const double wide =
      static_cast<double>(limits.wide_range) * static_cast<double>(limits.wide_range);
  const double growth = squares / (wide * static_cast<double>(ranges.usable));
  const double target = static_cast<double>(limits.target_points) * std::max(growth, 1.0);
  return static_cast<std::size_t>(std::min(target, static_cast<double>(limits.wide_points)));
}

float Downsampler::densityFactor(const Ranges& ranges, std::size_t target)
{
  // Bins from the farthest on are kept whole while the rest can be thinned to meet the target.
  double rest_sum = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin)
    rest_sum += static_cast<double>(ranges.counts[bin]) * static_cast<double>(binValue(bin));
  double whole = 0.0;
  for (std::size_t bin = kBins; bin-- > 0;)
  {
    const double factor = (static_cast<double>(target) - whole) / std::max(rest_sum, 1e-30);
    if (factor * static_cast<double>(binValue(bin)) <= 1.0) return static_cast<float>(factor);
    whole += ranges.counts[bin];
    rest_sum -= static_cast<double>(ranges.counts[bin]) * static_cast<double>(binValue(bin));
  }
  return kKeepAll;
}

/** Draws for the points [first, last); the chosen ones stand at kept_[first] and after it. */
std::size_t Downsampler::keep(float factor, std::size_t first, std::size_t last)
{
  std::uint32_t chosen[Block::kSize];
  std::size_t kept = 0;
  for (std::size_t begin = first; begin < last; begin += Block::kSize)
  {
    const std::size_t n = std::min(Block::kSize, last - begin);
    const float* areas = &areas_[begin];
    std::uint32_t draw = scan_ * kScanStep + static_cast<std::uint32_t>(begin) * kGoldenSection;
    for (std::size_t i = 0; i < n; ++i, draw += kGoldenSection)
    {
      // The halves of a draw are exact, and their sum is rounded once, as the draw itself would be.
      const auto high = static_cast<float>(static_cast<std::int32_t>(draw >> 16U));
      const auto low = static_cast<float>(static_cast<std::int32_t>(draw & 0xFFFFU));
      // No draw is below a range of 0, not even where the factor is infinite.
      chosen[i] = high * 65536.0F + low < factor * areas[i] ? 1U : 0U;
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      // Written always, counted when chosen: no branch that depends on the draw.
      kept_[first + kept] = static_cast<std::uint32_t>(begin + i);
      kept += chosen[i];
    }
  }
  return kept;
}

void Downsampler::gather(std::vector<std::uint32_t>& indices) const
{
  indices.clear();
  for (std::size_t chunk = 0; chunk < kept_counts_.size(); ++chunk)
  {
    const auto begin = kept_.begin() + static_cast<std::ptrdiff_t>(chunk * kChunk);
    indices.insert(indices.end(), begin, begin + static_cast<std::ptrdiff_t>(kept_counts_[chunk]));
  }
}

void Downsampler::select(
    const PointColumns& points, const DownsamplingLimits& limits, ScanSelection& selection)
{
  widths_.learn(points);
  sparse_lines_ = !widths_.relative().empty() && areFar(points, limits);
  const Ranges ranges = gateRanges(points, limits);
  selection.dropped_invalid = ranges.invalid;
  selection.dropped_near = ranges.near;
  selection.dropped_far = ranges.far;
  const std::size_t target = targetOf(ranges, limits);
  const bool keep_all = limits.target_points == 0 || ranges.usable <= target;
  const float factor = keep_all ? kKeepAll : densityFactor(ranges, target);
  ++scan_;
  kept_.resize(points.size());
  kept_counts_.resize(chunk_ranges_.size());
  workers_->forEachChunk(
      points.size(), kChunk,
      [&](std::size_t chunk, std::size_t first, std::size_t last)
      { kept_counts_[chunk] = keep(factor * kFixedPointOne, first, last); });
  gather(selection.indices);
}

}  // namespace fastlio
