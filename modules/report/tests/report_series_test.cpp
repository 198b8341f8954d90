// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_test_support.h"
#include <fastlio/report/report_series.h>

#include <vector>

namespace fastlio
{
namespace
{
using testing::reportOf;
using testing::resultAt;
using testing::walk;

/** Every second scan has no pose: those of the others are not lost when bins become one. */
TEST(ReportSeries, ABinHasThePositionOfItsLastPose)
{
  ReportSeries series{Pose{}};
  for (int i = 0; i < 1000; ++i)
    series.add(resultAt(i, i % 2 == 0 ? ScanStatus::Tracking : ScanStatus::Diverged, 1.0 + i, 1.0));
  const std::vector<ReportBin>& bins = series.bins();
  ASSERT_EQ(bins.size(), 500U);
  for (std::size_t i = 0; i < bins.size(); ++i)
  {
    ASSERT_TRUE(bins[i].position) << i;
    EXPECT_EQ(bins[i].position->x(), 1.0 + 2.0 * static_cast<double>(i));
  }
}

std::size_t areasIn(const std::string& html)
{
  std::size_t areas = 0;
  for (std::size_t at = html.find("<polygon"); at != std::string::npos;
       at = html.find("<polygon", at + 1))
    ++areas;
  return areas;
}

/** Lines break there, and so do the standard deviations around them: three axes of two biases. */
TEST(ReportSeries, NoAreaIsDrawnAcrossATimeWithoutScans)
{
  std::vector<ScanResult> scans = walk(50);
  const std::size_t whole = areasIn(reportOf(scans));
  EXPECT_GE(whole, 6U);
  for (int i = 300; i < 350; ++i)
    scans.push_back(resultAt(i, ScanStatus::Tracking, 0.1 * i, 1.0));
  EXPECT_EQ(areasIn(reportOf(scans)), whole + 6U);
}

}  // namespace
}  // namespace fastlio
