// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "gzip_deflater.h"
#include <fastlio/files/gzip_file.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace fastlio
{
struct GzipFile::Packing
{
  GzipDeflater deflater;
  std::array<char, 1U << 16U> out{};
};

GzipFile::GzipFile(const std::string& path) : file_(path), packing_(std::make_unique<Packing>()) {}

GzipFile::~GzipFile() = default;

void GzipFile::pack(std::string_view bytes, bool end)
{
  std::array<char, 1U << 16U>& out = packing_->out;
  std::size_t size = 0;
  do
  {
    size = packing_->deflater.deflate(bytes, end, out.data(), out.size());
    file_.write({out.data(), size});
  } while (size == out.size());
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
