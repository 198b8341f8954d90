// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/process_identity.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace fastlio
{
namespace
{
constexpr int kFieldsBeforeStart = 18;  // of /proc/PID/stat, between the state and the start

/** Nothing when there is no such process, or only what is left of it. */
std::optional<std::int64_t> startOf(std::int64_t pid)
{
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto name_end = text.rfind(')');  // names may hold spaces and brackets
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(name_end + 1));
  std::string field;
  fields >> field;
  if (field == "Z" || field == "X") return std::nullopt;
  for (int i = 0; i < kFieldsBeforeStart; ++i)
    fields >> field;
  std::int64_t start = 0;
  if (!(fields >> start)) return std::nullopt;
  return start;
}

std::string hostText()
{
  std::array<char, 256> name = {};
  if (gethostname(name.data(), name.size() - 1) != 0) name = {};
  std::string boot;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id") >> std::ws, boot);
  std::error_code ignored;
  const auto numbers = std::filesystem::read_symlink("/proc/self/ns/pid", ignored);
  return std::string(name.data()) + " " + boot + " " + numbers.string();
}
}  // namespace

ProcessIdentity thisProcess()
{
  const auto pid = static_cast<std::int64_t>(getpid());
  const auto start = startOf(pid);
  if (!start) throw std::runtime_error("/proc/" + std::to_string(pid) + "/stat cannot be read");
  return {hostText(), pid, *start};
}

bool isRunning(const ProcessIdentity& process)
{
  return startOf(process.pid) == process.start;
}

}  // namespace fastlio
