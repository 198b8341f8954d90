// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recordings_gates_test.cpp The recordings of the folder MRPT_FASTLIO_RECORDINGS_DIR through
 * fastlio-replay with default parameters: it must not diverge, be accurate, and give the same bytes
 * at any number of threads. */

#include "process.h"
#include "recordings_folder.h"
#include <fastlio/evaluation/evaluate.h>
#include <fastlio/evaluation/trajectory_io.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;

/** Largest APE (RMSE after SE(3) alignment) [m] of recordings that are known; others: general. */
double largestApe(const std::string& name)
{
  constexpr double kGeneral = 0.05;
  static const std::map<std::string, double> kKnown{
      {"euroc_v102", 0.0144},
      {"office_vlp16", 0.05},
      {"pandaset002_xyzirt", 0.0180},
      {"shake_os64_xyzirt", 0.0164},
      {"uav_livox_xyzirt", 0.02}};
  const auto known = kKnown.find(name);
  return known == kKnown.end() ? kGeneral : known->second;
}

ProcessResult replay(const std::string& name, int threads, const ScratchFolder& scratch)
{
  const std::string folder = scratch.file("threads-" + std::to_string(threads));
  const std::string rawlog = (fs::path(MRPT_FASTLIO_RECORDINGS_DIR) / (name + ".rawlog")).string();
  return Process(
             {FASTLIO_REPLAY_PROGRAM, "--input-rawlog", rawlog, "--output-dir", folder, "--frame",
              "imu", "--threads", std::to_string(threads)},
             folder + ".log")
      .wait();
}

std::string contentOf(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/** Files that hold results; the others hold times, too. */
const std::vector<std::string>& resultFiles()
{
  static const std::vector<std::string> kFiles{
      "trajectory.tum", "states.csv", "covariance.csv", "map.ply"};
  return kFiles;
}
}  // namespace

class Recording : public ::testing::TestWithParam<std::string>
{
};

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Recording);

TEST_P(Recording, IsTrackedAccurately)
{
  const ScratchFolder scratch(GetParam());
  const ProcessResult end = replay(GetParam(), 2, scratch);
  // Divergence has an exit status of its own.
  ASSERT_EQ(end.exit_status, 0) << end.output;
  const fs::path truth = fs::path(MRPT_FASTLIO_RECORDINGS_DIR) / (GetParam() + ".gt.tum");
  const EvaluationReport report =
      evaluate(readTum(scratch.file("threads-2/trajectory.tum")), readTum(truth.string()));
  EXPECT_LT(report.ape.translation.rmse, largestApe(GetParam())) << "m";
  // pandaset002's first two seconds have no scans.
  EXPECT_GT(report.association.coverage, 0.7);
}

TEST_P(Recording, GivesTheSameBytesAtAnyNumberOfThreads)
{
  const ScratchFolder scratch(GetParam() + "-threads");
  for (const int threads : {1, 2})
  {
    const ProcessResult end = replay(GetParam(), threads, scratch);
    ASSERT_EQ(end.exit_status, 0) << end.output;
  }
  for (const std::string& name : resultFiles())
  {
    const std::string one = contentOf(scratch.file("threads-1/" + name));
    EXPECT_FALSE(one.empty()) << name;
    // Not EXPECT_EQ, which would print both files.
    EXPECT_TRUE(one == contentOf(scratch.file("threads-2/" + name))) << name << " differs";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Folder, Recording, ::testing::ValuesIn(recordingNames()),
    [](const auto& parameter)
    {
      std::string name = parameter.param;  // GoogleTest allows letters, digits and underscores
      for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
      return name;
    });

TEST(Recordings, FolderIsGiven)
{
  if (std::string(MRPT_FASTLIO_RECORDINGS_DIR).empty())
    GTEST_SKIP() << "No recordings are tested: configure with -DMRPT_FASTLIO_RECORDINGS_DIR=FOLDER "
                    "(NAME.rawlog with NAME.gt.tum beside it), or make test RECORDINGS=FOLDER.";
  EXPECT_FALSE(recordingNames().empty())
      << "no NAME.rawlog with NAME.gt.tum in " << MRPT_FASTLIO_RECORDINGS_DIR;
}

}  // namespace fastlio::testing
