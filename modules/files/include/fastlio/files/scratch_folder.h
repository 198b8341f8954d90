// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scratch_folder.h Files for what does not fit into the memory while a program runs. */
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace fastlio
{
/** What a ScratchFolder holds: it names the folder, and messages name it. */
enum class ScratchContent
{
  MapTiles,  //!< points of a map
  Submaps    //!< planes of submaps
};

/** A file of a ScratchFolder. */
struct ScratchFile
{
  std::string path;
  std::size_t hash = 0;  //!< of its bytes, in this process: shows that somebody has changed them
};

/** A folder that is made for its first file, and removed in the end with everything in it. When the
 * process is killed it stays; isScratchFolder() knows its name. */
class ScratchFolder
{
 public:
  /** \param directory that it lies in; empty: the system's own place for temporary files */
  explicit ScratchFolder(ScratchContent content, std::string directory = {});
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /** Writes columns of numbers one after the other; a file of that name is replaced.
   * \param name of digits, '-' and '_' alone
   * \exception std::runtime_error the file cannot be written; then there is none of that name */
  template <typename... T>
  ScratchFile write(const std::string& name, const std::vector<T>&... columns)
  {
    return writeBytes(
        name, {{reinterpret_cast<const char*>(columns.data()), sizeOf<T>() * columns.size()}...});
  }

  /** Reads them back. \param columns of the lengths that were written
   * \exception std::runtime_error the file is gone, or is not what was written */
  template <typename... T>
  void read(const ScratchFile& file, std::vector<T>&... columns) const
  {
    readBytes(file, {{reinterpret_cast<char*>(columns.data()), sizeOf<T>() * columns.size()}...});
  }

  /** Removes a file that is not needed any more. */
  static void remove(const ScratchFile& file);

 private:
  struct Target
  {
    char* data;
    std::size_t size;
  };
  template <typename T>
  static constexpr std::size_t sizeOf()
  {
    static_assert(std::is_trivially_copyable_v<T>, "its bytes are not all of it");
    return sizeof(T);
  }
  ScratchFile writeBytes(const std::string& name, std::initializer_list<std::string_view> columns);
  void readBytes(const ScratchFile& file, std::initializer_list<Target> columns) const;
  void make();

  ScratchContent content_;
  std::string directory_;
  std::string path_;  //!< empty until there is a file
};

/** Whether it is a ScratchFolder, by its name and those of its files: its process was killed when
 * it is still there afterwards. */
[[nodiscard]] bool isScratchFolder(const std::string& path);

}  // namespace fastlio
