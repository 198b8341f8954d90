// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "interruption.h"

#include <csignal>

namespace fastlio
{
namespace
{
// The only state that a signal handler may touch; hence a variable of the process.
volatile std::sig_atomic_t signal_received = 0;

void remember(int /*signal*/)
{
  signal_received = 1;
}
}  // namespace

void catchInterruptions()
{
  struct sigaction action = {};
  action.sa_handler = remember;
  // One shot, so that a second Ctrl-C always works; reads go on, so that no data look truncated.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted()
{
  return signal_received != 0;
}

}  // namespace fastlio
