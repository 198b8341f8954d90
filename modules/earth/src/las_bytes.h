// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file las_bytes.h The public header block and the variable length record of LAS 1.4 (ASPRS, LAS
 * Specification 1.4 - R15, tables 3, 5 and 14; all numbers are little-endian). */
#pragma once

#include <fastlio/math/little_endian.h>
#include <fastlio/math/so3.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace fastlio
{
inline constexpr std::size_t kLasNameLength = 32;
/** The step of coordinates [m]: 32 bits of it reach 2147 km to both sides. */
inline constexpr double kLasStep = 0.001;
/** The length of a record has 16 bits, and a zero ends the text. */
inline constexpr std::size_t kLongestLasWkt = 65534;
/** Of point data record format 6: return number 1 in the lower four bits, 1 return in the upper. */
inline constexpr std::uint8_t kLasOneOfOneReturns = 0x11;

/** Appends to a text. */
class LasBytes
{
 public:
  explicit LasBytes(std::string& bytes) : bytes_(bytes) {}

  template <typename Number>
  LasBytes& number(Number value)
  {
    appendLittle(bytes_, value);
    return *this;
  }
  LasBytes& zeros(std::size_t count)
  {
    bytes_.append(count, '\0');
    return *this;
  }
  /** Filled up with zeros, or cut. */
  LasBytes& text(std::string_view text, std::size_t length)
  {
    const std::string_view kept = text.substr(0, length);
    bytes_.append(kept);
    return zeros(length - kept.size());
  }

 private:
  std::string& bytes_;
};

/** The values that differ from file to file. */
struct LasHeader
{
  std::size_t wkt_bytes = 0;  //!< 0: there is no record of the reference system
  Vec3 offset = Vec3::Zero(), least = Vec3::Zero(), most = Vec3::Zero();  //!< [m]
  std::uint64_t points = 0;
  std::int64_t day_of_stamp_ns = 0;  //!< UTC; no time: no day
};

/** The 375 bytes at the beginning of the file. */
[[nodiscard]] std::string lasHeaderBytes(const LasHeader& header);

/** "LASF_Projection" 2112 with its header. */
[[nodiscard]] std::string lasWktRecord(const std::string& wkt);

}  // namespace fastlio
