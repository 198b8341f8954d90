// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_matching.h"
#include <fastlio/matching/measured_scan.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace fastlio
{
namespace
{
/** Eq. 20's sums one measurement at a time. */
InformationSums sumOneByOne(const Matching& m, const ResidualModel& model)
{
  InformationSums sums;
  for (std::size_t i = 0; i < m.body.size(); ++i)
  {
    if (!m.matches[i].valid()) continue;
    const PlaneMeasurement one = planeMeasurement(m.x.pose(), m.body, i, m.matches[i], model);
    if (!isConsistent(one, model)) continue;
    const double weight = 1.0 / one.variance;
    sums.HtRinvH += weight * one.h * one.h.transpose();
    sums.HtRinvz += weight * one.z * one.h;
    sums.weighted_squares += weight * one.z * one.z;
    sums.squares += one.z * one.z;
    ++sums.count;
  }
  return sums;
}

TEST(MeasuredScan, SumsUpItsMeasurements)
{
  const Matching m = randomMatching(5, 1000);
  for (const double gate : {1.0, 3.0, 1e6})
  {
    ResidualModel model;
    model.gate = gate;
    const InformationSums sums = measured(m, model).sums();
    expectEqual(sums, sumOneByOne(m, model));
    EXPECT_EQ(sums.HtRinvH, sums.HtRinvH.transpose());
    if (gate == 1e6)
    {
      EXPECT_EQ(sums.count, 1000U - 143U) << "each seventh has no plane";
    }
  }
}

TEST(MeasuredScan, LeavesOutWhatIsNoNumber)
{
  Matching m = randomMatching(9, 100);
  m.body.x[3] = m.matches[17].nx = m.matches[50].d = std::nanf("");
  m.body.ux[80] = std::numeric_limits<float>::infinity();
  const InformationSums sums = measured(m, wideOpen()).sums();
  EXPECT_TRUE(sums.HtRinvH.allFinite());
  EXPECT_TRUE(sums.HtRinvz.allFinite());
  expectEqual(sums, sumOneByOne(m, wideOpen()));
}

/** The measurements in the order of the blocks. */
std::vector<std::size_t> indicesOf(const MeasuredScan& scan)
{
  std::vector<std::size_t> indices;
  scan.forEachBlock(
      [&](const MeasurementBlock& block, std::size_t)
      {
        for (std::size_t l = 0; l < kLanes; ++l)
          if (block.weight[l] > 0.0) indices.push_back(block.index[l]);
      });
  return indices;
}

TEST(MeasuredScan, HoldsEachConsistentMatchOnceAndInOrder)
{
  const ResidualModel model;
  for (const std::size_t n : {0, 1, 8, 9, 256, 257, 1025})
  {
    const Matching m = randomMatching(static_cast<unsigned>(n + 1), n, 0.05);
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < n; ++i)
      if (m.matches[i].valid() &&
          isConsistent(planeMeasurement(m.x.pose(), m.body, i, m.matches[i], model), model))
        expected.push_back(i);
    EXPECT_EQ(indicesOf(measured(m, model)), expected) << n << " points";
  }
}

TEST(MeasuredScan, ALaneIsTheMeasurementOfItsPoint)
{
  const Matching m = randomMatching(11, 300);
  measured(m, wideOpen())
      .forEachBlock(
          [&](const MeasurementBlock& block, std::size_t)
          {
            for (std::size_t l = 0; l < kLanes; ++l)
            {
              const PointMeasurement point = block.point(l);
              if (point.weight == 0.0)
              {
                EXPECT_EQ(point.z, 0.0);
                EXPECT_TRUE(point.weighted_h.isZero(0.0));
                continue;
              }
              const std::size_t i = block.index[l];
              const PlaneMeasurement one =
                  planeMeasurement(m.x.pose(), m.body, i, m.matches[i], wideOpen());
              EXPECT_NEAR(point.weight, 1.0 / one.variance, 1e-9 / one.variance);
              EXPECT_NEAR(point.z, one.z, 1e-12);
              EXPECT_LT((point.weighted_h - one.h / one.variance).norm(), 1e-9 * point.weight);
            }
          });
}

TEST(MeasuredScan, ForgetsTheScanBefore)
{
  const Matching large = randomMatching(12, 1000), small = randomMatching(13, 10);
  MeasuredScan scan = measured(large, wideOpen());
  scan.measure(Workers(1), small.x.pose(), {}, {}, wideOpen());
  EXPECT_EQ(scan.sums().count, 0U);
  scan.measure(Workers(1), small.x.pose(), small.body, small.matches, wideOpen());
  EXPECT_EQ(indicesOf(scan).size(), scan.sums().count);
  expectEqual(scan.sums(), sumOneByOne(small, wideOpen()));
}

TEST(MeasuredScan, IsTheSameOnSeveralThreads)
{
  const Matching m = randomMatching(15, 2000);
  MeasuredScan several;
  several.measure(Workers(3), m.x.pose(), m.body, m.matches, wideOpen());
  const MeasuredScan one = measured(m, wideOpen());
  EXPECT_EQ(several.sums().HtRinvH, one.sums().HtRinvH);
  EXPECT_EQ(several.sums().HtRinvz, one.sums().HtRinvz);
  EXPECT_EQ(indicesOf(several), indicesOf(one));
}
}  // namespace
}  // namespace fastlio
