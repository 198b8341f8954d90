// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string_view>

namespace fastlio
{
/** Makes one gzip file of bytes that come piece by piece. ISA-L does it where there is ISA-L (ten
 * times faster, files a few percent larger), zlib elsewhere. */
class GzipDeflater
{
 public:
  /** \exception std::bad_alloc there is not enough memory */
  GzipDeflater();
  ~GzipDeflater();
  GzipDeflater(const GzipDeflater&) = delete;
  GzipDeflater& operator=(const GzipDeflater&) = delete;

  static constexpr std::size_t kMostAtATime = 1U << 16U;

  /** Takes bytes from the front of \a input, which has less than 4 GiB.
   * \param end nothing follows \a input
   * \return compressed bytes, good until the next call; fewer than kMostAtATime when all of \a input
   * is taken */
  std::string_view deflate(std::string_view& input, bool end);

 private:
  struct Library;
  std::unique_ptr<Library> library_;
  std::array<char, kMostAtATime> output_{};
};

}  // namespace fastlio
