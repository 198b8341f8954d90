// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file report_test_support.h Reports of made-up runs, and what any page has to keep. */
#pragma once

#include "output_test_support.h"
#include <fastlio/exporters/standard_exporters.h>

#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** A folder besides the TemporaryFolder of the test; removed at the end. */
class FurtherFolder
{
 public:
  FurtherFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "fastlio-report-XXXXXX").string();
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    path_ = name;
  }
  ~FurtherFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FurtherFolder(const FurtherFolder&) = delete;
  FurtherFolder& operator=(const FurtherFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/** report.html for these scans. \param run is completed with them */
inline std::string reportOf(
    const std::vector<ScanResult>& scans, RunSummary run = {}, const std::string& reference = {},
    const OutputMap& map = *smallMap())
{
  const FurtherFolder folder;
  ExportTarget target;
  target.directory = folder.path();
  target.reference = reference;
  ExporterSet set;
  set.add(makeReportExporter(target), folder.file("report.html"));
  for (const ScanResult& scan : scans)
  {
    set.onScan(scan);
    run.statistics.add(scan);
  }
  const RunSummary done = set.finish(std::move(run), map);
  EXPECT_TRUE(set.problems().empty());
  EXPECT_EQ(done.outputs.size(), 1U);
  return contentOf(folder.file("report.html"));
}

/** A walk along x at 1 m/s. */
inline std::vector<ScanResult> walk(int scans)
{
  std::vector<ScanResult> results;
  for (int i = 0; i < scans; ++i)
    results.push_back(
        resultAt(i, i == 0 ? ScanStatus::FirstScan : ScanStatus::Tracking, 0.1 * i, 1.0 + i % 7));
  return results;
}

/** A scan without a correction. */
inline ScanResult troubled(int index, HealthCause cause, const std::string& reason)
{
  ScanResult result = resultAt(index, ScanStatus::PredictionOnly, 0.1 * index, 1.0);
  result.health = {0.2, cause, reason};
  return result;
}

/** A tag of a page. */
struct Tag
{
  std::string name;
  bool closes = false, is_empty = false, is_good = false;
};

/** \param text from '<' to '>' */
inline Tag tagOf(const std::string& text)
{
  Tag tag;
  std::size_t at = 1;
  tag.closes = text.at(at) == '/';
  at += tag.closes ? 1 : 0;
  while (std::isalnum(static_cast<unsigned char>(text.at(at))) != 0)
    tag.name += text.at(at++);
  while (text.at(at) == ' ')
  {
    const std::size_t equals = text.find('=', ++at);
    if (equals == std::string::npos) return tag;
    const char quote = text.at(equals + 1);
    const std::size_t end = text.find(quote, equals + 2);
    if ((quote != '"' && quote != '\'') || end == std::string::npos) return tag;
    if (text.substr(equals + 2, end - equals - 2).find('<') != std::string::npos) return tag;
    at = end + 1;
  }
  tag.is_empty = text.at(at) == '/';
  at += tag.is_empty ? 1 : 0;
  tag.is_good = !tag.name.empty() && at + 1 == text.size();
  return tag;
}

/** Every element is closed in its order, and attributes are quoted. */
inline void expectWellFormed(const std::string& html)
{
  std::vector<std::string> open;
  std::size_t at = html.find('\n');  // after the document type
  while ((at = html.find('<', at)) != std::string::npos)
  {
    if (html.compare(at, 4, "<!--") == 0)
    {
      at = html.find("-->", at);
      ASSERT_NE(at, std::string::npos);
      continue;
    }
    const std::string text = html.substr(at, html.find('>', at) + 1 - at);
    const Tag tag = tagOf(text);
    ASSERT_TRUE(tag.is_good) << text.substr(0, 200);
    at += text.size();
    if (tag.is_empty) continue;
    if (!tag.closes)
    {
      open.push_back(tag.name);
      continue;
    }
    ASSERT_FALSE(open.empty()) << text;
    ASSERT_EQ(open.back(), tag.name);
    open.pop_back();
  }
  EXPECT_TRUE(open.empty());
}

/** Drawings have places that are numbers. */
inline void expectFiniteDrawings(const std::string& html)
{
  std::size_t begin = 0, drawings = 0;
  while ((begin = html.find("<svg", begin)) != std::string::npos)
  {
    const std::size_t end = html.find("</svg>", begin);
    ASSERT_NE(end, std::string::npos);
    const std::string drawing = html.substr(begin, end - begin);
    EXPECT_EQ(drawing.find("nan"), std::string::npos) << drawing.substr(0, 200);
    EXPECT_EQ(drawing.find("inf"), std::string::npos) << drawing.substr(0, 200);
    begin = end;
    ++drawings;
  }
  EXPECT_GE(drawings, 18U);
}

/** Nothing is loaded from anywhere, and nothing runs. */
inline void expectOffline(const std::string& html)
{
  for (const char* part :
       {"http:", "https:", "//", "src=", "@import", "url(", "<script", "<link", "<iframe",
        " onload", " onclick"})
    EXPECT_EQ(html.find(part), std::string::npos) << part;
}

/** Links lead to places of the page. */
inline void expectLinksLead(const std::string& html)
{
  static const std::regex kLink("href=\"#([^\"]*)\""), kPlace(" id=\"([^\"]*)\"");
  std::set<std::string> places;
  for (std::sregex_iterator it(html.begin(), html.end(), kPlace), end; it != end; ++it)
    EXPECT_TRUE(places.insert((*it)[1]).second) << (*it)[1];
  for (std::sregex_iterator it(html.begin(), html.end(), kLink), end; it != end; ++it)
    EXPECT_EQ(places.count((*it)[1]), 1U) << (*it)[1];
}

inline void expectGoodPage(const std::string& html)
{
  EXPECT_EQ(html.rfind("<!DOCTYPE html>\n", 0), 0U);
  expectWellFormed(html);
  expectOffline(html);
  expectLinksLead(html);
  expectFiniteDrawings(html);
}

}  // namespace fastlio::testing
