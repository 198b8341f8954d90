// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "checksum.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>
#include <zlib.h>

namespace
{
using namespace fastlio;

TEST(Checksum, IsThatOfZlibInAnyPieces)
{
  std::vector<std::uint8_t> bytes(1000);
  std::uint32_t random = 1;
  for (std::uint8_t& byte : bytes)
    byte = static_cast<std::uint8_t>((random = random * 1664525U + 1013904223U) >> 24U);
  for (std::size_t size = 0; size <= bytes.size(); ++size)
  {
    const auto expected = static_cast<std::uint32_t>(crc32_z(0, bytes.data(), size));
    ASSERT_EQ(crc32With(0, bytes.data(), size), expected) << size;
    const std::size_t part = size / 3;
    const std::uint32_t first = crc32With(0, bytes.data(), part);
    ASSERT_EQ(crc32With(first, bytes.data() + part, size - part), expected) << size;
  }
}
}  // namespace
