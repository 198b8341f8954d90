// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_matching.h"
#include <fastlio/matching/plane_numbers.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <map>

namespace fastlio
{
namespace
{
TEST(PlaneNumbers, CountInTheOrderOfTheFirstPoints)
{
  // Numbers of planes that collide in any table, and the largest ones there are.
  Matching m = randomMatching(14, 1500);
  for (std::size_t i = 0; i < m.matches.size(); ++i)
    m.matches[i].plane = i % 5 == 0 ? ~std::uint32_t{0} - static_cast<std::uint32_t>(i % 3)
                                    : static_cast<std::uint32_t>(i / 2) * 4096U;
  const MeasuredScan scan = measured(m, wideOpen());
  PlaneNumbers numbers;
  EXPECT_EQ(numbers.find(0), PlaneNumbers::kNone);
  for (int repetition = 0; repetition < 2; ++repetition)
  {
    numbers.assign(scan, m.matches);
    std::map<std::uint32_t, std::uint32_t> expected;
    scan.forEachBlock(
        [&](const MeasurementBlock& block, std::size_t number)
        {
          for (std::size_t l = 0; l < kLanes; ++l)
          {
            if (block.weight[l] == 0.0) continue;
            const std::uint32_t plane = m.matches[block.index[l]].plane;
            const auto next = static_cast<std::uint32_t>(expected.size());
            EXPECT_EQ(numbers.of(number, l), expected.try_emplace(plane, next).first->second);
          }
        });
    EXPECT_EQ(numbers.count(), expected.size());
    EXPECT_EQ(numbers.find(expected.begin()->first), expected.begin()->second);
    EXPECT_EQ(numbers.find(4097), PlaneNumbers::kNone);
  }
}
}  // namespace
}  // namespace fastlio
