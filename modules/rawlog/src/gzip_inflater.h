// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gzip_inflater.h Decompression of gzip data, by one library or another. */
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace fastlio
{
enum class InflateStatus
{
  Going,
  MemberEnd,  //!< all of a member is out, and its checksum is right
  Corrupt
};

/** What a step has come to. */
struct InflateStep
{
  std::size_t consumed = 0;  //!< bytes of the input
  std::size_t produced = 0;  //!< bytes of the output
  InflateStatus status = InflateStatus::Going;
};

/** Inflates one member of a gzip file after the other. */
class GzipInflater
{
 public:
  GzipInflater() = default;
  virtual ~GzipInflater() = default;
  GzipInflater(const GzipInflater&) = delete;
  GzipInflater& operator=(const GzipInflater&) = delete;

  /** The next byte of the input begins another member. */
  virtual void reset() = 0;

  /** As much as there is input and room for; also without input, as some may be inside still. */
  virtual InflateStep step(
      const unsigned char* input, std::uint32_t input_size, unsigned char* output,
      std::uint32_t output_size) = 0;
};

/** zlib.
 * \exception std::bad_alloc */
[[nodiscard]] std::unique_ptr<GzipInflater> makeZlibInflater();

/** Intel's ISA-L, 2.5 times as fast (fastlio-microbenchmark --benchmark_filter=inflate); null where
 * it is not built in. */
[[nodiscard]] std::unique_ptr<GzipInflater> makeIsalInflater();

}  // namespace fastlio
