// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/verdict.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kWorse = 1.05;   // a recording got worse
constexpr double kBetter = 0.95;  // the mean over recordings got better

/** The best of those that make no recording worse; the base always is one. */
std::size_t choose(const Ratios& ratios, std::optional<std::size_t> without)
{
  std::size_t best = 0;
  double best_mean = 1.0;
  for (std::size_t c = 0; c < ratios.size(); ++c)
  {
    std::vector<double> used = ratios[c];
    if (without) used.erase(used.begin() + static_cast<std::ptrdiff_t>(*without));
    if (*std::max_element(used.begin(), used.end()) > kWorse) continue;
    const double mean = meanRatio(used);
    if (mean < best_mean) best = c, best_mean = mean;
  }
  return best;
}
}  // namespace

double meanRatio(const std::vector<double>& ratios)
{
  double sum = 0.0;
  for (const double ratio : ratios)
    sum += std::log(ratio);
  return std::exp(sum / static_cast<double>(ratios.size()));
}

Verdict leaveOneOut(const Ratios& ratios)
{
  Verdict verdict;
  verdict.best = choose(ratios, std::nullopt);
  const std::size_t recordings = ratios.front().size();
  if (recordings < 2) return verdict;
  for (std::size_t r = 0; r < recordings; ++r)
    verdict.left_out.push_back(ratios[choose(ratios, r)][r]);
  verdict.recommended =
      verdict.best != 0 && meanRatio(verdict.left_out) < kBetter &&
      *std::max_element(verdict.left_out.begin(), verdict.left_out.end()) <= kWorse;
  return verdict;
}

}  // namespace fastlio
