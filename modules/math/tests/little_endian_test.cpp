// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/little_endian.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace fastlio
{
namespace
{
TEST(LittleEndian, TheLowestByteIsFirst)
{
  std::string bytes;
  appendLittle(bytes, std::uint32_t{0x01020304});
  appendLittle(bytes, std::int16_t{-2});
  appendLittle(bytes, 1.0F);
  EXPECT_EQ(bytes, std::string("\x04\x03\x02\x01\xFE\xFF\x00\x00\x80\x3F", 10));
  EXPECT_EQ(littleAt<std::uint16_t>(bytes.data() + 1), 0x0203);  // at any address
  EXPECT_EQ(littleAt<std::int16_t>(bytes.data() + 4), -2);
  EXPECT_EQ(littleAt<float>(bytes.data() + 6), 1.0F);
}
}  // namespace
}  // namespace fastlio
