// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/recordings/recording_reader.h>

#include <filesystem>

namespace fastlio
{
std::uint64_t recordingBytes(const std::string& path)
{
  namespace fs = std::filesystem;
  constexpr std::size_t kMostFiles = 1'000'000;
  std::error_code error;
  if (!fs::is_directory(path, error))
  {
    const auto size = fs::file_size(path, error);
    return error ? 0 : size;
  }
  std::uint64_t total = 0;
  std::size_t files = 0;
  for (fs::recursive_directory_iterator it(path, error), end;
       !error && it != end && files < kMostFiles; it.increment(error), ++files)
    if (it->is_regular_file(error)) total += it->file_size(error);
  return total;
}

std::string sentenceOf(const ReadProblem& problem)
{
  if (problem.occurrences < 2) return problem.message;
  return problem.message + " (" + std::to_string(problem.occurrences) + " times)";
}

const char* toString(ReadProblemKind kind)
{
  switch (kind)
  {
    case ReadProblemKind::NotFound:
      return "not found";
    case ReadProblemKind::NotARawlog:
      return "not a rawlog";
    case ReadProblemKind::Truncated:
      return "truncated";
    case ReadProblemKind::Corrupt:
      return "corrupt";
    case ReadProblemKind::UnknownClass:
      return "unknown class";
    case ReadProblemKind::ExternalFile:
      return "external file";
    case ReadProblemKind::NotSupported:
      return "not supported";
  }
  return "unknown";
}

}  // namespace fastlio
