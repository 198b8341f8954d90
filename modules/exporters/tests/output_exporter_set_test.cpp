// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failure_message.h"
#include "output_test_support.h"
#include <fastlio/exporters/standard_exporters.h>

namespace fastlio
{
namespace
{
using testing::contentOf;
using testing::dataLinesOf;
using testing::failureOf;
using testing::madeUpResult;
using testing::smallMap;
using testing::TemporaryFolder;

constexpr std::int64_t kStamp = 1'403'636'580'838'555'648;

/** An exporter that fails on its second scan. */
class FailingExporter : public Exporter
{
 public:
  void onScan(const ScanResult& /*result*/) override
  {
    if (++scans_ == 2) throw std::runtime_error("disk full");
  }
  std::vector<OutputFile> finish(const RunEnd& /*end*/) override
  {
    ADD_FAILURE() << "a failed exporter is not finished";
    return {};
  }

 private:
  int scans_ = 0;
};

TEST(ExporterSet, OneFailureLeavesTheOthersComplete)
{
  const TemporaryFolder folder;
  ExporterSet set;
  set.add(std::make_unique<FailingExporter>());
  set.add(makeTumExporter(folder.file("t.tum"), {}));
  for (int i = 0; i < 5; ++i)
    set.onScan(madeUpResult(kStamp + i));
  EXPECT_EQ(set.problems().size(), 1U);
  RunSummary summary = set.finish({}, *smallMap());
  EXPECT_EQ(dataLinesOf(folder.file("t.tum")).size(), 5U);
  EXPECT_EQ(summary.outputs.size(), 1U);
  ASSERT_EQ(summary.output_problems.size(), 1U);
  EXPECT_EQ(summary.output_problems[0], "disk full");
  EXPECT_EQ(exitStatusOf(summary), ExitStatus::OutputFailed);
}

/** Has no memory left when it is written to. */
class StarvedExporter : public Exporter
{
 public:
  void onScan(const ScanResult& /*result*/) override { throw std::bad_alloc(); }
  std::vector<OutputFile> finish(const RunEnd& /*end*/) override { return {}; }
};

TEST(ExporterSet, MessagesNameTheFileAndWhatIsMissing)
{
  ExporterSet set;
  set.add(std::make_unique<StarvedExporter>(), "folder/states.csv");
  set.onScan(madeUpResult(kStamp));
  ASSERT_EQ(set.problems().size(), 1U);
  EXPECT_EQ(set.problems()[0], "cannot write 'folder/states.csv': there is not enough memory");
}

TEST(ExporterSet, WithoutAMapTheOtherFilesAreComplete)
{
  const TemporaryFolder folder;
  ExporterSet set;
  set.add(makePlyMapExporter(folder.file("map.ply")), folder.file("map.ply"));
  set.add(makeTumExporter(folder.file("t.tum"), {}));
  EXPECT_TRUE(set.needMap());
  set.giveUpMap("the disk is full");
  EXPECT_FALSE(set.needMap());
  set.onScan(madeUpResult(kStamp));
  const RunSummary summary = set.finish({}, *smallMap());
  EXPECT_EQ(dataLinesOf(folder.file("t.tum")).size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(folder.file("map.ply")));
  ASSERT_EQ(summary.output_problems.size(), 1U);
  EXPECT_EQ(
      summary.output_problems[0],
      "cannot write '" + folder.file("map.ply") + "': the disk is full");
}

ExportTarget optionsFor(const TemporaryFolder& folder)
{
  ExportTarget options;
  options.directory = folder.path();
  options.tum_path = folder.file("extra.tum");
  return options;
}

TEST(ExporterSet, StandardFilesAreAllThere)
{
  const TemporaryFolder folder;
  ExporterSet set = makeExporters(optionsFor(folder));
  set.onScan(madeUpResult(kStamp));
  const RunSummary summary = set.finish({}, *smallMap());
  EXPECT_TRUE(summary.output_problems.empty());
  for (const auto* name :
       {"trajectory.tum", "extra.tum", "states.csv", "covariance.csv", "timing.csv",
        "untrusted.csv", "map.ply", "map.metricmap", "report.html", "summary.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.file(name))) << name;
  EXPECT_EQ(summary.outputs.size(), 10U);
  EXPECT_EQ(contentOf(folder.file("extra.tum")), contentOf(folder.file("trajectory.tum")));
}

TEST(ExporterSet, NamesChooseTheFiles)
{
  const TemporaryFolder folder;
  ExportTarget options = optionsFor(folder);
  options.tum_path.clear();
  options.parameters.exporters = "kitti, states";
  ExporterSet set = makeExporters(options);
  EXPECT_FALSE(set.needMap());
  const RunSummary summary = set.finish({}, *smallMap());
  std::vector<std::string> names;
  for (const auto& output : summary.outputs)
    names.push_back(std::filesystem::path(output.path).filename().string());
  EXPECT_EQ(
      names, (std::vector<std::string>{
                 "trajectory.kitti", "trajectory.kitti_times", "states.csv", "summary.json"}));
}

TEST(ExporterSet, AnUnknownNameIsAnsweredWithThoseThatThereAre)
{
  const TemporaryFolder folder;
  ExportTarget options = optionsFor(folder);
  options.parameters.exporters = "states,plz";
  const std::string message =
      failureOf<std::invalid_argument>([&] { (void)makeExporters(options); });
  EXPECT_NE(message.find("'plz'"), std::string::npos) << message;
  EXPECT_NE(message.find("simplemap"), std::string::npos) << message;
}

/** A program's own format: a class and a row. */
TEST(ExporterSet, TakesFurtherKinds)
{
  const TemporaryFolder folder;
  ExportTarget options = optionsFor(folder);
  options.parameters.exporters = "mine";
  auto kinds = exporterKinds();
  kinds.push_back({"mine", "mine.tum", "as trajectory", false, [](const ExportTarget& o) {
                     return makeTumExporter(o.path("mine.tum"), o.frame);
                   }});
  (void)makeExporters(options, kinds).finish({}, *smallMap());
  EXPECT_TRUE(std::filesystem::exists(folder.file("mine.tum")));
}

}  // namespace
}  // namespace fastlio
