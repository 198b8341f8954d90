// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// docs/troubleshooting.md against the causes, statuses and messages of the sources.

#include "report_advice.h"
#include "temporary_folder.h"
#include <fastlio/run/run_summary.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

namespace fastlio
{
namespace
{
using testing::contentOf;
namespace fs = std::filesystem;

const fs::path kSource = FASTLIO_SOURCE_DIR;

std::string page()
{
  return contentOf((kSource / "docs/troubleshooting.md").string());
}

/** Of a heading, as viewers of Markdown make it. */
std::string anchorOfHeading(const std::string& heading)
{
  std::string anchor;
  for (const char c : heading)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '_' || c == '-')
      anchor += static_cast<char>(std::tolower(byte));
    else if (c == ' ')
      anchor += '-';
  }
  return anchor;
}

std::set<std::string> anchors()
{
  std::set<std::string> found;
  std::istringstream lines(page());
  for (std::string line; std::getline(lines, line);)
  {
    const auto begin = line.find_first_not_of('#');
    if (begin == 0 || begin == std::string::npos) continue;
    EXPECT_TRUE(found.insert(anchorOfHeading(line.substr(begin + 1))).second) << line;
  }
  return found;
}

TEST(Troubleshooting, EveryCauseHasItsSection)
{
  const auto found = anchors();
  // HealthCause has no last value to count to: the names end where toString() does.
  std::size_t causes = 0;
  for (int i = 1;; ++i, ++causes)
  {
    std::string name;
    try
    {
      name = toString(static_cast<HealthCause>(i));
    }
    catch (const std::out_of_range&)
    {
      break;
    }
    EXPECT_EQ(found.count(name), 1U) << name;
    EXPECT_NE(std::string(adviceOf(static_cast<HealthCause>(i)).meaning), "") << name;
    EXPECT_NE(std::string(adviceOf(static_cast<HealthCause>(i)).remedy), "") << name;
  }
  EXPECT_EQ(causes, allHealthCauses().size());
}

TEST(Troubleshooting, EveryStatusHasItsSection)
{
  const auto found = anchors();
  for (std::size_t i = 0; i < kScanStatusCount; ++i)
  {
    const std::string name = toString(static_cast<ScanStatus>(i));
    EXPECT_EQ(found.count(anchorOfHeading(name)), 1U) << name;
  }
}

TEST(Troubleshooting, EveryExitStatusHasItsSection)
{
  const auto found = anchors();
  std::size_t known = 0;
  for (int i = 0; i < 256; ++i)
  {
    const std::string name = toString(static_cast<ExitStatus>(i));
    if (name == "unknown") continue;
    ++known;
    const std::string anchor = "exit-status-" + std::to_string(i) + "-" + name;
    EXPECT_EQ(found.count(anchor), 1U) << anchor;
  }
  EXPECT_EQ(known, 8U);
}

TEST(Troubleshooting, LinksOfThePageLead)
{
  const auto found = anchors();
  const std::string text = page();
  const std::regex link(R"(\]\(#([^)]*)\))");
  std::size_t links = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it, ++links)
    EXPECT_EQ(found.count((*it)[1]), 1U) << (*it)[1];
  EXPECT_GT(links, 5U);
}

/** The literals of a source, those that follow each other joined, without the rest. */
std::string literalsOf(const std::string& source)
{
  static const std::regex kNext(R"("\s*\n\s*")");
  return std::regex_replace(source, kNext, "");
}

/** Sources of diagnostics and messages. */
std::vector<std::string> messageSources()
{
  std::vector<std::string> texts;
  for (const char* folder :
       {"modules/imu/src", "modules/lidar/src", "modules/initialization/src", "modules/health/src",
        "modules/odometry/src", "apps/fastlio-replay"})
    for (const auto& entry : fs::directory_iterator(kSource / folder))
      if (entry.path().extension() == ".cpp")
        texts.push_back(literalsOf(contentOf(entry.path().string())));
  return texts;
}

TEST(Troubleshooting, EveryMessageOfThePageIsOneOfTheProgram)
{
  const std::string text = page().substr(page().find("## Messages"));
  const auto sources = messageSources();
  std::size_t messages = 0;
  const std::regex quoted("\n\n`([^`]*)`:");
  for (std::sregex_iterator it(text.begin(), text.end(), quoted), end; it != end; ++it, ++messages)
  {
    const std::string phrase = (*it)[1];
    const bool known = std::any_of(
        sources.begin(), sources.end(),
        [&](const std::string& source) { return source.find('"' + phrase) != std::string::npos; });
    EXPECT_TRUE(known) << phrase;
  }
  EXPECT_GT(messages, 10U);
}

TEST(Troubleshooting, EveryDiagnosticHasItsSection)
{
  const std::string text = page();
  const std::regex reported(
      R"((?:\breport\(|diagnostics_\.push_back\(|Diagnostic\{)[^";]{0,160}"([^"%(:;,]*))");
  std::size_t diagnostics = 0;
  for (const std::string& source : messageSources())
    for (std::sregex_iterator it(source.begin(), source.end(), reported), end; it != end; ++it)
    {
      std::string phrase = (*it)[1];
      phrase.erase(phrase.find_last_not_of(' ') + 1);
      EXPECT_NE(text.find("`" + phrase), std::string::npos) << "'" << phrase << "'";
      ++diagnostics;
    }
  EXPECT_GE(diagnostics, 12U);
}

}  // namespace
}  // namespace fastlio
