// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/mrpt_messages.h>

namespace fastlio
{
std::string innermostMessage(const std::string& what)
{
  static const std::string kNested = "Original exception:\n", kMessage = "Message:";
  const auto nested = what.rfind(kNested);
  std::string text = nested == std::string::npos ? what : what.substr(nested + kNested.size());
  const auto message = text.find(kMessage);
  if (message != std::string::npos) text = text.substr(message + kMessage.size());
  text = text.substr(0, text.find('\n'));
  const auto start = text.find_first_not_of(' ');
  return start == std::string::npos ? "unknown error" : text.substr(start);
}

}  // namespace fastlio
