// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file wire_reader.h Numbers and texts out of a message, in the encodings of ROS 1 and ROS 2. */
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace fastlio
{
/** How messages are laid out. */
enum class WireFormat
{
  Ros1,  //!< packed, little endian, texts without an end mark
  Cdr    //!< of DDS: a head that gives the order of bytes, numbers aligned
};

/** Reads forward; never beyond the end, whatever lengths the message claims. All functions throw
 * std::runtime_error when the message ends before. */
class WireReader
{
 public:
  /** \exception std::runtime_error CDR of a kind that messages of ROS are not written in */
  WireReader(const std::uint8_t* data, std::size_t size, WireFormat format);

  template <typename T>
  T number()
  {
    align(sizeof(T));
    T value{};
    const std::uint8_t* bytes = take(sizeof(T));
    if (!swap_)
    {
      std::memcpy(&value, bytes, sizeof(T));
      return value;
    }
    std::uint8_t reversed[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i)
      reversed[i] = bytes[sizeof(T) - 1 - i];
    std::memcpy(&value, reversed, sizeof(T));
    return value;
  }

  [[nodiscard]] std::string_view text();

  /** Length of a sequence whose elements take \a least bytes each: one that cannot be there is
   * refused before anybody allocates it. */
  [[nodiscard]] std::size_t count(std::size_t least);

  [[nodiscard]] const std::uint8_t* take(std::size_t size);
  [[nodiscard]] std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  [[nodiscard]] bool isRos1() const { return format_ == WireFormat::Ros1; }
  /** Numbers are in the other order than this machine's. */
  [[nodiscard]] bool swapped() const { return swap_; }

 private:
  void align(std::size_t size);

  const std::uint8_t *begin_, *at_, *end_;
  WireFormat format_;
  std::size_t largest_alignment_ = 8;
  bool swap_ = false;
};

}  // namespace fastlio
