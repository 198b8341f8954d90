// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file fuzz_test.cpp The short run: the corpus as it is, and mutations of it, the same ones every
 * time. `make fuzz` runs the same targets for long. */

#include "fuzz_targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <sys/resource.h>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;
using Random = std::mt19937_64;

// The inputs have some kilobytes; what a reader believes without checking has gigabytes.
constexpr long kLargestGrowthKb = 128L * 1024L;
constexpr double kLongestInput = 10.0;  // [s]

fs::path corpusOf(const std::string& target)
{
  return fs::path(FASTLIO_SOURCE_DIR) / "tests" / "fuzz" / "corpus" / target;
}

std::string contentOf(const fs::path& path)
{
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> corpus(const std::string& target)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(corpusOf(target)))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> inputs;
  for (const fs::path& file : files)
    inputs.push_back(contentOf(file));
  return inputs;
}

/** Numbers that readers trip over. */
void putNumber(std::string& bytes, std::size_t at, Random& random)
{
  constexpr std::uint32_t kNumbers[] = {0,          1,          0x7fffffff, 0x80000000,
                                        0xffffffff, 0xfffffffe, 0x10000000, 0x7f800000,
                                        0x7fc00000, 0x00ffffff, 0x0000ffff, 0x3fffffff};
  const std::uint32_t number = kNumbers[random() % (sizeof(kNumbers) / sizeof(*kNumbers))];
  for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i)
    bytes[at + i] = static_cast<char>(number >> (8 * i));
}

/** Text that readers trip over, in place of a number of a text. */
void putNumberText(std::string& bytes, std::size_t at)
{
  constexpr const char* kNumbers[] = {
      "0",     "-1",  "1",    "4294967295", "4294967296", "2147483648", "18446744073709551615",
      "1e308", "nan", "-inf", "1e-320",     "0x10",       "65536",      "99999999999999999999"};
  constexpr const char* kDigits = "0123456789.-+e";
  const std::size_t begin = bytes.find_first_of(kDigits, at);
  if (begin == std::string::npos) return;
  const std::size_t end = std::min(bytes.find_first_not_of(kDigits, begin), bytes.size());
  bytes.replace(begin, end - begin, kNumbers[(at + bytes.size()) % std::size(kNumbers)]);
}

/** Where the body begins of a file with a header in text; 0 for others. */
std::size_t bodyOf(const std::string& bytes)
{
  for (const std::string& end :
       {std::string("end_header\n"), std::string("DATA binary\n"), std::string("DATA ascii\n")})
    if (const std::size_t at = bytes.find(end); at != std::string::npos) return at + end.size();
  return 0;
}

void mutateOnce(std::string& bytes, const std::string& other, Random& random)
{
  if (bytes.empty()) bytes = other;
  if (bytes.empty()) return;
  // Half of the time the header stays, so that what it describes is read.
  std::size_t kept = random() % 2 == 0 ? bodyOf(bytes) : 0;
  if (kept >= bytes.size()) kept = 0;
  const std::size_t at = kept + random() % (bytes.size() - kept), length = 1 + random() % 64;
  switch (random() % 8)
  {
    case 6:
      putNumberText(bytes, at);
      break;
    case 0:
      bytes[at] ^= static_cast<char>(1U << (random() % 8));
      break;
    case 1:
      bytes[at] = static_cast<char>(random());
      break;
    case 2:
      putNumber(bytes, at, random);
      break;
    case 3:
      bytes.erase(at, length);
      break;
    case 4:
      bytes.insert(at, bytes.substr(random() % bytes.size(), length));
      break;
    case 5:
      bytes.resize(at);
      break;
    default:
      if (!other.empty()) bytes.insert(at, other.substr(random() % other.size(), 8 * length));
  }
}

std::string mutated(const std::vector<std::string>& inputs, Random& random)
{
  std::string bytes = inputs[random() % inputs.size()];
  const std::size_t times = 1 + random() % 4;
  for (std::size_t i = 0; i < times; ++i)
    mutateOnce(bytes, inputs[random() % inputs.size()], random);
  return bytes;
}

long peakKb()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

/** How often each target is tried; MRPT_FASTLIO_FUZZ_ROUNDS changes it. */
std::size_t rounds(std::size_t normally)
{
  const char* wanted = std::getenv("MRPT_FASTLIO_FUZZ_ROUNDS");
  return wanted == nullptr ? normally : std::strtoul(wanted, nullptr, 10);
}

void fail(const FuzzTarget& target, const std::string& bytes, const std::string& what)
{
  const fs::path kept = fs::temp_directory_path() / (std::string("fuzz-") + target.name);
  std::ofstream(kept, std::ios::binary) << bytes;
  ADD_FAILURE() << target.name << ", " << what << " (kept as " << kept << ")";
}

void tryInput(const FuzzTarget& target, const std::string& bytes, const std::string& which)
{
  const auto begin = std::chrono::steady_clock::now();
  const long before = peakKb();
  try
  {
    target.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  catch (const std::exception& e)
  {
    fail(target, bytes, which + ": " + e.what());
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  if (took.count() > kLongestInput)
    fail(target, bytes, which + ": took " + std::to_string(took.count()) + " s");
  const long growth = peakKb() - before;
  if (growth > kLargestGrowthKb)
    fail(target, bytes, which + ": took " + std::to_string(growth) + " kB");
}
}  // namespace

class Fuzz : public ::testing::TestWithParam<FuzzTarget>
{
};

TEST_P(Fuzz, TheCorpusHoldsTheSeeds)
{
  const fs::path folder = corpusOf(GetParam().name);
  for (const Seed& seed : seedsOf(GetParam().name))
  {
    if (std::getenv("MRPT_FASTLIO_REGENERATE") != nullptr)
    {
      fs::create_directories(folder);
      std::ofstream(folder / seed.name, std::ios::binary) << seed.bytes;
    }
    EXPECT_TRUE(fs::exists(folder / seed.name))
        << folder / seed.name << " is missing; run with MRPT_FASTLIO_REGENERATE=1";
  }
}

TEST_P(Fuzz, EveryInputOfTheCorpusIsRead)
{
  std::size_t index = 0;
  for (const std::string& input : corpus(GetParam().name))
    tryInput(GetParam(), input, "input " + std::to_string(index++));
  EXPECT_GT(index, 0U);
}

TEST_P(Fuzz, MutationsNeitherThrowNorHangNorTakeAllMemory)
{
  const std::vector<std::string> inputs = corpus(GetParam().name);
  ASSERT_FALSE(inputs.empty());
  Random random(7);
  const std::size_t count = rounds(1500);
  for (std::size_t i = 0; i < count && !HasFailure(); ++i)
    tryInput(GetParam(), mutated(inputs, random), "mutation " + std::to_string(i));
}

INSTANTIATE_TEST_SUITE_P(
    Target, Fuzz, ::testing::ValuesIn(fuzzTargets()),
    [](const auto& target) { return std::string(target.param.name); });

}  // namespace fastlio::testing
