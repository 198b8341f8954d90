// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#ifdef FASTLIO_WITH_ISAL

#include "gzip_deflater.h"

#include <array>
#include <cstdint>
#include <isa-l/igzip_lib.h>

namespace fastlio
{
struct GzipDeflater::Library
{
  isal_zstream stream;
  std::array<std::uint8_t, ISAL_DEF_LVL1_DEFAULT> tables;
};

GzipDeflater::GzipDeflater() : library_(std::make_unique<Library>())
{
  isal_zstream& stream = library_->stream;
  isal_deflate_init(&stream);
  stream.gzip_flag = IGZIP_GZIP;
  stream.level = 1;
  stream.level_buf = library_->tables.data();
  stream.level_buf_size = static_cast<std::uint32_t>(library_->tables.size());
}

GzipDeflater::~GzipDeflater() = default;

std::string_view GzipDeflater::deflate(std::string_view& input, bool end)
{
  isal_zstream& stream = library_->stream;
  if (stream.internal_state.state == ZSTATE_END) return {};
  stream.next_in = reinterpret_cast<std::uint8_t*>(const_cast<char*>(input.data()));  // not written
  stream.avail_in = static_cast<std::uint32_t>(input.size());
  stream.next_out = reinterpret_cast<std::uint8_t*>(output_.data());
  stream.avail_out = kMostAtATime;
  stream.end_of_stream = end ? 1 : 0;
  isal_deflate(&stream);
  input.remove_prefix(input.size() - stream.avail_in);
  return {output_.data(), kMostAtATime - stream.avail_out};
}

}  // namespace fastlio

#endif
