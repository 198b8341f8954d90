// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_test_support.h"
#include <fastlio/options/number_text.h>
#include <fastlio/report/report_reference.h>
#include <fastlio/report/report_series.h>

#include <filesystem>
#include <fstream>

namespace fastlio
{
namespace
{
using testing::expectGoodPage;
using testing::kPeriod;
using testing::kRunStart;
using testing::reportOf;
using testing::TemporaryFolder;
using testing::walk;

/** The truth of walk() on a curve that walk() does not see. */
void writeTruth(const std::string& path, int poses, double bend)
{
  std::ofstream out(path);
  for (int i = 0; i < poses; ++i)
  {
    const double x = 0.1 * i;
    out << secondsText(kRunStart + (i + 1) * kPeriod) << ' ' << x << ' ' << bend * x * x
        << " 0 0 0 0 1\n";
  }
}

bool says(const std::string& html, const std::string& part)
{
  return html.find(part) != std::string::npos;
}

TEST(ReportReference, ErrorsAreThoseOfTheEvaluation)
{
  const TemporaryFolder folder;
  const std::string truth = folder.file("a.gt.tum");
  writeTruth(truth, 40, 0.05);
  ReferenceComparison comparison(truth, {});
  for (const ScanResult& scan : walk(40))
    comparison.add(scan);
  const ReferenceFindings findings = comparison.findings();
  ASSERT_TRUE(findings.report) << findings.problem;
  const std::string html = reportOf(walk(40), {}, truth);
  expectGoodPage(html);
  EXPECT_GT(findings.report->ape.translation.rmse, 0.01);
  EXPECT_TRUE(says(html, fixedText(findings.report->ape.translation.rmse, 4)));
  EXPECT_TRUE(says(html, fixedText(findings.report->nees->pose.mean, 2)));
  for (const char* part :
       {"40 of 40 poses", "poses of the body \u201cimu\u201d", "NEES of the pose",
        "Position error, z"})
    EXPECT_TRUE(says(html, part)) << part;
}

TEST(ReportReference, AStraightLineIsAlignedByItsStart)
{
  const TemporaryFolder folder;
  writeTruth(folder.file("a.gt.tum"), 40, 0.0);
  const std::string html = reportOf(walk(40), {}, folder.file("a.gt.tum"));
  EXPECT_TRUE(says(html, "Alignment of APE: first")) << html;
}

TEST(ReportReference, ANearlyStraightPathIsAlignedByItsStart)
{
  const TemporaryFolder folder;
  writeTruth(folder.file("a.gt.tum"), 40, 0.005);
  std::vector<ScanResult> scans = walk(40);
  for (std::size_t i = 0; i < scans.size(); ++i)
    scans[i].filter.x.p.z() += 0.02 * std::sin(0.2 * static_cast<double>(i));
  const std::string html = reportOf(scans, {}, folder.file("a.gt.tum"));
  EXPECT_TRUE(says(html, "Alignment of APE: first"));
}

TEST(ReportReference, ADamagedReferenceFailsNoRun)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("text")) << "<b>no numbers</b>\n";
  std::ofstream(folder.file("empty")) << "";
  writeTruth(folder.file("elsewhen"), 1, 0.0);
  std::ofstream(folder.file("binary"), std::ios::binary) << std::string(1000, '\xfe');
  std::ofstream(folder.file("huge")) << "";
  std::filesystem::resize_file(folder.file("huge"), ReferenceComparison::kLargestFile + 1);
  for (const char* name : {"text", "empty", "elsewhen", "binary", "missing", ".", "huge"})
  {
    const std::string html = reportOf(walk(5), {}, folder.file(name));
    expectGoodPage(html);
    EXPECT_TRUE(says(html, "could not be used: ")) << name;
    const bool missing = std::string(name) == "missing";
    EXPECT_EQ(says(html, "does not exist"), missing) << name << html.substr(0, 20000);
    EXPECT_TRUE(says(html, "The run can be trusted")) << name;
  }
  const std::string html = reportOf({}, {}, folder.file("text"));
  EXPECT_TRUE(says(html, "the run has no pose to compare"));
}

TEST(ReportReference, OfALongRunOnlySomePosesAreCompared)
{
  const TemporaryFolder folder;
  writeTruth(folder.file("t"), 50, 0.01);
  ReferenceComparison comparison(folder.file("t"), {});
  const auto scans = static_cast<int>(2 * ReferenceComparison::kMaxPoses + 10);
  for (int i = 0; i < scans; ++i)
    comparison.add(testing::resultAt(i, ScanStatus::Tracking, 0.1 * i, 1.0));
  const ReferenceFindings findings = comparison.findings();
  ASSERT_TRUE(findings.report) << findings.problem;
  EXPECT_EQ(findings.poses_per_sample, 4U);
  EXPECT_LE(findings.report->association.estimated, ReferenceComparison::kMaxPoses);
  EXPECT_EQ(findings.report->association.used, 13U);  // each fourth of fifty
}

TEST(ReportReference, IsFoundBesideTheRecording)
{
  const TemporaryFolder folder;
  const std::string recording = folder.file("walk.rawlog");
  EXPECT_EQ(referenceFor("", {}), "");
  EXPECT_EQ(referenceFor("", {recording}), "");
  writeTruth(folder.file("walk.gt.tum"), 2, 0.0);
  EXPECT_EQ(referenceFor("", {recording}), folder.file("walk.gt.tum"));
  EXPECT_EQ(referenceFor("given", {recording}), "given");
}

TEST(ReportSeries, KeepsExtremesInBoundedMemory)
{
  ReportSeries series{Pose{}};
  constexpr int kScans = 20'000;
  for (int i = 0; i < kScans; ++i)
  {
    ScanResult scan = testing::resultAt(i, ScanStatus::Tracking, 0.1 * i, 1.0);
    scan.statistics.residual_rms = i == 12'345 ? 0.5 : 0.02;
    if (i == 7'777) scan.health = {0.1, HealthCause::LargeResidual, "why"};
    series.add(scan);
  }
  ASSERT_LE(series.bins().size(), ReportSeries::kMaxBins);
  EXPECT_GT(series.bins().size(), ReportSeries::kMaxBins / 3);
  EXPECT_LE(series.path().size(), ReportSeries::kMaxPath + 1);
  float highest = 0.0F, lowest = 1e9F;
  std::size_t troubled = 0;
  for (const ReportBin& bin : series.bins())
  {
    highest = std::max(highest, bin.high[kResidualChannel]);
    lowest = std::min(lowest, bin.low[kResidualChannel]);
    troubled += bin.cause == HealthCause::LargeResidual ? 1 : 0;
  }
  EXPECT_FLOAT_EQ(highest, 500.0F);
  EXPECT_FLOAT_EQ(lowest, 20.0F);
  EXPECT_EQ(troubled, 1U);
  EXPECT_NEAR(series.bins().front().begin_s, 0.0, 1e-9);
  EXPECT_NEAR(series.bins().back().end_s, 0.1 * kScans, 1e-6);
  EXPECT_EQ(series.path().front().x(), 0.0);
  EXPECT_EQ(series.path().back().x(), 0.1 * (kScans - 1));
}

TEST(ReportSeries, BinsFollowEachOther)
{
  ReportSeries series{Pose{}};
  for (int i = 0; i < 5'001; ++i)
    series.add(testing::resultAt(i, ScanStatus::Tracking, 0.0, 1.0));
  for (std::size_t i = 1; i < series.bins().size(); ++i)
    EXPECT_NEAR(series.bins()[i].begin_s, series.bins()[i - 1].end_s, 1e-6) << i;
}

}  // namespace
}  // namespace fastlio
