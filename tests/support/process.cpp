// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "process.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace fastlio::testing
{
namespace
{
std::string contentOf(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/** How much slower than usual programs run in this build (sanitizers). */
int timeFactor()
{
  const char* const factor = std::getenv("FASTLIO_TIME_FACTOR");
  return factor == nullptr ? 1 : std::max(1, std::atoi(factor));
}

/** In the child: never returns. */
[[noreturn]] void become(const std::vector<std::string>& command, const std::string& log)
{
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || dup2(file, STDOUT_FILENO) < 0 || dup2(file, STDERR_FILENO) < 0) _exit(126);
  const int nothing = open("/dev/null", O_RDONLY);  // for programs that wait for a key
  if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0) _exit(126);
  std::vector<std::string> texts = command;  // execv wants text that it could change
  std::vector<char*> arguments;
  arguments.reserve(texts.size() + 1);
  for (auto& text : texts)
    arguments.push_back(text.data());
  arguments.push_back(nullptr);
  execv(arguments.front(), arguments.data());
  _exit(127);
}
}  // namespace

Process::Process(const std::vector<std::string>& command, std::string log)
    : pid_(fork()), log_(std::move(log))
{
  if (pid_ < 0) throw std::runtime_error("cannot start " + command.front());
  if (pid_ == 0) become(command, log_);
}

Process::~Process()
{
  if (pid_ <= 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

void Process::signal(int number) const
{
  kill(pid_, number);
}

ProcessResult Process::wait(std::chrono::seconds limit)
{
  const auto end = std::chrono::steady_clock::now() + timeFactor() * limit;
  int status = 0;
  while (waitpid(pid_, &status, WNOHANG) == 0)
  {
    if (std::chrono::steady_clock::now() > end) return {-1, "time limit\n" + contentOf(log_)};
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  pid_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(log_)};
}

}  // namespace fastlio::testing
