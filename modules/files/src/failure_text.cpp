// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/failure_text.h>

#include <new>
#include <system_error>

namespace fastlio
{
namespace
{
/** What passes through MRPT's serialisation comes out in several lines, with addresses of code. */
std::string withoutBacktrace(std::string text)
{
  const std::string head = "==== MRPT exception ====\n", tail = "\nCall stack backtrace:";
  while (text.compare(0, head.size(), head) == 0)
    text = text.substr(head.size(), text.rfind(tail) - head.size());
  return text;
}
}  // namespace

std::string failureText(const std::exception& failure)
{
  if (dynamic_cast<const std::bad_alloc*>(&failure) != nullptr) return "there is not enough memory";
  const auto* const system = dynamic_cast<const std::system_error*>(&failure);
  if (system != nullptr && system->code() == std::errc::resource_unavailable_try_again)
    return std::string("a thread cannot be started: ") + failure.what();
  return withoutBacktrace(failure.what());
}

}  // namespace fastlio
