// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failing_run.h"

#include <fastlio/config/config_document.h>
#include <fastlio/simulation/recording.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* kExporters =
    "trajectory,states,covariance,timing,untrusted,ply,metricmap,report,graph";

/** Three seconds with so few points that a run takes a tenth of a second, and pieces of the map go
 * to files nevertheless. */
void writeInputs(const std::string& folder)
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 3.0;
  settings.rest = 2.0;
  settings.lidar.stride = 10;
  const RecordingFiles files = writeRecording(Simulation(settings), folder);
  Config config = matchingConfig(settings);
  config.odometry.map.output_spacing = 0.01;
  config.exporters.map_memory = 0.01;
  config.exporters.tile_size = 1.0;
  std::ofstream(files.config) << toYaml(config, "");
}

std::vector<JournalLine> journalOf(const std::string& path)
{
  std::ifstream in(path);
  std::vector<JournalLine> lines;
  for (std::string text; std::getline(in, text);)
  {
    JournalLine line;
    std::istringstream words(text);
    words >> line.what >> line.path >> line.other;
    lines.push_back(line);
  }
  return lines;
}
}  // namespace

Files filesIn(const std::string& folder)
{
  Files files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    files[entry.path().filename().string()] = contentOf(entry.path().string());
  return files;
}

FailingRuns::FailingRuns()
{
  writeInputs(folder_.file("in"));
  inputs_ = filesIn(folder_.file("in"));
  std::vector<std::string> other_run = command();
  other_run.insert(
      other_run.end(), {"--frame", "imu", "--skip-first-n", "1", "--export", kExporters});
  const ProcessResult before = Process(other_run, folder_.file("log.txt")).wait();
  EXPECT_EQ(before.exit_status, 0) << before.output;
  earlier_ = filesIn(out());
  fs::rename(out(), folder_.file("earlier"));
  const ProcessResult good = Process(command(), folder_.file("log.txt")).wait();
  EXPECT_EQ(good.exit_status, 0) << good.output;
  complete_ = filesIn(out());
}

std::vector<std::string> FailingRuns::command() const
{
  return {
      FASTLIO_REPLAY_PROGRAM,
      "--input-rawlog",
      folder_.file("in/recording.rawlog"),
      "--config",
      folder_.file("in/config.yaml"),
      "--output-dir",
      out(),
      "--threads",
      "2"};
}

FailingRun FailingRuns::run(const std::string& kind, int n, bool with_earlier) const
{
  fs::remove_all(out());
  if (with_earlier) fs::copy(folder_.file("earlier"), out());
  const std::string journal = folder_.file("journal.txt");
  fs::remove(journal);
  std::vector<std::string> faulty = {
      "/usr/bin/env", "LD_PRELOAD=" FASTLIO_FAILING_CALLS,
      "FASTLIO_FAULT=" + kind + ":" + std::to_string(n), "FASTLIO_JOURNAL=" + journal};
  const std::vector<std::string> program = command();
  faulty.insert(faulty.end(), program.begin(), program.end());
  FailingRun run;
  run.result = Process(faulty, folder_.file("log.txt")).wait();
  run.journal = journalOf(journal);
  for (const JournalLine& line : run.journal)
    if (line.what == "injected")
    {
      run.injected = true;
      run.about = line.other;
    }
  return run;
}

}  // namespace fastlio::testing
