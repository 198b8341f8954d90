// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_advice.h"
#include "report_test_support.h"
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace fastlio
{
namespace
{
using testing::contentOf;
using testing::expectGoodPage;
using testing::reportOf;
using testing::smallMap;
using testing::TemporaryFolder;
using testing::troubled;
using testing::walk;

bool has(const std::string& html, const std::string& part)
{
  return html.find(part) != std::string::npos;
}

TEST(ReportHtml, AGoodRunIsSaidToBeGood)
{
  const std::string html = reportOf(walk(50));
  expectGoodPage(html);
  EXPECT_TRUE(has(html, "The run can be trusted: none of 50 scans was in trouble.")) << html;
  EXPECT_TRUE(has(html, "<header class=\"good\">"));
  EXPECT_TRUE(has(html, "The saved map has 5,000 points."));
  EXPECT_TRUE(has(html, "Nothing was dropped."));
}

TEST(ReportHtml, AStartThatTakesMostOfARunIsNamed)
{
  auto scans = walk(50);
  for (std::size_t i = 0; i < 30; ++i)
    scans[i].status = ScanStatus::Initializing;
  const std::string html = reportOf(scans);
  expectGoodPage(html);
  EXPECT_TRUE(has(html, "What there is can be trusted, but 30 of 50 scans have no pose")) << html;
  EXPECT_TRUE(has(html, "<header class=\"warn\">"));
}

/** The map of these reports is 2.5 km long and 5 m high, the walk is 5 m long. */
TEST(ReportHtml, ASmallPathHasAViewOfItsOwnAndLowHeightsAreStretched)
{
  const std::string html = reportOf(walk(50));
  EXPECT_TRUE(has(html, "<b>From above, the path closer</b>")) << html;
  EXPECT_TRUE(has(html, "Heights are drawn 200 times as large as distances along x.")) << html;
  EXPECT_FALSE(has(reportOf({}), "the path closer"));
}

TEST(ReportHtml, ABadStretchIsNamedWithItsFirstSecondAndWhatToTry)
{
  auto scans = walk(20);
  for (int i = 20; i < 30; ++i)
    scans.push_back(troubled(i, HealthCause::NoMatch, "3 of 500 points match"));
  const std::string html = reportOf(scans);
  expectGoodPage(html);
  EXPECT_TRUE(has(html, "Do not rely on 0.9 of 3.0 s of this run (1 stretch).")) << html;
  EXPECT_TRUE(has(html, "<b>First bad second: 2.1 s</b>"));
  EXPECT_TRUE(has(html, "3 of 500 points match"));
  EXPECT_TRUE(has(html, adviceOf(HealthCause::NoMatch).remedy));
  EXPECT_TRUE(has(html, "<a href=\"#no_match\">"));
  EXPECT_TRUE(has(html, "docs/troubleshooting.md#no_match"));
  EXPECT_TRUE(has(html, "not to rely on</span>")) << "the path in the map";
  EXPECT_FALSE(has(reportOf(walk(50)), "not to rely on</span>"));
  EXPECT_FALSE(has(html, "uncertain by"));
}

TEST(ReportHtml, AnUncertainEndIsInTheHeadline)
{
  auto scans = walk(20);
  scans.back().filter.P(kPosition, kPosition) = 100.0;
  EXPECT_TRUE(has(reportOf(scans), "The place of its end is uncertain by 10.0 m."))
      << reportOf(scans);
}

TEST(ReportHtml, TheLongestStretchIsExplainedAfterAnEarlierTrouble)
{
  auto scans = walk(10);
  scans.push_back(troubled(10, HealthCause::FewMatches, "a dog"));
  for (int i = 11; i < 60; ++i)
    scans.push_back(testing::resultAt(i, ScanStatus::Tracking, 0.1 * i, 1.0));
  for (int i = 60; i < 70; ++i)
    scans.push_back(troubled(i, HealthCause::Bias, "the bias ran"));
  const std::string html = reportOf(scans);
  expectGoodPage(html);
  EXPECT_TRUE(has(html, "<b>First bad second: 1.1 s</b>"));
  EXPECT_TRUE(has(html, "a dog"));
  EXPECT_TRUE(has(html, "<b>Longest stretch: 6.1 to 7.0 s</b>: the bias ran")) << html;
}

TEST(ReportHtml, ListsStayReadable)
{
  std::vector<ScanResult> scans;
  scans.reserve(3000);
  for (int i = 0; i < 3000; ++i)
    scans.push_back(
        i % 30 < 6 ? troubled(i, HealthCause::NoMatch, "why")
                   : testing::resultAt(i, ScanStatus::Tracking, 0.1 * i, 1.0));
  const std::string html = reportOf(scans);
  expectGoodPage(html);
  EXPECT_TRUE(has(html, "<li>and 50 more: untrusted.csv</li>")) << html.substr(0, 9000);
  EXPECT_LT(html.size(), 3'000'000U);
}

TEST(ReportHtml, EveryCauseOfTroubleGivesAPage)
{
  for (const HealthCause cause : allHealthCauses())
  {
    auto scans = walk(3);
    for (int i = 3; i < 9; ++i)
      scans.push_back(troubled(i, cause, "why"));
    const std::string html = reportOf(scans);
    expectGoodPage(html);
    EXPECT_TRUE(has(html, std::string("var(--c-") + toString(cause) + ")"));
    EXPECT_TRUE(has(html, std::string("--c-") + toString(cause) + ":#")) << "no colour";
  }
}

TEST(ReportHtml, WithoutAScanItSaysSo)
{
  const std::string html = reportOf({});
  expectGoodPage(html);
  EXPECT_TRUE(has(html, "There is no pose: nothing of this run can be used."));
  EXPECT_TRUE(has(html, "No scan could be processed"));
}

TEST(ReportHtml, WithoutAMapItSaysSo)
{
  const std::string html = reportOf(
      {testing::resultAt(0, ScanStatus::FirstScan, 0, 1),
       testing::resultAt(1, ScanStatus::FirstScan, 0, 1)});
  expectGoodPage(html);
  EXPECT_TRUE(has(html, "There is no map: nothing of this run can be used."));
  EXPECT_FALSE(has(html, "can be trusted"));
}

TEST(ReportHtml, WithoutAPoseItSaysWhy)
{
  const std::string html = reportOf({testing::resultAt(0, ScanStatus::Initializing, 0, 1)});
  expectGoodPage(html);
  EXPECT_TRUE(has(html, "There is no pose"));
  EXPECT_TRUE(has(html, "because of &quot;this&quot;"));
}

TEST(ReportHtml, TextOfOthersStaysText)
{
  const std::string hostile = "<script>alert('1')</script> & \"\x01\xff\" <!-- -->]]>";
  RunSummary run;
  run.inputs = {{hostile, 1}};
  run.configuration = run.program = run.version = run.frame = run.failure = hostile;
  run.sensors = run.input_problems = run.output_problems = {hostile};
  run.diagnostics = {{0, hostile}};
  run.input_counts = {{hostile, 3}};
  run.options = {{hostile, hostile, true}};
  run.defaults = {{hostile, "other", true}};
  const TemporaryFolder folder;
  const std::string html = reportOf(
      {testing::resultAt(0, ScanStatus::Tracking, 0, 1),
       troubled(1, HealthCause::NoMatch, hostile)},
      run, folder.file("<b>'\"&\xff"));
  expectGoodPage(html);
  EXPECT_FALSE(has(html, "alert('1')"));
  EXPECT_FALSE(has(html, "\xff"));
  EXPECT_TRUE(has(html, "&lt;script&gt;alert(&#39;1&#39;)"));
}

TEST(ReportHtml, NumbersThatAreNoneBreakNothing)
{
  auto scans = walk(20);
  const double nan = std::nan("");
  scans[5].statistics.residual_rms = INFINITY;
  scans[6].statistics.normalized_innovation = nan;
  scans[7].filter.x.p = {nan, 1e300, -std::numeric_limits<double>::infinity()};
  scans[12].filter.x.p = {-1.7e308, 1.7e308, 1.7e308};
  scans[8].filter.x.v.setConstant(1e308);
  scans[9].filter.P.setConstant(nan);
  scans[10].health.value = nan;
  expectGoodPage(reportOf(scans));
}

/** The table cell behind a name. */
std::string cellOf(const std::string& html, const std::string& name)
{
  const std::string begin = "<tr><th>" + name + "</th><td>";
  const auto at = html.find(begin);
  if (at == std::string::npos) return "no " + name;
  return html.substr(at + begin.size(), html.find("</td>", at) - at - begin.size());
}

TEST(ReportHtml, ItsNumbersAreThoseOfTheSummary)
{
  auto scans = walk(40);
  scans[20] = troubled(20, HealthCause::NoMatch, "few");
  RunSummary run;
  run.input_counts = {{"imu_not_finite", 3}, {"imu_samples", 100}, {"imu_spikes", 0}};
  const std::string html = reportOf(scans, run);
  for (const ScanResult& scan : scans)
    run.statistics.add(scan);
  const TemporaryFolder folder;
  (void)makeSummaryExporter(folder.file("s.json"))->finish({run, *smallMap()});
  const auto json = nlohmann::json::parse(contentOf(folder.file("s.json")));
  EXPECT_EQ(
      cellOf(html, "Status"), json["status"].get<std::string>() + " (exit status " +
                                  std::to_string(json["exit_status"].get<int>()) + ")");
  EXPECT_EQ(
      cellOf(html, "Time"), fixedText(json["time"]["duration_s"], 3) + " s, from " +
                                json["time"]["begin"].get<std::string>() + " to " +
                                json["time"]["end"].get<std::string>());
  EXPECT_EQ(cellOf(html, "Path"), fixedText(json["path_length_m"], 3) + " m");
  EXPECT_EQ(cellOf(html, "Scans"), "40: 1 first scan, 38 tracking, 1 prediction only");
  EXPECT_EQ(json["scans"]["prediction_only"], 1);
  EXPECT_EQ(
      cellOf(html, "Health"), "mean " + fixedText(json["health"]["mean"], 3) + ", worst " +
                                  fixedText(json["health"]["worst"], 3) + "; " +
                                  std::to_string(json["health"]["troubled"].get<int>()) +
                                  " of 40 scans in trouble");
  EXPECT_EQ(cellOf(html, "imu_not_finite"), "3");
  EXPECT_EQ(cellOf(html, "imu_samples"), "no imu_samples");
  EXPECT_TRUE(has(
      html, "First bad second: " + fixedText(json["health"]["first_trouble"]["second"], 1) + " s"));
}

TEST(ReportHtml, ParametersThatDifferAreListedWithTheirDefaults)
{
  RunSummary run;
  run.options = {{"map.voxel_size", "0.7", false}, {"threads", "1", false}};
  run.defaults = {{"map.voxel_size", "0.4", false}, {"threads", "1", false}};
  const std::string html = reportOf(walk(3), run);
  EXPECT_TRUE(has(html, "<tr><td><code>map.voxel_size</code></td><td>0.7</td><td>0.4</td></tr>"));
  EXPECT_FALSE(has(html, "<code>threads</code></td><td>1</td><td>"));
  EXPECT_TRUE(has(reportOf(walk(3)), "All parameters"));
}

TEST(ReportHtml, OnlyTheLastSectionDependsOnTheMachine)
{
  auto fast = walk(30), slow = fast;
  for (ScanResult& scan : slow)
    scan.milliseconds.total *= 3.0;
  RunSummary later;
  later.wall_seconds = 7.0;
  const std::string one = reportOf(fast), other = reportOf(slow, later);
  EXPECT_NE(one, other);
  const auto begin = one.find("<!-- measured");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_EQ(one.substr(0, begin), other.substr(0, begin));
}

TEST(ReportHtml, ALongRunIsNoLargePage)
{
  const std::string html = reportOf(walk(30'000));
  expectGoodPage(html);
  EXPECT_LT(html.size(), 3'000'000U);
  EXPECT_TRUE(has(html, "none of 30,000 scans"));
}

TEST(ReportHtml, WithoutTheMapTheRestIsThere)
{
  const TemporaryFolder folder;
  ExportTarget target;
  target.directory = folder.path();
  ExporterSet set;
  set.add(makeReportExporter(target), folder.file("report.html"));
  EXPECT_TRUE(set.needMap());
  set.giveUpMap("the disk is full");
  EXPECT_FALSE(set.needMap());
  const RunSummary done = set.finish(testing::goodRun(), *smallMap());
  EXPECT_TRUE(done.output_problems.empty());
  const std::string html = contentOf(folder.file("report.html"));
  expectGoodPage(html);
  EXPECT_TRUE(has(html, "The map is not complete: the disk is full"));
}

/** With --no-map-update no point is saved. */
TEST(ReportHtml, WithoutPointsNothingIsSaidOfTheirColours)
{
  const std::string html = reportOf(walk(20), testing::goodRun(), "", OutputMap());
  EXPECT_TRUE(has(html, "The saved map has no points.")) << html;
  EXPECT_FALSE(has(html, "Colours show the height"));
  EXPECT_FALSE(has(html, "Where points are denser"));
}
}  // namespace
}  // namespace fastlio
