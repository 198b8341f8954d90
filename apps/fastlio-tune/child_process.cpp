// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "child_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace fastlio
{
namespace
{
using Clock = std::chrono::steady_clock;
constexpr auto kPoll = std::chrono::milliseconds(20);
constexpr auto kFirstPoll = std::chrono::milliseconds(2);
constexpr int kCannotStart = 127;

/** Between fork and exec of a process with threads: only calls that are safe in signal handlers. */
[[noreturn]] void becomeProgram(char* const* arguments, const char* error_file, pid_t parent)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kCannotStart);  // it died before the line above
  // Ctrl-C is for this process, which then ends its children.
  setpgid(0, 0);
  const int null = open("/dev/null", O_RDWR);
  const int errors = open(error_file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (null < 0 || errors < 0 || dup2(null, STDIN_FILENO) < 0 || dup2(null, STDOUT_FILENO) < 0 ||
      dup2(errors, STDERR_FILENO) < 0)
    _exit(kCannotStart);
  execv(arguments[0], arguments);
  _exit(kCannotStart);
}

/** The status when the child has ended. */
std::optional<int> statusOf(pid_t child, int options)
{
  int status = 0;
  pid_t ended = 0;
  do
    ended = waitpid(child, &status, options);
  while (ended < 0 && errno == EINTR);
  if (ended < 0)
    throw std::runtime_error(std::string("cannot wait for a run: ") + std::strerror(errno));
  if (ended == 0) return std::nullopt;
  return status;
}

ChildEnd endedByUs(pid_t child, ChildEnd::Kind kind)
{
  kill(child, SIGKILL);
  (void)statusOf(child, 0);
  return {kind, SIGKILL};
}
}  // namespace

ChildEnd runChild(
    const std::vector<std::string>& words, const std::string& error_file, double timeout,
    const std::function<bool()>& go_on)
{
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  arguments.reserve(copies.size() + 1);
  for (std::string& word : copies)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0)
    throw std::runtime_error(std::string("cannot start a run: ") + std::strerror(errno));
  if (child == 0) becomeProgram(arguments.data(), error_file.c_str(), parent);
  const auto start = Clock::now();
  auto pause = std::chrono::duration_cast<Clock::duration>(kFirstPoll);
  while (true)
  {
    if (const auto status = statusOf(child, WNOHANG))
    {
      if (WIFSIGNALED(*status)) return {ChildEnd::Kind::Killed, WTERMSIG(*status)};
      if (WEXITSTATUS(*status) == kCannotStart)
        throw std::runtime_error("cannot start '" + words[0] + "'");
      return {ChildEnd::Kind::Exited, WEXITSTATUS(*status)};
    }
    if (std::chrono::duration<double>(Clock::now() - start).count() > timeout)
      return endedByUs(child, ChildEnd::Kind::TimedOut);
    if (!go_on()) return endedByUs(child, ChildEnd::Kind::Stopped);
    std::this_thread::sleep_for(pause);
    pause = std::min<Clock::duration>(2 * pause, kPoll);
  }
}
}  // namespace fastlio
