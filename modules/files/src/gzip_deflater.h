// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

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

  /** Takes bytes from the front of \a input.
   * \param end nothing follows \a input
   * \return the number of bytes that are in \a output now; fewer than \a room when all of \a input
   * is taken */
  std::size_t deflate(std::string_view& input, bool end, char* output, std::size_t room);

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace fastlio
