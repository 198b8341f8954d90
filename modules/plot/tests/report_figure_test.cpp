// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/plot/report_figure.h>

#include <gtest/gtest.h>

namespace fastlio
{
TEST(Page, HoldsItsTextEscapedAndNeedsNoOtherFile)
{
  const std::string html = pageHtml(
      {"a < b", "warn", "Keep \"x\" & y", "from <script>.rawlog",
       sectionHtml("Errors <m>", "<p>content</p>")});
  EXPECT_NE(html.find("<title>a &lt; b</title>"), std::string::npos) << html;
  EXPECT_NE(html.find("<header class=\"warn\">"), std::string::npos);
  EXPECT_NE(html.find("&amp; y</h1>"), std::string::npos);
  EXPECT_NE(html.find("<h2>Errors &lt;m&gt;</h2>\n<p>content</p>"), std::string::npos);
  for (const char* foreign : {"<script", "http:", "https:", "src=", "@import", "url("})
    EXPECT_EQ(html.find(foreign), std::string::npos) << foreign;
  EXPECT_EQ(html.rfind("</html>\n"), html.size() - 8);
}

TEST(Figure, HasItsTitleLegendAndRemark)
{
  PlotPanel panel;
  panel.series = {{"s", "red", {{0, 0}, {1, 2}}}};
  const std::string html =
      figureHtml(panel, {0, 0, 400, 200}, "Speed <v>", {{"truth", "green"}}, "<b>note</b>");
  for (const char* part :
       {"<b>Speed &lt;v&gt;</b>", "background:green", "truth", "viewBox=\"0 0 400 200\"",
        "<p><b>note</b></p>", "</svg>", "</figure>"})
    EXPECT_NE(html.find(part), std::string::npos) << part << "\n" << html;
  EXPECT_EQ(figureHtml(panel, {0, 0, 4, 2}, "t", {}, "").find("<p>"), std::string::npos);
}

TEST(ReportFigure, ACountHasItsThousandsApart)
{
  EXPECT_EQ(countText(0), "0");
  EXPECT_EQ(countText(999), "999");
  EXPECT_EQ(countText(51527), "51,527");
  EXPECT_EQ(countText(1000000), "1,000,000");
}
}  // namespace fastlio
