// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/plot/svg_plot.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace fastlio
{
std::string tickText(double value)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << (std::abs(value) < 1e-12 ? 0.0 : value);
  return out.str();
}

std::vector<double> roundTicks(double low, double high, int count)
{
  const double raw = (high - low) / std::max(count, 1);
  if (!(raw > 0.0) || !std::isfinite(raw)) return {};
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double mantissa = raw / power;
  const double step = power * (mantissa <= 1.0   ? 1.0
                               : mantissa <= 2.0 ? 2.0
                               : mantissa <= 5.0 ? 5.0
                                                 : 10.0);
  const auto first = std::ceil(low / step);
  const auto steps = static_cast<int>(std::floor(high / step) - first);
  std::vector<double> ticks;
  for (int i = 0; i <= steps; ++i)
    ticks.push_back((first + i) * step);
  return ticks;
}

std::vector<PlotTick> axisTicks(const PlotRange& range, int count)
{
  constexpr std::size_t kLeast = 3;  // fewer do not show the scale
  constexpr int kMost = 16;          // enough for three of any range
  std::vector<double> values = roundTicks(range.low, range.high, count);
  for (int more = count + 1; values.size() < kLeast && more <= kMost; ++more)
    values = roundTicks(range.low, range.high, more);
  std::vector<PlotTick> ticks;
  ticks.reserve(values.size());
  for (const double value : values)
    ticks.push_back({value, tickText(value)});
  return ticks;
}

}  // namespace fastlio
