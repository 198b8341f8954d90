// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Each call by which a run writes fails once. Whichever it is: no crash, a documented exit status,
// a message that names the file, and of each output either the old or the new content.

#include "failing_run.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;
using Json = nlohmann::json;

/** Which calls of a kind are refused: the first ones, then in growing steps. */
struct Steps
{
  int one_by_one = 1;
  double factor = 1.0;
  bool too_many = false;  //!< also for FASTLIO_EVERY_FAULT
};

int next(int n, const Steps& steps)
{
  static const bool every = std::getenv("FASTLIO_EVERY_FAULT") != nullptr;
  if ((every && !steps.too_many) || n < steps.one_by_one) return n + 1;
  return std::max(n + 1, static_cast<int>(n * steps.factor));
}

/** The output that a call was about: temporary names are those of their files with a suffix. */
std::string outputOf(const std::string& path)
{
  const std::string name = fs::path(path).filename().string();
  constexpr std::size_t kSuffix = sizeof(".abcdefgh.tmp") - 1;
  if (name.find("map-tiles-") == 0) return "map-tiles-";
  const bool temporary = name.size() > kSuffix && name.substr(name.size() - 4) == ".tmp";
  return temporary ? name.substr(0, name.size() - kSuffix) : name;
}

/** timing.csv has times of the clock: as many rows as ever, each complete. */
bool isCompleteTable(const std::string& text, const std::string& like)
{
  return !text.empty() && text.back() == '\n' &&
         std::count(text.begin(), text.end(), '\n') == std::count(like.begin(), like.end(), '\n') &&
         std::count(text.begin(), text.end(), ',') == std::count(like.begin(), like.end(), ',');
}

/** report.html has times of the clock, too. */
bool isWholePage(const std::string& text)
{
  const std::string end = "</html>\n";
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

class OutputFaults : public FailingRuns
{
 protected:
  void expectOldOrNew(const std::string& name, const std::string& content) const
  {
    if (earlier().count(name) > 0 && earlier().at(name) == content) return;
    if (is_shorter_) return expectConsistent(name, content);
    ASSERT_GT(complete().count(name), 0U) << name << " is none of the outputs";
    const std::string& wanted = complete().at(name);
    if (name == "timing.csv")
      EXPECT_TRUE(isCompleteTable(content, wanted)) << content;
    else if (name == "report.html")
      EXPECT_TRUE(isWholePage(content)) << content.size();
    else if (name == "summary.json")
      EXPECT_TRUE(Json::accept(content)) << content;
    else
      EXPECT_TRUE(content == wanted) << name << ": neither old nor new, " << content.size();
  }

  /** Of a run that has lost a part of its input, or its end, and has said so: whole rows. */
  void expectConsistent(const std::string& name, const std::string& content) const
  {
    ASSERT_GT(complete().count(name), 0U) << name << " is none of the outputs";
    const bool rows = name.find(".csv") != std::string::npos || name == "trajectory.tum";
    if (rows)
    {
      EXPECT_TRUE(content.empty() || content.back() == '\n') << name;
    }
  }

  /** Every file in a summary is complete. */
  static void expectListedSizes(const Files& files)
  {
    if (files.count("summary.json") == 0) return;
    const Json summary = Json::parse(files.at("summary.json"));
    for (const auto& output : summary["outputs"])
    {
      const std::string name = fs::path(output["path"].get<std::string>()).filename().string();
      ASSERT_GT(files.count(name), 0U) << name;
      EXPECT_EQ(files.at(name).size(), output["bytes"]) << name;
    }
  }

  /** The files that a run left, however it ended. */
  void expectNothingDestroyed(bool with_earlier, int status)
  {
    constexpr int kInputBroken = 3, kRunEndedEarly = 4;
    is_shorter_ = status == kInputBroken || status == kRunEndedEarly;
    EXPECT_TRUE(inputsAreUntouched());
    const Files files = filesIn(out());
    for (const auto& [name, content] : files)
      expectOldOrNew(name, content);
    if (is_shorter_) expectListedSizes(files);
    if (!with_earlier)
    {
      EXPECT_TRUE(!files.empty() || !fs::exists(out())) << "an empty folder is left";
      return;
    }
    for (const auto& [name, content] : complete())
      EXPECT_GT(files.count(name), 0U) << name << " is gone";
  }

  static void expectHonest(const FailingRun& run, const std::string& kind)
  {
    const int status = run.result.exit_status;
    if (status == 0) return;  // what failed was not needed; everything is new, see above
    EXPECT_TRUE(status >= 1 && status <= 6) << status << "\n" << run.result.output;
    const std::string& output = run.result.output;
    const auto names = [&output](const std::string& text)
    { return output.find(text) != std::string::npos; };
    if (kind == "new")
      EXPECT_TRUE(names("memory") || names("config.yaml") || names("recording.rawlog")) << output;
    else
      EXPECT_TRUE(names(kind == "thread" ? "thread" : outputOf(run.about)))
          << "no '" << outputOf(run.about) << "' in:\n"
          << output;
  }

  /** All are new, and the earlier run's other files are gone. */
  void expectComplete() const
  {
    const Files files = filesIn(out());
    EXPECT_EQ(files.size(), complete().size());
    for (const auto& [name, content] : complete())
    {
      EXPECT_GT(files.count(name), 0U) << name;
      expectOldOrNew(name, content);
    }
  }

  /** Refuses call after call until a run gets through; returns how many runs had a refused one. */
  int refuseEach(const std::string& kind, const Steps& steps, bool with_earlier)
  {
    int runs = 0;
    for (int n = 1; !::testing::Test::HasFailure(); n = next(n, steps))
    {
      SCOPED_TRACE(kind + " number " + std::to_string(n));
      const FailingRun faulty = run(kind, n, with_earlier);
      expectNothingDestroyed(with_earlier, faulty.result.exit_status);
      expectHonest(faulty, kind);
      if (faulty.result.exit_status == 0) expectComplete();
      if (!faulty.injected)
      {
        EXPECT_EQ(faulty.result.exit_status, 0) << faulty.result.output;
        break;
      }
      ++runs;
    }
    return runs;
  }

 private:
  bool is_shorter_ = false;
};

TEST_F(OutputFaults, Open)
{
  EXPECT_GT(refuseEach("open", {2, 1.5}, true), 5);
  EXPECT_GT(refuseEach("open", {1, 1.8}, false), 5);
}

TEST_F(OutputFaults, Write)
{
  EXPECT_GT(refuseEach("write", {2, 1.6}, true), 5);
  EXPECT_GT(refuseEach("short-write", {1, 3.0}, true), 2);
}

TEST_F(OutputFaults, Sync)
{
  EXPECT_GT(refuseEach("fsync", {2, 1.3}, true), 8);
}

TEST_F(OutputFaults, Close)
{
  EXPECT_GT(refuseEach("close", {2, 1.6}, true), 4);
}

TEST_F(OutputFaults, Rename)
{
  EXPECT_EQ(refuseEach("rename", {20, 1.5}, true), static_cast<int>(complete().size()));
}

TEST_F(OutputFaults, Folders)
{
  EXPECT_GT(refuseEach("mkdir", {4, 1.5}, false), 1);
}

TEST_F(OutputFaults, Threads)
{
  EXPECT_GT(refuseEach("thread", {4, 1.5}, true), 1);
}

TEST_F(OutputFaults, Memory)
{
  EXPECT_GT(refuseEach("new", {2, 1.3, true}, true), 10);
}

}  // namespace
}  // namespace fastlio::testing
