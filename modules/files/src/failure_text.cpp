// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/failure_text.h>

#include <new>
#include <system_error>

namespace fastlio
{
std::string failureText(const std::exception& failure)
{
  if (dynamic_cast<const std::bad_alloc*>(&failure) != nullptr) return "there is not enough memory";
  const auto* const system = dynamic_cast<const std::system_error*>(&failure);
  if (system != nullptr && system->code() == std::errc::resource_unavailable_try_again)
    return std::string("a thread cannot be started: ") + failure.what();
  return failure.what();
}

}  // namespace fastlio
