// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "progress_meter.h"

#include <fastlio/options/number_text.h>

#include <mrpt/system/progress.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kBarPeriod = 0.2;    // [s]
constexpr double kLinePeriod = 10.0;  // [s]
constexpr std::size_t kBarLength = 30;

/** Minutes and seconds, hours when there are some. */
std::string durationText(double seconds)
{
  const auto total = static_cast<long>(std::lround(seconds));
  const auto twoDigits = [](long n) { return (n < 10 ? "0" : "") + std::to_string(n); };
  const std::string tail = twoDigits(total % 60);
  if (total < 3600) return std::to_string(total / 60) + ":" + tail;
  return std::to_string(total / 3600) + ":" + twoDigits(total / 60 % 60) + ":" + tail;
}
}  // namespace

std::string progressText(const Progress& progress, double elapsed_seconds)
{
  const double done = std::clamp(progress.done, 0.0, 1.0);
  std::string text = fixedText(100.0 * done, 0) + " % | " +
                     fixedText(progress.recording_seconds, 1) + " s of the recording";
  if (elapsed_seconds <= 0.0) return text;
  text += " | " + fixedText(progress.recording_seconds / elapsed_seconds, 1) + " x real time";
  if (done > 0.0) text += " | " + durationText(elapsed_seconds * (1.0 - done) / done) + " left";
  return text;
}

ProgressMeter::ProgressMeter(mrpt::system::COutputLogger& logger)
    : logger_(logger), bar_(logger.getMinLoggingLevel() <= mrpt::system::LVL_INFO)
{
}

void ProgressMeter::update(const Progress& progress)
{
  const auto now = Clock::now();
  const std::chrono::duration<double> since_shown = now - last_shown_;
  if (since_shown.count() < (bar_.isShown() ? kBarPeriod : kLinePeriod)) return;
  last_shown_ = now;
  const std::chrono::duration<double> elapsed = now - start_;
  const std::string text = progressText(progress, elapsed.count());
  const double done = std::clamp(progress.done, 0.0, 1.0);
  if (bar_.isShown())
    bar_.show(mrpt::system::progress(done, kBarLength) + " " + text);
  else
    logger_.logStr(mrpt::system::LVL_INFO, text);
}

void ProgressMeter::clear()
{
  bar_.clear();
}

}  // namespace fastlio
