// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/run_outcome.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::array<std::string_view, 5> kNames = {
    "complete", "degraded", "truncated", "lost", "failed"};
}  // namespace

std::string_view toText(RunState state)
{
  return kNames.at(static_cast<std::size_t>(state));
}

RunState runStateOf(std::string_view text)
{
  const auto* found = std::find(kNames.begin(), kNames.end(), text);
  if (found == kNames.end())
    throw std::invalid_argument("'" + std::string(text) + "' is no state of a run");
  return static_cast<RunState>(found - kNames.begin());
}

std::optional<double> RunOutcome::measure(const std::string& name) const
{
  const auto found = measures.find(name);
  if (found == measures.end() || !std::isfinite(found->second)) return std::nullopt;
  return found->second;
}

}  // namespace fastlio
