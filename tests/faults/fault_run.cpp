// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "fault_run.h"

#include "process.h"
#include <fastlio/evaluation/evaluate.h>
#include <fastlio/evaluation/trajectory_io.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;
constexpr std::chrono::seconds kHang{120};

void write(const fs::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

/** Every field of every line is a finite number; comments and a header are none. */
bool allNumbersFinite(const fs::path& path)
{
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);)
  {
    if (line.empty() || line[0] == '#' || line.find("stamp") == 0) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    for (std::string field; fields >> field;)
      if (!std::isfinite(std::strtod(field.c_str(), nullptr))) return false;
  }
  return in.eof();
}

double worstPosition(const fs::path& estimate, const fs::path& truth)
{
  const EvaluationReport report = evaluate(readTum(estimate), readTum(truth));
  double worst = 0.0;
  for (const PoseError& error : report.errors)
    worst = std::max(worst, error.translation);
  return worst;
}

bool documented(int exit_status)
{
  return exit_status >= 0 && exit_status <= 6;
}
}  // namespace

FaultOutcome replayBytes(
    const std::string& bytes, const FaultRecording& recording, const std::string& folder,
    bool judge_position, const std::string& words)
{
  const fs::path dir(folder), out = dir / "out";
  fs::remove_all(out);
  write(dir / "damaged.rawlog", bytes);
  write(dir / "truth.tum", recording.ground_truth);
  write(dir / "config.yaml", recording.config);
  Process process(
      {FASTLIO_REPLAY_PROGRAM, "--threads", "1", "--config", (dir / "config.yaml").string(),
       "--input-rawlog", (dir / "damaged.rawlog").string(), "--output-dir", out.string()},
      (dir / "log.txt").string());
  const ProcessResult result = process.wait(kHang);
  FaultOutcome outcome;
  outcome.exit_status = result.exit_status;
  outcome.log = result.output;
  outcome.ended = documented(result.exit_status);
  outcome.named = !words.empty() && std::regex_search(result.output, std::regex(words));
  // Input without any usable sensor is refused before anything is computed.
  if (result.exit_status == 1 || result.exit_status == 2)
  {
    outcome.outputs_complete = outcome.finite = true;
    return outcome;
  }
  outcome.outputs_complete = fs::exists(out / "summary.json") && fs::exists(out / "map.ply") &&
                             fs::exists(out / "trajectory.tum") && fs::exists(out / "timing.csv");
  if (!outcome.outputs_complete) return outcome;
  outcome.finite = allNumbersFinite(out / "trajectory.tum") && allNumbersFinite(out / "states.csv");
  std::ifstream in(out / "summary.json");
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (json.is_discarded()) return outcome;
  outcome.poses = json["scans"]["with_pose"];
  if (judge_position && outcome.poses > 0)
    outcome.worst_position = worstPosition(out / "trajectory.tum", dir / "truth.tum");
  return outcome;
}

}  // namespace fastlio::testing
