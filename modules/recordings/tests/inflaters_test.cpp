// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bag_writers.h"
#include "test_files.h"
#include <fastlio/recordings/inflater.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

struct Inflated
{
  std::string bytes;
  InflateStatus status = InflateStatus::Going;
};

/** In steps of a few bytes. */
Inflated inflate(Inflater& inflater, const std::string& packed, std::size_t room = 7)
{
  Inflated result;
  std::string out(room, '\0');
  for (std::size_t at = 0; result.status == InflateStatus::Going;)
  {
    const auto step = inflater.step(
        reinterpret_cast<const unsigned char*>(packed.data()) + at,
        static_cast<std::uint32_t>(std::min<std::size_t>(5, packed.size() - at)),
        reinterpret_cast<unsigned char*>(out.data()), static_cast<std::uint32_t>(room));
    at += step.consumed;
    result.bytes += out.substr(0, step.produced);
    result.status = step.status;
    if (step.consumed == 0 && step.produced == 0) break;
  }
  return result;
}

TEST(Inflaters, EachGivesTheBytesInSmallStepsAndAnew)
{
  const std::string bytes(5000, 'x');
  const auto check = [&](const std::unique_ptr<Inflater>& inflater, const std::string& packed)
  {
    for (int i = 0; i < 2; ++i)
    {
      const Inflated result = inflate(*inflater, packed);
      EXPECT_EQ(result.bytes, bytes);
      EXPECT_EQ(result.status, InflateStatus::MemberEnd);
      inflater->reset();
    }
    EXPECT_EQ(inflate(*inflater, "no such data").status, InflateStatus::Corrupt);
  };
  check(makeBzip2Inflater(), bzip2(bytes));
  check(makeLz4Inflater(), lz4(bytes));
  check(makeZstdInflater(), zstd(bytes));
}

TEST(Inflaters, WindowsBeyond128MiBAreRefused)
{
  // A frame with one block of one byte, stored; its head asks for a window of 2^(10 + x).
  const auto frame = [](int x)
  {
    return std::string("\x28\xB5\x2F\xFD\0", 5) + static_cast<char>(x << 3) +
           std::string("\x09\0\0A", 4);
  };
  EXPECT_EQ(inflate(*makeZstdInflater(), frame(17)).bytes, "A");
  EXPECT_EQ(inflate(*makeZstdInflater(), frame(18)).status, InflateStatus::Corrupt);
}
}  // namespace
