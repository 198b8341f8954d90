// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file inflater.h Decompression piece by piece, by one library or another. */
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace fastlio
{
/** The first bytes of a frame of Zstandard. */
inline constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD";

enum class InflateStatus
{
  Going,
  MemberEnd,  //!< all of a member (a frame, a stream) is out, and its checksum is right
  Corrupt
};

/** The outcome of a step. */
struct InflateStep
{
  std::size_t consumed = 0;  //!< bytes of the input
  std::size_t produced = 0;  //!< bytes of the output
  InflateStatus status = InflateStatus::Going;
};

/** Inflates one member after the other. */
class Inflater
{
 public:
  Inflater() = default;
  virtual ~Inflater() = default;
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /** The next byte of the input begins another member. */
  virtual void reset() = 0;

  /** As much as there is input and room for; also without input, as some may be inside still. */
  virtual InflateStep step(
      const unsigned char* input, std::uint32_t input_size, unsigned char* output,
      std::uint32_t output_size) = 0;
};

/** \name Each takes a few MiB at most, whatever the data claim (Zstandard: 128 MiB).
 * \exception std::bad_alloc
 * @{ */
[[nodiscard]] std::unique_ptr<Inflater> makeBzip2Inflater();
[[nodiscard]] std::unique_ptr<Inflater> makeLz4Inflater();
[[nodiscard]] std::unique_ptr<Inflater> makeZstdInflater();
/** Of gzip, by zlib. */
[[nodiscard]] std::unique_ptr<Inflater> makeZlibInflater();
/** Of gzip, by Intel's ISA-L, 2.5 times as fast (fastlio-microbenchmark
 * --benchmark_filter=inflate); null where it is not built in. */
[[nodiscard]] std::unique_ptr<Inflater> makeIsalInflater();
/** @} */

}  // namespace fastlio
