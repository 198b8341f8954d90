// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/plot/svg_plot.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
std::size_t countOf(const std::string& text, const std::string& part)
{
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

PlotPanel panelOf(PlotSeries series)
{
  PlotPanel panel;
  panel.series = {std::move(series)};
  return panel;
}

constexpr PlotRectangle kPlace{0.0, 0.0, 400.0, 200.0};

TEST(Svg, TicksAreRoundNumbersInside)
{
  EXPECT_EQ(roundTicks(0.0, 10.0, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(roundTicks(-1.0, 1.0, 2), (std::vector<double>{-1, 0, 1}));
  EXPECT_TRUE(roundTicks(1.0, 1.0, 5).empty());
  EXPECT_TRUE(roundTicks(0.0, std::nan(""), 5).empty());
}

TEST(Svg, TextIsEscaped)
{
  EXPECT_EQ(escapeXml("a<b>&\"c\"'d'\x01"), "a&lt;b&gt;&amp;&quot;c&quot;&#39;d&#39;");
}

TEST(Svg, ALineBreaksWhereThereIsNoNumber)
{
  const double nan = std::nan("");
  const std::string svg =
      drawPanel(panelOf({"", "red", {{0, 0}, {1, 1}, {2, nan}, {3, INFINITY}, {4, 1}}}), kPlace);
  EXPECT_EQ(countOf(svg, "<polyline"), 2U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Svg, ABandBreaksWhereThereIsNoNumber)
{
  PlotPanel panel;
  panel.bands = {{"red", {{0, -1, 1}, {1, -1, 1}, {2, std::nan(""), 1}, {3, -1, 1}}}};
  const std::string svg = drawPanel(panel, kPlace);
  EXPECT_EQ(countOf(svg, "<polygon"), 2U);
  EXPECT_EQ(
      countOf(svg, "'/>"),
      countOf(svg, "<polygon") + countOf(svg, "<line") + countOf(svg, "<rect"));
}

TEST(Svg, CellsThatTouchAreOneStroke)
{
  PlotPanel panel;
  panel.cells = {{"red", 1.0, 1.0, {{0, 0}, {2, 0}, {1, 0}, {5, 0}, {0, 1}}}};
  const std::string svg = drawPanel(panel, kPlace);
  EXPECT_EQ(countOf(svg, "M"), 3U) << svg;
}

TEST(Svg, AStretchOfAMomentIsSeen)
{
  PlotPanel panel = panelOf({"", "red", {{0, 0}, {1000, 1}}});
  panel.stretches = {{500, 500, "blue", "<why>"}};
  const std::string svg = drawPanel(panel, kPlace);
  EXPECT_NE(svg.find("width='1.5'"), std::string::npos) << svg;
  EXPECT_NE(svg.find("<title>&lt;why&gt;</title>"), std::string::npos) << svg;
}

TEST(Svg, AnAxisHasAtLeastThreeTicks)
{
  for (const PlotRange& range : {PlotRange{-7.0, 22.0}, PlotRange{0.4, 1.3}, PlotRange{-3.0, 1.0}})
    for (const int count : {1, 2, 5})
      EXPECT_GE(axisTicks(range, count).size(), 3U) << range.low << " " << count;
  EXPECT_TRUE(axisTicks({1.0, 1.0}, 5).empty());
}

TEST(Svg, TicksMayBeGivenWithTheirTexts)
{
  PlotPanel panel = panelOf({"", "red", {{-2, 0}, {0, 3}}});
  panel.x_ticks = {{-2, "0.01"}, {-1, "0.1"}, {0, "1"}};
  panel.y_ticks = {{3, "3 or more"}};
  const std::string svg = drawPanel(panel, kPlace);
  EXPECT_NE(svg.find(">0.01<"), std::string::npos) << svg;
  EXPECT_NE(svg.find(">3 or more<"), std::string::npos) << svg;
  EXPECT_EQ(svg.find(">-2<"), std::string::npos) << svg;
}

TEST(Svg, AStretchedAxisHasLongerUnits)
{
  PlotPanel panel;
  panel.equal_scales = true;
  panel.x_range = PlotRange{0.0, 100.0};
  panel.y_range = PlotRange{0.0, 2.0};
  panel.y_stretch = 10.0;
  panel.cells = {{"red", 1.0, 10.0, {{50.0, 1.0}}, 1.0}};
  // Inside of the margins there are 324 x 150 pixels.
  const std::string svg = drawPanel(panel, kPlace);
  EXPECT_NE(svg.find("stroke-width='32.5'"), std::string::npos) << svg;
  EXPECT_NE(svg.find("h32.4"), std::string::npos) << svg;
}

TEST(Svg, AStretchMayHaveALabel)
{
  PlotPanel panel = panelOf({"", "red", {{0, 0}, {10, 1}}});
  panel.stretches = {{5, 10, "blue", "why", "the second run"}};
  EXPECT_NE(drawPanel(panel, kPlace).find(">the second run</text>"), std::string::npos);
}

TEST(Svg, NamesOfMarksAtOnePlaceLieBelowEachOther)
{
  PlotPanel panel = panelOf({"", "red", {{0, 0}, {10, 10}}});
  panel.marks = {{{1, 1}, "one", "red"}, {{1, 1}, "two", "red"}, {{1, 1}, "", "red"}};
  const std::string svg = drawPanel(panel, kPlace);
  const auto heightOf = [&svg](const std::string& name)
  {
    const auto end = svg.find(">" + name + "<");
    const auto begin = svg.rfind("y='", end) + 3;
    return std::stod(svg.substr(begin, svg.find('\'', begin) - begin));
  };
  EXPECT_NEAR(heightOf("two") - heightOf("one"), 14.0, 0.2) << svg;
  EXPECT_EQ(countOf(svg, "<circle"), 3U);
}

TEST(Svg, AnEmptyPanelHasAxes)
{
  const std::string svg = drawPanel({}, kPlace);
  EXPECT_NE(svg.find(">0.5<"), std::string::npos) << svg;
}

}  // namespace
}  // namespace fastlio
