// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "interruption.h"

#include <array>
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
  for (const int signal : std::array<int, 3>{SIGINT, SIGTERM, SIGHUP})
  {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) continue;  // nohup
    struct sigaction action = {};
    action.sa_handler = remember;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
}

bool interrupted()
{
  return signal_received != 0;
}
}  // namespace fastlio
