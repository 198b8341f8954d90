// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_time.h The meaning of the time fields of point clouds: unit and reference,
 * found from the numbers themselves. */
#pragma once

#include <fastlio/lidar/scan.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace fastlio
{
/** Unit of a time field. */
enum class PointTimeUnit
{
  Auto,  //!< to be found
  Seconds,
  Milliseconds,
  Microseconds,
  Nanoseconds
};

/** The reference of a time field. */
enum class PointTimeReference
{
  Auto,      //!< to be found
  Stamp,     //!< time = stamp of the scan + t, of either sign: MRPT's convention
  Start,     //!< the earliest point was measured at the stamp, whatever t is there
  Middle,    //!< the stamp lies midway between earliest and latest point
  End,       //!< the latest point was measured at the stamp
  Absolute,  //!< time = t, since 1970
};

/** Farthest that a point may lie from its scan's stamp [s]; offsets are stored as 32-bit
 * nanoseconds. */
constexpr double kMaxTimeOffset = 2.0;

/** How to read a time field. */
struct PointTimeReading
{
  PointTimeUnit unit = PointTimeUnit::Seconds;
  PointTimeReference reference = PointTimeReference::Stamp;
};

/** The time field of one scan in numbers, nothing interpreted. */
struct PointTimeSample
{
  std::int64_t stamp_ns = 0;  //!< of the scan
  std::size_t points = 0;     //!< whose time is a finite number, and no single one far from all
  double min = 0, max = 0;    //!< of these
  double resolution = 0;      //!< distance of neighbouring numbers of the field's type at max
};

/** The findings about a time field. */
enum class PointTimeVerdict
{
  Absent,         //!< no scan has times
  Instantaneous,  //!< all points of a scan have the same time: nothing to compensate
  Found,          //!< reading is certain
  Ambiguous,      //!< several readings make sense
  Unusable        //!< no reading makes sense
};

/** The verdict with what it rests on. */
struct PointTimeFinding
{
  PointTimeVerdict verdict = PointTimeVerdict::Absent;
  PointTimeReading reading;                  //!< Found: how to read them
  std::vector<PointTimeReading> candidates;  //!< Ambiguous: all that make sense
  std::string evidence;                      //!< for people: the verdict with its numbers
  std::size_t scans = 0;                     //!< with times, that were looked at
  double scan_period = 0;                    //!< median time between stamps [s]; 0: unknown
  double begin = 0, end = 0;                 //!< Found: median of earliest, latest minus stamp [s]
};

/** Looks at the times of one scan.
 * \param single_precision they were stored as 32-bit numbers */
[[nodiscard]] PointTimeSample sampleOf(
    std::int64_t stamp_ns, const std::vector<double>& times, bool single_precision);

/** Decides how times are to be read.
 *
 * Unit: a field that advances with the stamps of the scans is a clock, and the ratio is its unit;
 * otherwise the scan, which lasts about as long as the period of the stamps, decides. Reference: a
 * clock that agrees with the stamps is absolute; one that does not can only be read when the
 * reference is given. All other times refer to the stamp.
 *
 * \param samples of consecutive scans of one sensor
 * \param given unit and reference as far as they are known; Auto: to be found */
[[nodiscard]] PointTimeFinding findPointTimes(
    const std::vector<PointTimeSample>& samples,
    const PointTimeReading& given = {PointTimeUnit::Auto, PointTimeReference::Auto});

/** Times of a scan's points as seconds after its stamp, in place. Times that are not finite stay
 * so. The first and the last point are those within kMaxTimeOffset of the median.
 * \exception std::invalid_argument the unit or the reference is Auto */
void toSecondsAfterStamp(
    std::vector<double>& times, std::int64_t stamp_ns, const PointTimeReading& reading);

/** Seconds per unit.
 * \exception std::invalid_argument PointTimeUnit::Auto */
[[nodiscard]] double secondsPer(PointTimeUnit unit);

/** "s", "ms", "us", "ns" or "auto": also the value of input.point_time_unit. */
[[nodiscard]] const char* nameOf(PointTimeUnit unit);

/** "auto", "stamp", "start", ...: also the value of input.point_time_reference. */
[[nodiscard]] const char* nameOf(PointTimeReference reference);

/** "absent", "instantaneous", "found", "ambiguous" or "unusable". */
[[nodiscard]] const char* nameOf(PointTimeVerdict verdict);

/** For people: "ms after the stamp". */
[[nodiscard]] std::string describe(const PointTimeReading& reading);

}  // namespace fastlio
