// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file terminal_line.h Progress for people, as a line that the next one takes the place of. */
#pragma once

#include <iostream>
#include <string>
#include <unistd.h>

namespace fastlio
{
/** A line on standard error; nothing is drawn where that is no terminal. */
class TerminalLine
{
 public:
  /** \param wanted false: nothing is drawn on terminals either */
  explicit TerminalLine(bool wanted) : is_shown_(wanted && isatty(STDERR_FILENO) == 1) {}

  /** Whether anybody sees the line. */
  [[nodiscard]] bool isShown() const { return is_shown_; }

  void show(const std::string& text)
  {
    if (!is_shown_ || text == text_) return;
    text_ = text;
    std::cerr << kErase << text << std::flush;
  }

  /** \param share that is done, 0 to 1 */
  void showShare(const std::string& what, double share)
  {
    if (is_shown_) show(what + ": " + std::to_string(static_cast<int>(100.0 * share)) + " %");
  }

  /** Removes the line, so that other text can be printed. */
  void clear()
  {
    if (!text_.empty()) std::cerr << kErase << std::flush;
    text_.clear();
  }

 private:
  static constexpr const char* kErase = "\r\033[K";
  bool is_shown_;
  std::string text_;  //!< that is on the terminal
};

}  // namespace fastlio
