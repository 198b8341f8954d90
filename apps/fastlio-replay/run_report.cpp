// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "run_report.h"

#include "run_counts.h"
#include <fastlio/options/number_text.h>
#include <fastlio/options/split_text.h>

#include <algorithm>
#include <filesystem>

namespace fastlio
{
namespace
{
constexpr std::size_t kLabelWidth = 14;

std::string line(const std::string& label, const std::string& text)
{
  return padded(label, kLabelWidth) + text + "\n";
}

std::string sizeText(std::uintmax_t bytes)
{
  const auto size = static_cast<double>(bytes);
  if (bytes < 10'000) return std::to_string(bytes) + " B";
  if (bytes < 10'000'000) return fixedText(size * 1e-3, 1) + " kB";
  return fixedText(size * 1e-6, 1) + " MB";
}

std::string countsText(const std::vector<NamedCount>& counts)
{
  std::string text;
  for (const auto& count : counts)
    text += (text.empty() ? "" : ", ") + std::to_string(count.count) + " " + count.name;
  return text;
}

std::string speedText(const RunSummary& run)
{
  return fixedText(realTimeFactor(run), 1) + " x real time (" +
         fixedText(run.statistics.duration(), 1) + " s of recording in " +
         fixedText(run.wall_seconds, 2) + " s, of which " +
         fixedText(run.statistics.computeSeconds(), 2) + " s odometry)";
}

std::string degenerateText(const DegenerateDirections& open)
{
  return countedText(open.scans, "scan") + " did not see a " + directionText(open.weakest) +
         ": there the pose is inertial only, and its covariance grows";
}

std::string imuText(const ImuReport& imu)
{
  std::string text = fixedText(imu.rate, 1) + " Hz, " + toString(imu.accel_unit) + ", " +
                     toString(imu.gyro_unit) + ", jitter " + fixedText(100.0 * imu.jitter, 1) +
                     " %";
  if (imu.gaps > 0)
    text +=
        ", " + countedText(imu.gaps, "gap") + " (longest " + fixedText(imu.longest_gap, 3) + " s)";
  if (imu.missing > 0) text += ", " + countedText(imu.missing, "sample") + " missing";
  if (imu.saturated > 0) text += ", " + countedText(imu.saturated, "clipped sample");
  if (imu.spikes > 0) text += ", " + countedText(imu.spikes, "spike");
  if (imu.clock_steps > 0) text += ", clock set back " + countedText(imu.clock_steps, "time");
  return text;
}

std::string pathText(const RunStatistics& statistics)
{
  const std::string known = endUncertaintyText(statistics);
  return fixedText(statistics.pathLength(), 2) + " m" +
         (known.empty() ? std::string() : "; its end is known to " + known);
}

std::string healthText(const RunHealth& health)
{
  if (health.scans() == 0) return "no pose";
  const auto& first = health.firstTrouble();
  if (!first) return "no scan in trouble (worst " + fixedText(health.worst(), 2) + " of 1)";
  return std::to_string(health.troubled()) + " of " + std::to_string(health.scans()) +
         " scans in trouble; first bad second " + fixedText(first->second, 1) + " (" +
         secondsText(first->stamp_ns) + "): " + toString(first->health.cause) + ": " +
         first->health.reason;
}

std::string stretchText(const UntrustedStretch& stretch)
{
  return fixedText(stretch.begin_s, 1) + " to " + fixedText(stretch.end_s, 1) + " s (" +
         countedText(stretch.scans, "scan") + "): " + toString(stretch.cause) + ": " +
         stretch.reason;
}

std::string filesText(const std::vector<OutputFile>& files)
{
  std::size_t width = 0;
  for (const auto& file : files)
    width = std::max(width, file.path.size());
  std::string text;
  for (std::size_t i = 0; i < files.size(); ++i)
    text +=
        line(i == 0 ? "Files" : "", padded(files[i].path, width + 2) + sizeText(files[i].bytes));
  return text;
}

/** The page of a run, or empty. */
std::string reportPageOf(const std::vector<OutputFile>& files)
{
  for (const OutputFile& file : files)
    if (std::filesystem::path(file.path).filename() == "report.html") return file.path;
  return {};
}

std::string noEchoText(std::size_t without, std::size_t points)
{
  return std::to_string(without) + " of " + std::to_string(without + points) +
         " beams, as into the sky";
}

/** Of the scans that were read, none was left after those of --skip-first-n. */
bool allAreSkipped(const RunSummary& run)
{
  const std::size_t dropped =
      inputCount(run, "scans_without_imu") + inputCount(run, "scans_empty") +
      inputCount(run, "scans_out_of_order") + inputCount(run, "scans_bad_stamp");
  return inputCount(run, "scans_skipped") > 0 && dropped == 0;
}

/** Why no scan came to the odometry. */
std::string whyNoScan(const RunSummary& run)
{
  if (allAreSkipped(run))
    return "--skip-first-n leaves out all " + std::to_string(inputCount(run, "scans_skipped")) +
           " scans of the recording";
  const std::size_t empty = inputCount(run, "scans_empty");
  if (empty > 0 && empty == inputCount(run, "scans"))
    return "none of the " + std::to_string(empty) + " scans has a point that can be used: " +
           std::to_string(inputCount(run, "points_without_return")) + " beams without a return, " +
           std::to_string(inputCount(run, "points_invalid")) +
           " points that are not finite; was the view of the LiDAR covered, or did it not turn?";
  return "no IMU samples cover a scan; check that both sensors recorded at the same time and that "
         "their clocks agree";
}

std::string whyOdometryFailed(const RunSummary& run)
{
  const RunStatistics& statistics = run.statistics;
  if (statistics.scans() == 0) return "no scan could be processed: " + whyNoScan(run);
  const auto trouble = statistics.firstTrouble();
  const std::string cause = trouble ? ": " + trouble->message : std::string();
  if (statistics.poses() == 0) return "the odometry never initialised" + cause;
  if (statistics.health().hasNoMap())
    return "there is no map: no point of any scan joined it; check the pose of the LiDAR "
           "(input.T_vehicle_lidar), and the unit of its points";
  return "the odometry diverged; it was lost first at scan " +
         std::to_string(trouble ? trouble->scan_index : 0) + cause;
}
}  // namespace

std::vector<std::string> troubleSentences(const RunSummary& summary)
{
  std::vector<std::string> sentences = summary.input_problems;
  const auto& output = summary.output_problems;
  sentences.insert(sentences.end(), output.begin(), output.end());
  if (!summary.failure.empty()) sentences.push_back(summary.failure);
  const auto& statistics = summary.statistics;
  if (exitStatusOf(summary) != ExitStatus::Ok)
  {
    const auto lost = lossSentences(summary);
    sentences.insert(sentences.end(), lost.begin(), lost.end());
  }
  if (isLost(statistics)) sentences.push_back(whyOdometryFailed(summary));
  if (exitStatusOf(summary) == ExitStatus::Degraded)
    sentences.emplace_back(
        "degraded: do not rely on the stretches that the report calls untrusted (untrusted.csv)");
  if (summary.interrupted)
    sentences.emplace_back("interrupted; the results up to there are written");
  return sentences;
}

std::string reportText(const RunSummary& summary)
{
  const auto& statistics = summary.statistics;
  const auto lost = losses(summary);
  std::string text = line("Scans", scanCountsText(statistics));
  text += line("Path", pathText(statistics));
  text += line("Per scan", scanTimesText(statistics.scanTimes()));
  text += line("Speed", speedText(summary));
  if (const std::size_t without = inputCount(summary, "points_without_return"))
    text += line("No echo", noEchoText(without, inputCount(summary, "points")));
  if (!lost.empty()) text += line("Dropped", countsText(lost));
  if (statistics.degenerateDirections().scans > 0)
    text += line("Degenerate", degenerateText(statistics.degenerateDirections()));
  text += line("IMU", imuText(summary.imu));
  text += line("Health", healthText(statistics.health()));
  for (const UntrustedStretch& stretch : statistics.health().untrusted())
    text += line("Untrusted", stretchText(stretch));
  for (const Diagnostic& diagnostic : summary.diagnostics)
    text += line("Diagnostic", secondsText(diagnostic.stamp_ns) + ": " + diagnostic.text);
  text += filesText(summary.outputs);
  text += line("Status", statusText(exitStatusOf(summary)));
  const std::string page = reportPageOf(summary.outputs);
  return page.empty() ? text : text + line("Next", "open " + page);
}

}  // namespace fastlio
