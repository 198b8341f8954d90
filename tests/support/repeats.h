// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file repeats.h How often, or for how long, the long tests do the same.
 *
 * The mean of a hundred runs needs all of them; a sanitizer sees in the first what it sees
 * in the last. Grids of faults and hours of driving are sampled, unless `make faults` asks for all.
 */
#pragma once

#include <cstdlib>

namespace fastlio::testing
{
/** FASTLIO_FEW_REPEATS is set, as the presets with sanitizers do: a tenth of the repetitions, whose
 * means are not judged. */
[[nodiscard]] inline bool fewRepeats()
{
  return std::getenv("FASTLIO_FEW_REPEATS") != nullptr;
}

/** A tenth of \a all with few repeats, and at least one. */
template <typename Count>
[[nodiscard]] Count repeats(Count all)
{
  if (!fewRepeats()) return all;
  return all > Count{10} ? all / Count{10} : Count{1};
}

/** FASTLIO_EVERYTHING is set, as `make faults` does: whole grids, whole hours. */
[[nodiscard]] inline bool everything()
{
  return std::getenv("FASTLIO_EVERYTHING") != nullptr;
}

/** A third of repeats(all), unless everything is asked for. */
template <typename Count>
[[nodiscard]] Count sampled(Count all)
{
  return repeats(everything() ? all : all / Count{3});
}

}  // namespace fastlio::testing
