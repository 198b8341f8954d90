// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/nearest_name.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace fastlio
{
namespace
{
using Row = std::vector<std::size_t>;

/** Row i of the dynamic programme over prefixes, from the two rows before it. */
Row nextRow(
    std::string_view a, std::string_view b, std::size_t i, const Row& previous, const Row& before)
{
  Row row(b.size() + 1, i);
  for (std::size_t j = 1; j <= b.size(); ++j)
  {
    const std::size_t substitution = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
    row[j] = std::min({previous[j] + 1, row[j - 1] + 1, substitution});
    const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
    if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
  }
  return row;
}

// Whoever shortens a word leaves letters out, and writes no others: they count less.
constexpr std::size_t kOther = 3, kLeftOut = 1;
}  // namespace

std::size_t editDistance(std::string_view a, std::string_view b)
{
  Row before;
  Row previous(b.size() + 1);
  std::iota(previous.begin(), previous.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    Row row = nextRow(a, b, i, previous, before);
    before = std::move(previous);
    previous = std::move(row);
  }
  return previous.back();
}

bool isBeginningOf(std::string_view name, std::string_view candidate)
{
  return name.size() > 2 && candidate.substr(0, name.size()) == name;
}

std::string_view nearestName(std::string_view name, const std::vector<std::string_view>& candidates)
{
  const auto order = [name](std::string_view candidate)
  {
    const std::size_t longer = candidate.size() - std::min(candidate.size(), name.size());
    const std::size_t others = editDistance(name, candidate) - longer;
    return std::pair(!isBeginningOf(name, candidate), kOther * others + kLeftOut * longer);
  };
  const auto nearer = [&order](std::string_view a, std::string_view b)
  { return order(a) < order(b); };
  const auto best = std::min_element(candidates.begin(), candidates.end(), nearer);
  return best == candidates.end() ? std::string_view{} : *best;
}

}  // namespace fastlio
