// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file byte_source.h Bytes of a file, and bytes that a stretch of a file inflates to. */
#pragma once

#include <fastlio/math/little_endian.h>
#include <fastlio/recordings/inflater.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
using Bytes = std::vector<std::uint8_t>;

/** Of a message, an object of a rawlog or another record [bytes]: ten times the clouds of the
 * largest LiDARs. A damaged length costs twice as much memory before it is noticed. */
inline constexpr std::size_t kLargestRecord = std::size_t{256} << 20U;

/** Bytes in their order. */
class ByteSource
{
 public:
  ByteSource() = default;
  virtual ~ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /** Fewer than \a size: the source has ended. */
  virtual std::size_t read(std::uint8_t* data, std::size_t size) = 0;

  /** \return whether there were so many */
  virtual bool skip(std::uint64_t size);
};

/** Reads \a size bytes in pieces, so that memory is taken for what is there only.
 * \return whether all were there; \a bytes holds what was */
[[nodiscard]] bool readBytes(ByteSource& source, std::size_t size, Bytes& bytes);

/** A little endian number; nothing: the source ends before or inside it. */
template <typename T>
[[nodiscard]] std::optional<T> readNumber(ByteSource& source)
{
  std::uint8_t bytes[sizeof(T)];
  if (source.read(bytes, sizeof bytes) < sizeof bytes) return std::nullopt;
  return littleAt<T>(bytes);
}

/** A whole file. */
class FileBytes : public ByteSource
{
 public:
  /** \exception std::runtime_error it cannot be opened; the message goes on behind "the file" */
  explicit FileBytes(const std::string& path);

  std::size_t read(std::uint8_t* data, std::size_t size) override;
  bool skip(std::uint64_t size) override;
  void seek(std::uint64_t position);

  [[nodiscard]] std::uint64_t position() const { return position_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] std::uint64_t left() const { return size_ - position_; }
  /** The disk has failed: the file goes on where reading has ended. */
  [[nodiscard]] bool failed() const { return std::ferror(file_.get()) != 0; }

 private:
  struct Closer
  {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::uint64_t size_ = 0, position_ = 0;
};

/** A stretch of a file, inflated; without an inflater as it is. */
class StretchBytes : public ByteSource
{
 public:
  /** Begins at the file's position. The file must outlive it. */
  StretchBytes(
      FileBytes& file, std::uint64_t size, std::unique_ptr<Inflater> inflater,
      bool with_checksum = false);

  std::size_t read(std::uint8_t* data, std::size_t size) override;
  bool skip(std::uint64_t size) override;

  /** Members (frames, streams) that follow each other are one, as the programs that compress whole
   * files take them. \param magic with which each begins: what is none is left alone; empty: all
   * that follows is one */
  void joinMembers(std::string_view magic = {}) { member_magic_ = magic; }
  /** The data end where they should. */
  [[nodiscard]] bool whole() const { return !inflater_ || whole_; }

  /** The compressed data are damaged. */
  [[nodiscard]] bool corrupt() const { return corrupt_; }
  /** The file ends inside the stretch. */
  [[nodiscard]] bool truncated() const { return truncated_; }

  /** Compressed bytes that have been read from the file and wait for their turn. */
  [[nodiscard]] std::size_t waiting() const { return end_ - begin_; }
  /** The checksum (CRC-32) of all bytes; nothing when some were not looked at, or nobody
   * asked for it. */
  [[nodiscard]] std::optional<std::uint32_t> checksum() const;

 private:
  void load();
  bool beginsAnotherMember();
  std::size_t inflate(std::uint8_t* data, std::size_t size);
  std::size_t takeReady(std::uint8_t* data, std::size_t size);

  FileBytes& file_;
  std::uint64_t left_;
  std::unique_ptr<Inflater> inflater_;
  bool with_checksum_;
  Bytes buffer_;  // compressed
  std::size_t begin_ = 0, end_ = 0;
  Bytes ready_;  // inflated, for small reads
  std::size_t ready_begin_ = 0;
  std::optional<std::string_view> member_magic_;
  bool ended_ = false, whole_ = false, corrupt_ = false, truncated_ = false, skipped_ = false;
  std::uint32_t checksum_ = 0;
};

/** The first bytes of a file, fewer when it is shorter; none when it is no readable file. */
[[nodiscard]] std::string headOf(const std::string& path, std::size_t size);

}  // namespace fastlio
