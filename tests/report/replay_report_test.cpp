// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// report.html as fastlio-replay writes it.

#include "process.h"
#include "report_test_support.h"
#include <fastlio/config/config_document.h>
#include <fastlio/evaluation/evaluate.h>
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/options/number_text.h>
#include <fastlio/simulation/recording.h>

#include <filesystem>
#include <fstream>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;

/** Five seconds in an office, with the truth; made once. */
class ReplayReport : public ::testing::Test
{
 protected:
  void SetUp() override
  {
    if (folder_) return;
    folder_ = std::make_unique<TemporaryFolder>();
    SimulationSettings settings = defaultSettings("office");
    settings.duration = 5.0;
    settings.rest = 2.0;
    settings.lidar.stride = 10;
    const RecordingFiles files = writeRecording(Simulation(settings), folder_->file("in"));
    std::ofstream(files.config) << toYaml(matchingConfig(settings), "");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::string in(const std::string& name) { return folder_->file("in/" + name); }

  /** The output of the program for these arguments; it has to end with 0. */
  static std::string reportOfReplay(const std::vector<std::string>& further)
  {
    std::vector<std::string> command = {
        FASTLIO_REPLAY_PROGRAM,
        "--input-rawlog",
        in("recording.rawlog"),
        "--config",
        in("config.yaml"),
        "--output-dir",
        folder_->file("out"),
        "--frame",
        "imu"};
    command.insert(command.end(), further.begin(), further.end());
    const ProcessResult result = Process(command, folder_->file("log")).wait();
    EXPECT_EQ(result.exit_status, 0) << result.output;
    return contentOf(folder_->file("out/report.html"));
  }

  static bool says(const std::string& html, const std::string& part)
  {
    return html.find(part) != std::string::npos;
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

/** Without what belongs to the machine: the last section, and the number of threads. */
std::string resultsOf(std::string html)
{
  html.resize(std::min(html.size(), html.find("<!-- measured")));
  for (auto at = html.find("<code>threads</code>"); at != std::string::npos;
       at = html.find("<code>threads</code>", at))
    html.erase(at, html.find('\n', at) - at);
  return html;
}

TEST_F(ReplayReport, IsTheSameAtAnyNumberOfThreads)
{
  const std::string one = reportOfReplay({"--threads", "1"});
  expectGoodPage(one);
  EXPECT_TRUE(says(one, "The run can be trusted"));
  EXPECT_FALSE(says(one, "Against the reference"));
  EXPECT_TRUE(resultsOf(one) == resultsOf(reportOfReplay({"--threads", "2"})));
}

TEST_F(ReplayReport, HasTheErrorsOfTheEvaluation)
{
  const std::string html = reportOfReplay({"--reference", in("ground_truth.tum")});
  expectGoodPage(html);
  const fs::path out = fs::path(in("")).parent_path().parent_path() / "out";
  const Trajectory estimate = readCovarianceCsv(out / "covariance.csv");
  const Trajectory truth = readTum(in("ground_truth.tum"));
  EvaluationReport report = evaluate(estimate, truth, {});
  if (report.uncertain_turn)  // a path that is nearly straight
  {
    EvaluationOptions options;
    options.alignment = Alignment::First;
    report = evaluate(estimate, truth, options);
  }
  EXPECT_TRUE(says(html, ">" + fixedText(report.ape.translation.rmse, 4) + "<")) << html;
  const std::string nees = "NEES of the pose: ";
  const std::size_t at = html.find(nees);
  ASSERT_NE(at, std::string::npos);
  // The file has fewer digits than the run: the last one of the page may differ.
  EXPECT_NEAR(std::stod(html.substr(at + nees.size(), 8)), report.nees->pose.mean, 0.01);
}

TEST_F(ReplayReport, FindsTheTruthBesideTheRecording)
{
  fs::copy(in("ground_truth.tum"), in("recording.gt.tum"));
  EXPECT_TRUE(says(reportOfReplay({}), "recording.gt.tum</code>: "));
  std::ofstream(in("recording.gt.tum")) << "damaged";
  EXPECT_TRUE(says(reportOfReplay({}), "could not be used: "));
  fs::remove(in("recording.gt.tum"));
}

TEST_F(ReplayReport, AReferenceIsNotReplaced)
{
  const std::string truth = contentOf(in("ground_truth.tum"));
  const ProcessResult result =
      Process(
          {FASTLIO_REPLAY_PROGRAM, "--input-rawlog", in("recording.rawlog"), "--reference",
           in("ground_truth.tum"), "--output-dir", in("out"), "--output-tum-path",
           in("ground_truth.tum")},
          in("log"))
          .wait();
  EXPECT_EQ(result.exit_status, 1) << result.output;
  EXPECT_TRUE(says(result.output, "(--reference)")) << result.output;
  EXPECT_TRUE(contentOf(in("ground_truth.tum")) == truth);
}

TEST_F(ReplayReport, AReferenceNeedsTheReport)
{
  const ProcessResult result =
      Process(
          {FASTLIO_REPLAY_PROGRAM, in("recording.rawlog"), "--reference", in("ground_truth.tum"),
           "-o", in("out"), "--export", "trajectory"},
          in("log"))
          .wait();
  EXPECT_EQ(result.exit_status, 1) << result.output;
  EXPECT_TRUE(says(result.output, "--export (report)")) << result.output;
}

TEST_F(ReplayReport, AReferenceNeedsAFolderForTheReport)
{
  const ProcessResult result =
      Process(
          {FASTLIO_REPLAY_PROGRAM, "--input-rawlog", in("recording.rawlog"), "--reference",
           in("ground_truth.tum"), "--output-tum-path", in("t.tum")},
          in("log"))
          .wait();
  EXPECT_EQ(result.exit_status, 1) << result.output;
  EXPECT_TRUE(says(result.output, "--output-dir, where report.html")) << result.output;
}

}  // namespace
}  // namespace fastlio::testing
