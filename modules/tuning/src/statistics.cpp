// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/number_text.h>
#include <fastlio/tuning/statistics.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::size_t kLevelsOfRange = 3;
constexpr double kCertain = 2.0;  // standard errors

/** Ranks from 0; equal values get the mean of theirs. */
std::vector<double> ranksOf(const std::vector<double>& values)
{
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size();)
  {
    std::size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]])
      ++end;
    for (std::size_t k = i; k < end; ++k)
      ranks[order[k]] = 0.5 * static_cast<double>(i + end - 1);
    i = end;
  }
  return ranks;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
  const auto n = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

using Group = std::vector<const TriedPoint*>;

std::vector<Group> groupsOfList(
    const SearchKey& key, std::size_t k, const std::vector<TriedPoint>& points)
{
  std::vector<Group> groups;
  for (const std::string& value : key.values)
  {
    Group group;
    for (const TriedPoint& point : points)
      if (point.values[k] == value) group.push_back(&point);
    if (!group.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<Group> groupsOfRange(std::size_t k, const std::vector<TriedPoint>& points)
{
  const auto number = [&](const TriedPoint* point)
  { return parsed<double>(point->values[k]).value_or(0.0); };
  Group sorted;
  for (const TriedPoint& point : points)
    sorted.push_back(&point);
  std::stable_sort(
      sorted.begin(), sorted.end(), [&](auto a, auto b) { return number(a) < number(b); });
  std::vector<Group> groups;
  std::size_t begin = 0;
  for (std::size_t level = 1; level <= kLevelsOfRange; ++level)
  {
    std::size_t end = level * sorted.size() / kLevelsOfRange;
    // Equal values stay together.
    while (end > begin && end < sorted.size() && number(sorted[end]) == number(sorted[end - 1]))
      ++end;
    if (end <= begin) continue;
    groups.emplace_back(
        sorted.begin() + static_cast<std::ptrdiff_t>(begin),
        sorted.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
  return groups;
}

/** Mean of the logarithms of the ratios, and its variance. */
std::pair<double, double> meanOf(const Group& group)
{
  const auto n = static_cast<double>(group.size());
  double mean = 0.0;
  for (const TriedPoint* point : group)
    mean += std::log(point->ratio) / n;
  double squares = 0.0;
  for (const TriedPoint* point : group)
    squares += std::pow(std::log(point->ratio) - mean, 2);
  return {mean, n > 1.0 ? squares / (n - 1.0) / n : INFINITY};
}

KeyEffect effectOf(
    const SearchKey& key, std::size_t k, const std::vector<Group>& groups, double mean)
{
  KeyEffect effect{key.key, {}, 1.0, false};
  std::vector<std::pair<double, double>> means;
  for (const Group& group : groups)
  {
    means.push_back(meanOf(group));
    const std::string& first = group.front()->values[k];
    const std::string& last = group.back()->values[k];
    effect.levels.push_back(
        {first == last ? first : first + " to " + last, group.size(),
         std::exp(means.back().first - mean)});
  }
  if (means.empty()) return effect;
  const auto [low, high] = std::minmax_element(means.begin(), means.end());
  effect.effect = std::exp(high->first - low->first);
  effect.certain = high->first - low->first > kCertain * std::sqrt(low->second + high->second);
  return effect;
}
}  // namespace

double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b)
{
  if (a.size() != b.size())
    throw std::invalid_argument(
        "rankCorrelation: the sides must be of one length, seen " + std::to_string(a.size()) +
        " and " + std::to_string(b.size()));
  return a.empty() ? 0.0 : correlation(ranksOf(a), ranksOf(b));
}

std::vector<KeyEffect> keyEffects(const SearchSpace& space, const std::vector<TriedPoint>& points)
{
  double mean = 0.0;
  for (const TriedPoint& point : points)
    mean += std::log(point.ratio) / static_cast<double>(points.size());
  std::vector<KeyEffect> effects;
  for (std::size_t k = 0; k < space.size(); ++k)
    effects.push_back(effectOf(
        space[k], k,
        space[k].values.empty() ? groupsOfRange(k, points) : groupsOfList(space[k], k, points),
        mean));
  std::stable_sort(
      effects.begin(), effects.end(),
      [](const KeyEffect& a, const KeyEffect& b) { return a.effect > b.effect; });
  return effects;
}

}  // namespace fastlio
