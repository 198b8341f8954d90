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
struct Caught
{
  int signal;
  bool ends_when_repeated;  //!< so that a second Ctrl-C always works
  bool stays_ignored;       //!< where it is ignored already: by nohup, for example
};

// Own writes cause the last two again and again.
constexpr std::array<Caught, 5> kCaught = {{
    {SIGINT, true, false},
    {SIGTERM, true, false},
    {SIGHUP, true, true},
    {SIGPIPE, false, true},
    {SIGXFSZ, false, true},
}};
}  // namespace

void catchInterruptions()
{
  struct sigaction action = {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  for (const Caught& caught : kCaught)
  {
    struct sigaction before = {};
    sigaction(caught.signal, nullptr, &before);
    if (caught.stays_ignored && before.sa_handler == SIG_IGN) continue;
    // Reads go on, so that no data look truncated.
    action.sa_flags = SA_RESTART | (caught.ends_when_repeated ? static_cast<int>(SA_RESETHAND) : 0);
    sigaction(caught.signal, &action, nullptr);
  }
}

bool interrupted()
{
  return signal_received != 0;
}

}  // namespace fastlio
