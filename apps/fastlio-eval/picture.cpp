// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "picture.h"

#include <fastlio/files/atomic_file.h>

#include <array>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fastlio
{
namespace
{
struct Closing
{
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/** A file in memory that holds the text; others reach it by its number. */
std::unique_ptr<std::FILE, Closing> fileOf(const std::string& text)
{
  std::unique_ptr<std::FILE, Closing> file(fdopen(memfd_create("picture", MFD_CLOEXEC), "w"));
  if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
      std::fflush(file.get()) != 0)
    throw std::runtime_error(
        "there is not enough memory for the picture from which the PNG is made");
  return file;
}

/** The picture after rsvg-convert. */
std::string pngOf(const std::string& svg)
{
  const auto file = fileOf(svg);
  const std::string command = "rsvg-convert --format=png --zoom=2 </proc/" +
                              std::to_string(getpid()) + "/fd/" +
                              std::to_string(fileno(file.get()));
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("rsvg-convert cannot be started");
  std::string png;
  std::array<char, 65536> buffer{};
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    png.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (status != 0 || png.empty())
    throw std::runtime_error(
        "the PNG could not be made by rsvg-convert (exit status " +
        std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1) +
        "): install librsvg2-bin, or give a name that ends in .svg");
  return png;
}
}  // namespace

void requirePictureName(const std::filesystem::path& path)
{
  const std::string ending = path.extension().string();
  if (ending.empty() || ending == ".svg" || ending == ".png") return;
  throw std::invalid_argument(
      "--plot '" + path.string() + "': a picture's name must end in .svg or .png");
}

void writePicture(const std::filesystem::path& path, const std::string& svg)
{
  writeFileAtomically(path.string(), path.extension() == ".png" ? pngOf(svg) : svg);
}

}  // namespace fastlio
