// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file las_writer.h Point clouds as LAS 1.4 files, the exchange format of surveyors (ASPRS, LAS
 * Specification 1.4 - R15, 2019). */
#pragma once

#include <fastlio/files/atomic_file.h>
#include <fastlio/math/so3.h>

#include <array>
#include <cstdint>
#include <string>

namespace fastlio
{
/** A point of a LAS file. */
struct LasPoint
{
  Vec3 position = Vec3::Zero();  //!< easting, northing, height [m]
  float intensity = 0;           //!< as the sensor gives it; see LasOptions::intensity_scale
  std::int64_t stamp_ns = 0;     //!< UTC since 1970
};

struct LasOptions
{
  /** The reference system (ReferenceSystem::wkt(), OGC WKT 1); empty: coordinates of a map without
   * a place on the earth. */
  std::string wkt;
  /** LAS has 16 bits for intensities: they are multiplied by this, rounded and limited. */
  double intensity_scale = 1.0;
};

/** Writes points as they come, in constant memory; the file gets its name in commit().
 *
 * Point data record format 6: coordinates in steps of 1 mm, intensity, return 1 of 1, "created,
 * never classified", adjusted standard GPS time (gps_time.h; flagged in the global encoding). The
 * reference system is a variable length record "LASF_Projection" 2112. The day of creation is that
 * of the latest stamp, so that the same points make the same bytes. Each number of points fits the
 * format.
 *
 * A point that is refused leaves the file as it was. When the disk refused bytes, the file cannot
 * be completed, and nothing of it stays. */
class LasWriter
{
 public:
  /** \exception std::invalid_argument the options cannot be written, or the path ends in ".laz":
   * nothing is compressed here
   * \exception std::runtime_error the file cannot be opened, or is a pipe or a device: LAS counts
   * its points in the header */
  LasWriter(const std::string& path, LasOptions options);

  /** \exception std::runtime_error the position is not finite or too far from the offset, or the
   * disk refused the bytes */
  void add(const LasPoint& point);

  /** Completes the header.
   * \exception std::logic_error the disk had refused a point
   * \exception std::runtime_error the bytes did not reach the disk */
  OutputFile commit();

 private:
  using Steps = std::array<std::int32_t, 3>;

  [[nodiscard]] Steps stepsOf(const Vec3& position) const;
  [[nodiscard]] std::string header() const;
  [[nodiscard]] double coordinateOf(int axis, std::int32_t steps) const;

  LasOptions options_;
  AtomicFile file_;
  std::string record_;          //!< storage of add()
  Vec3 offset_ = Vec3::Zero();  //!< the first point, rounded down to whole kilometres [m]
  Steps least_ = {}, most_ = {};
  std::int64_t latest_stamp_ns_ = 0;
  std::uint64_t count_ = 0;
  bool is_whole_ = true;  //!< no record was written in part
};

}  // namespace fastlio
