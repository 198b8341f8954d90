// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failure_message.h"
#include "folder_listing.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/run/run_folder.h>

#include <algorithm>
#include <stdexcept>

namespace fastlio
{
namespace
{
using testing::contentOf;
using testing::failureOf;
using testing::namesIn;
using testing::TemporaryFolder;
namespace fs = std::filesystem;

/** A folder, and a run that wants to write a.csv and summary.json there. */
class RunFolderTest : public ::testing::Test
{
 protected:
  [[nodiscard]] RunFolderPlan plan() const
  {
    return {
        folder_.path(),
        {"a.csv", "summary.json"},
        "summary.json",
        "exit_status",
        false,
        "",
        [](const std::string& name) { return fs::path(name).extension() == ".csv"; }};
  }

  void write(const std::string& name, const std::string& content) const
  {
    std::ofstream(folder_.file(name), std::ios::binary) << content;
  }

  /** The files that an earlier run left in this folder under another name. */
  void writeEarlierRun() const
  {
    write("a.csv", "old");
    write("b.csv", "three");
    write("c.csv", "another one");
    write(
        "summary.json",
        R"({"exit_status": 0, "outputs": [{"path": "/before/a.csv", "bytes": 3},
            {"path": "/before/b.csv", "bytes": 5}, {"path": "/before/c.csv", "bytes": 4},
            {"path": "/before/gone.csv", "bytes": 4}, {"path": 5}, "junk"]})");
  }

  [[nodiscard]] std::string refusal() const
  {
    return failureOf<std::runtime_error>(
        [this]
        {
          requireReplaceable(plan());
          const RunFolder run(plan());
        });
  }

  [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
};

TEST_F(RunFolderTest, FilesThatNoRunWroteAreNotReplacedUnlessAsked)
{
  write("notes.txt", "nobody minds");
  EXPECT_EQ(refusal(), "");
  write("a.csv", "of the user");
  const std::string text = refusal();
  EXPECT_NE(text.find(folder().file("a.csv")), std::string::npos) << text;
  EXPECT_NE(text.find("--overwrite"), std::string::npos) << text;
  write("summary.json", R"({"of": "another program"})");
  EXPECT_NE(refusal(), "");
  RunFolderPlan overwrite = plan();
  overwrite.overwrite = true;
  requireReplaceable(overwrite);
  const RunFolder run(overwrite);
}

TEST_F(RunFolderTest, ARunOfAnotherProgramIsNotReplacedUnlessAsked)
{
  const std::string record = R"({"program": "fastlio-sort", "exit_status": 0, "outputs": []})";
  write("a.csv", "of a run");
  write("summary.json", record);
  RunFolderPlan own = plan(), other = plan();
  own.program = "fastlio-sort";
  other.program = "fastlio-shuffle";
  EXPECT_NO_THROW(requireReplaceable(own));
  const auto refuse = [&](const auto& step)
  {
    const std::string text = failureOf<std::runtime_error>(step);
    EXPECT_NE(
        text.find("holds a run of fastlio-sort; choose another folder or give --overwrite"),
        std::string::npos)
        << text;
  };
  refuse([&] { requireReplaceable(other); });
  refuse([&] { const RunFolder run(other); });
  // Nor where a run of the other program was killed.
  write(".fastlio-lock", "");
  refuse([&] { requireReplaceable(other); });
  other.overwrite = true;
  EXPECT_NO_THROW(requireReplaceable(other));
  write("summary.json", R"({"exit_status": 0, "outputs": []})");
  other.overwrite = false;
  EXPECT_NO_THROW(requireReplaceable(other)) << "an early version named no program";
}

TEST_F(RunFolderTest, ALinkThatLeadsNowhereIsAFileOfSomebodyToo)
{
  fs::create_symlink("/home/somebody/a.csv", folder().file("a.csv"));
  EXPECT_NE(refusal(), "");
}

TEST_F(RunFolderTest, RecordsOfAnyShapeAreSurvived)
{
  write("a.csv", "of the user");
  const std::string deep(1'000'000, '[');
  for (const std::string& junk :
       {std::string(), std::string("["), std::string("[1]"), std::string("null"), std::string("7"),
        std::string("{\"exit_status\""), deep, "{\"exit_status\": " + deep})
  {
    write("summary.json", junk);
    EXPECT_NE(refusal(), "") << junk.substr(0, 30);
  }
  const char* const nested =
      R"({"exit_status": [1, {"path": "a"}], "outputs": [[{"path": "a.csv", "bytes": 1}], null]})";
  for (const char* odd : {R"({"exit_status": 0})", R"({"exit_status": 0, "outputs": 3})", nested})
  {
    write("summary.json", odd);
    EXPECT_EQ(refusal(), "") << odd;
  }
}

TEST_F(RunFolderTest, TheEarlierRunGoesWhenTheNewOneIsComplete)
{
  writeEarlierRun();
  write("notes.txt", "of the user");
  write("a.csv.abcdefgh.tmp", "whose?");
  EXPECT_EQ(refusal(), "");
  {
    const RunFolder run(plan());
    EXPECT_EQ(contentOf(folder().file("b.csv")), "three");
    run.removeLeftovers({});
  }
  EXPECT_EQ(namesIn(folder()), "a.csv a.csv.abcdefgh.tmp c.csv notes.txt summary.json")
      << "c.csv has another size than the run has written";
}

/** Anybody may have edited it. */
TEST_F(RunFolderTest, ARecordNamesNoFilesThatTheProgramNeverWrites)
{
  write("a.csv", "old");
  write("thesis.pdf", "years of work");
  fs::create_directory(folder().file("sub"));
  write("sub/b.csv", "1234");
  write("mine.csv", "1234");
  fs::create_symlink("mine.csv", folder().file("link.csv"));
  fs::create_directory(folder().file("folder.csv"));
  write(
      "summary.json",
      R"({"exit_status": 0, "outputs": [{"path": "thesis.pdf", "bytes": 13},
          {"path": "sub/b.csv", "bytes": 4}, {"path": "link.csv", "bytes": 4},
          {"path": "folder.csv", "bytes": 4096}, {"path": "..", "bytes": 4096},
          {"path": "sub/", "bytes": 4096}, {"path": "", "bytes": 4096}]})");
  const RunFolder run(plan());
  run.removeLeftovers({});
  EXPECT_EQ(
      namesIn(folder()),
      ".fastlio-lock a.csv folder.csv link.csv mine.csv sub summary.json thesis.pdf");
  EXPECT_EQ(contentOf(folder().file("sub/b.csv")), "1234");
}

TEST_F(RunFolderTest, InputsStay)
{
  writeEarlierRun();
  fs::create_symlink("b.csv", folder().file("link"));
  const RunFolder run(plan());
  run.removeLeftovers({folder().file("link")});
  EXPECT_EQ(contentOf(folder().file("b.csv")), "three");
}

TEST_F(RunFolderTest, WhatAKilledRunLeftIsReplacedAndRemoved)
{
  for (const char* name : {".fastlio-lock", "a.csv", "a.csv.abcdefgh.tmp", "b.csv.abcdefgh.tmp"})
    write(name, "x");
  fs::create_directories(folder().file("map-tiles-Ab12xY"));
  fs::create_directories(folder().file("map-submaps-Ab12xY"));
  fs::create_directories(folder().file("map-tiles-of-mine"));
  fs::create_directories(folder().file("map-tiles-vienna"));
  write("map-tiles-vienna/ring.ply", "x");
  fs::create_directories(folder().file("a.csv.folders0.tmp"));
  EXPECT_EQ(refusal(), "");
  write(".fastlio-lock", "x");
  {
    const RunFolder run(plan());
    run.removeLeftovers({});
  }
  EXPECT_EQ(
      namesIn(folder()),
      "a.csv a.csv.folders0.tmp b.csv.abcdefgh.tmp map-tiles-of-mine map-tiles-vienna");
}

TEST_F(RunFolderTest, OneRunAtATime)
{
  const RunFolder run(plan());
  EXPECT_NE(refusal().find("another run"), std::string::npos);
}

TEST(OutputFileNames, AreThoseThatExportersWrite)
{
  const TemporaryFolder folder;
  ExportTarget target;
  target.directory = folder.path();
  for (const ExporterKind& kind : exporterKinds())
    target.parameters.exporters += std::string(kind.name) + ",";
  target.imu_rate = true;
  const ExporterSet set = makeExporters(target);
  const std::vector<std::string> names = outputFileNames(target);
  EXPECT_EQ(names.size(), exporterKinds().size() + 1);  // kitti has two
  EXPECT_TRUE(std::all_of(names.begin(), names.end(), isOutputFileName));
  EXPECT_FALSE(isOutputFileName("notes.txt") || isOutputFileName(""));
  std::vector<std::string> opened;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    opened.push_back(entry.path().filename().string());
  EXPECT_EQ(opened.size(), names.size());
  for (const std::string& name : names)
    EXPECT_EQ(
        std::count_if(
            opened.begin(), opened.end(),
            [&name](const std::string& file) { return isTemporaryOf(name, file); }),
        1)
        << name;
  target.directory.clear();
  EXPECT_TRUE(outputFileNames(target).empty());
}

}  // namespace
}  // namespace fastlio
