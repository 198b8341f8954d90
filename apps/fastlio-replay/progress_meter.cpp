// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "progress_meter.h"

#include <fastlio/options/number_text.h>

#include <mrpt/system/progress.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <unistd.h>

namespace fastlio
{
namespace
{
constexpr double kBarPeriod = 0.2;    // [s]
constexpr double kLinePeriod = 10.0;  // [s]
constexpr std::size_t kBarLength = 30;
constexpr const char* kEraseLine = "\r\033[K";

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
    : logger_(logger),
      on_terminal_(
          isatty(STDERR_FILENO) != 0 && logger.getMinLoggingLevel() <= mrpt::system::LVL_INFO)
{
}

void ProgressMeter::update(const Progress& progress)
{
  const auto now = Clock::now();
  const std::chrono::duration<double> since_shown = now - last_shown_;
  if (since_shown.count() < (on_terminal_ ? kBarPeriod : kLinePeriod)) return;
  last_shown_ = now;
  const std::chrono::duration<double> elapsed = now - start_;
  const std::string text = progressText(progress, elapsed.count());
  if (!on_terminal_)
  {
    logger_.logStr(mrpt::system::LVL_INFO, text);
    return;
  }
  const double done = std::clamp(progress.done, 0.0, 1.0);
  std::cerr << kEraseLine << mrpt::system::progress(done, kBarLength) << " " << text << std::flush;
  drawn_ = true;
}

void ProgressMeter::clear()
{
  if (drawn_) std::cerr << kEraseLine << std::flush;
  drawn_ = false;
}

}  // namespace fastlio
