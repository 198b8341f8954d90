// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_clipping.h Samples at the end of the sensor's range. */
#pragma once

#include <fastlio/filter/imu.h>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace fastlio
{
/** The end of the range of one axis. */
struct RangeEnd
{
  int axis = 0;        //!< 0: x, 1: y, 2: z
  double value = 0.0;  //!< that the readings do not exceed, with its sign
};

/** Finds clipped readings of one sensor with three axes. When the range is not known, it finds the
 * end of the range by what only clipping does: the readings jump to the largest one of the axis,
 * and it repeats there, far more often than readings of this axis repeat elsewhere. */
class ClippingDetector
{
 public:
  /** \param range full scale; 0: to be found
   * \param floor above it, a single run of equal readings suffices */
  ClippingDetector(double range, double floor) : range_(range), floor_(floor) {}

  /** Takes the next reading.
   * \param held the whole sample repeats the one before: no news
   * \return the full scale when an axis is clipped, otherwise 0 */
  double add(const Vec3& reading, bool held = false);
  /** The result of add() for the reading before the latest one; 0 when there was none. */
  [[nodiscard]] double before() const { return before_; }
  /** The end of the range, once, after the first run of clipped readings. */
  [[nodiscard]] std::optional<RangeEnd> takeFound();

 private:
  /** The readings of one axis that are positive, or negative. */
  struct Side
  {
    double extreme = 0.0;       // largest magnitude
    std::size_t repeats = 0;    // of the extreme
    std::size_t run = 0;        // readings in a row at the extreme, up to now
    double jump = 0.0;          // to the first one of the run
    double evidence = 0.0;      // of the runs before this one
    double run_evidence = 0.0;  // of this one
    int runs = 0;               // that are evidence
    bool clipped = false;       // the extreme is the end of the range
  };

  struct Axis
  {
    std::array<Side, 2> sides;
    std::optional<double> latest;
    std::size_t pairs = 0, repeats = 0;  // readings in a row; those of them that are equal
  };

  [[nodiscard]] double clippedRange(const Vec3& reading);
  [[nodiscard]] double findRange(const Vec3& reading);
  void follow(Axis& axis, double before);
  void tellWhereRunEnds(const Axis& axis, int number, double before);
  [[nodiscard]] bool isClipped(Axis& axis, std::size_t which, const std::optional<double>& before);
  void weigh(const Axis& axis, Side& side) const;

  double range_, floor_;
  double latest_ = 0.0, before_ = 0.0;                        // full scales of clipped readings
  double quantum_ = std::numeric_limits<double>::infinity();  // smallest step of the readings
  std::array<Axis, 3> axes_;
  double level_ = 0.0;  // end of the range that an axis has shown
  std::optional<RangeEnd> found_;
  bool told_ = false;
};

}  // namespace fastlio
