// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "gzip_deflater.h"
#include <fastlio/files/gzip_file.h>

#include <algorithm>
#include <stdexcept>

namespace fastlio
{
GzipFile::GzipFile(const std::string& path)
    : file_(path), deflater_(std::make_unique<GzipDeflater>())
{
}

GzipFile::~GzipFile() = default;

void GzipFile::pack(std::string_view bytes, bool end)
{
  std::string_view packed;
  do
  {
    packed = deflater_->deflate(bytes, end);
    file_.write(packed);
  } while (packed.size() == GzipDeflater::kMostAtATime);
}

std::size_t GzipFile::Write(const void* data, std::size_t size)
{
  constexpr std::size_t kMost = 1U << 30U;  // the libraries count with 32 bits
  const auto* bytes = static_cast<const char*>(data);
  for (std::size_t done = 0; done < size; done += kMost)
    pack({bytes + done, std::min(kMost, size - done)}, false);
  return size;
}

std::size_t GzipFile::Read(void* /*data*/, std::size_t /*size*/)
{
  throw std::logic_error("GzipFile is for writing.");
}

OutputFile GzipFile::commit()
{
  pack({}, true);
  return file_.commit();
}

}  // namespace fastlio
