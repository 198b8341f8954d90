// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bounded_path.h Where a body went, in bounded memory. */
#pragma once

#include <fastlio/math/so3.h>
#include <fastlio/run/run_health.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace fastlio
{
/** Positions in time order. When there are too many, every second one is left out. */
class BoundedPath
{
 public:
  /** \param most positions \param gap_s the path breaks where there is no position for longer [s] */
  BoundedPath(std::size_t most, double gap_s) : most_(most), gap_s_(gap_s) {}

  /** \param position [m] */
  void add(std::int64_t stamp_ns, const Vec3& position);

  /** Positions [m]; the first and the last one are among them. One that is not finite stands for a
   * break. */
  [[nodiscard]] std::vector<Vec3> positions() const;

  /** Those within the stretches alone, with a break between two stretches. */
  [[nodiscard]] std::vector<Vec3> positionsWithin(
      const std::vector<UntrustedStretch>& stretches) const;

 private:
  struct Place
  {
    std::int64_t stamp_ns;
    Vec3 position;
    bool is_after_gap;
  };

  void leaveOutEverySecond();
  /** The path with the last position. */
  [[nodiscard]] std::vector<Place> places() const;

  std::size_t most_;
  double gap_s_;
  std::vector<Place> path_;
  std::size_t stride_ = 1, seen_ = 0;
  bool gap_ = false;  //!< since the latest one of the path
  std::optional<Vec3> last_;
  std::int64_t last_ns_ = 0;
};

}  // namespace fastlio
