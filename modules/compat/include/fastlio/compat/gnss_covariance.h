// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gnss_covariance.h The covariance of a position of GNSS: CObservationGPS has a member for it
 * in newer versions of MRPT. */
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>

namespace fastlio
{
/** East, north, up: 3 x 3, row by row [m^2]. */
using EnuCovariance = std::array<double, 9>;

/** Whether a class of observations has a covariance_enu. */
template <typename Observation, typename = void>
struct HasEnuCovariance : std::false_type
{
};
template <typename Observation>
struct HasEnuCovariance<Observation, std::void_t<decltype(Observation::covariance_enu)>>
    : std::true_type
{
};

/** Sets the member, where there is one. */
template <typename Observation>
void setEnuCovariance(
    [[maybe_unused]] Observation& observation, [[maybe_unused]] const EnuCovariance& covariance)
{
  if constexpr (HasEnuCovariance<Observation>::value)
  {
    auto& matrix = observation.covariance_enu.emplace();
    for (int i = 0; i < 9; ++i)
      matrix(i / 3, i % 3) = covariance[static_cast<std::size_t>(i)];
  }
}

/** The member; nothing where there is none, or where nobody has set it. */
template <typename Observation>
[[nodiscard]] std::optional<EnuCovariance> enuCovarianceOf(
    [[maybe_unused]] const Observation& observation)
{
  if constexpr (HasEnuCovariance<Observation>::value)
  {
    if (!observation.covariance_enu) return std::nullopt;
    EnuCovariance covariance{};
    for (int i = 0; i < 9; ++i)
      covariance[static_cast<std::size_t>(i)] = (*observation.covariance_enu)(i / 3, i % 3);
    return covariance;
  }
  return std::nullopt;
}

}  // namespace fastlio
