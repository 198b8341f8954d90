// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "picture.h"

#include <fastlio/files/atomic_file.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace fastlio
{
namespace
{
/** A file that is gone in the end. */
class TemporaryFile
{
 public:
  explicit TemporaryFile(const std::string& content)
      : path_((std::filesystem::temp_directory_path() / "fastlio-eval-XXXXXX").string()),
        file_(mkstemp(path_.data()))
  {
    std::size_t written = 0;
    while (file_ >= 0 && written < content.size())
    {
      const ssize_t n = ::write(file_, content.data() + written, content.size() - written);
      if (n <= 0) break;
      written += static_cast<std::size_t>(n);
    }
    if (file_ >= 0) ::close(file_);
    if (written == content.size()) return;
    ::unlink(path_.c_str());
    throw std::runtime_error(
        "cannot write '" + path_ + "', from which the PNG is made: check the free space there");
  }
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  int file_;
};

/** A path in a command of the shell. */
std::string quoted(const std::string& path)
{
  std::string text = "'";
  for (const char c : path)
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/** The picture after rsvg-convert. */
std::string pngOf(const std::string& svg)
{
  const TemporaryFile file(svg);
  const std::string command = "rsvg-convert --format=png --zoom=2 " + quoted(file.path());
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
