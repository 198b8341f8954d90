// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file little_endian.h Numbers in files and packets that have their lowest byte first, whatever
 * the order of this machine is. */
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string>

namespace fastlio
{
/** The bytes of a number in this machine's order as those of a file, and the other way. */
template <std::size_t kSize>
void toOrderOfFile([[maybe_unused]] std::array<char, kSize>& bytes)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  std::reverse(bytes.begin(), bytes.end());
#endif
}

/** \param bytes at least as many as the number has, at any address */
template <typename Number>
[[nodiscard]] Number littleAt(const void* bytes)
{
  std::array<char, sizeof(Number)> raw{};
  std::memcpy(raw.data(), bytes, sizeof raw);
  toOrderOfFile(raw);
  Number number{};
  std::memcpy(&number, raw.data(), sizeof raw);
  return number;
}

template <typename Number>
void appendLittle(std::string& bytes, Number number)
{
  std::array<char, sizeof(Number)> raw{};
  std::memcpy(raw.data(), &number, sizeof raw);
  toOrderOfFile(raw);
  bytes.append(raw.data(), raw.size());
}

}  // namespace fastlio
