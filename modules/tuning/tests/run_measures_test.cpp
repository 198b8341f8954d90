// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/run_measures.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

/** A run of 10 s along x at 1 m/s, which slips by \a slip [m] at each scan, in one direction or to
 * and fro; r is the configured variance of the noise, the residuals are of 0.02 m. */
struct RunFolder
{
  RunFolder(double slip, bool alternating, double r)
      : path(fs::path(::testing::TempDir()) / ("run" + std::to_string(getpid())))
  {
    fs::create_directories(path);
    std::ofstream states(path / "states.csv");
    std::ofstream timing(path / "timing.csv");
    states << "# comment\nstamp_ns,x,y,z,vx,vy,vz\n";
    timing << "stamp_ns,status,points_downsampled,points_effective,residual_rms,"
              "normalized_innovation,information_min\n";
    double offset = 0.0;
    for (int i = 0; i < 100; ++i)
    {
      if (i > 0) offset += alternating && i % 2 == 0 ? -slip : slip;
      const std::string stamp = std::to_string(1700000000000000000LL + 100000000LL * i);
      states << stamp << ',' << 0.1 * i << ',' << offset << ",0,1,0,0\n";
      timing << stamp << (i == 0 ? ",first_scan,1000,0,0,0,0\n" : ",tracking,1000,800,0.02,");
      if (i > 0) timing << 0.0004 / r << ',' << 50.0 / r << '\n';
    }
  }
  ~RunFolder() { fs::remove_all(path); }
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  [[nodiscard]] Measures measures() const { return measuresOfRun(path.string()); }
  fs::path path;
};

TEST(RunMeasures, SlipIsWhatPositionsMoveAgainstVelocities)
{
  EXPECT_NEAR(RunFolder(0.0, false, 0.0004).measures().at("slip"), 0.0, 1e-6);
  EXPECT_NEAR(RunFolder(0.01, false, 0.0004).measures().at("slip"), 0.1, 1e-6);
}

TEST(RunMeasures, WhiteCorrectionsSlipLess)
{
  EXPECT_LT(
      RunFolder(0.01, true, 0.0004).measures().at("slip"),
      0.3 * RunFolder(0.01, false, 0.0004).measures().at("slip"));
}

TEST(RunMeasures, ConfiguredNoiseDoesNotMakeTheProxySmaller)
{
  const Measures right = RunFolder(0.01, false, 0.0004).measures();
  const Measures small = RunFolder(0.01, false, 0.00001).measures();
  EXPECT_NEAR(right.at("information"), std::log(50.0 / 0.0004), 1e-6);
  EXPECT_NEAR(right.at("proxy"), small.at("proxy"), 1e-9);
  EXPECT_NEAR(right.at("proxy"), 0.1 * std::pow(50.0 / 0.0004, -0.03), 1e-6);
  EXPECT_NEAR(right.at("residual"), 0.02, 1e-12);
  EXPECT_NEAR(right.at("inliers"), 0.8, 1e-12);
  EXPECT_NEAR(right.at("duration"), 9.9, 1e-6);
}

TEST(RunMeasures, FewScansTellNothing)
{
  const RunFolder folder(0.01, false, 0.0004);
  std::ofstream(folder.path / "states.csv") << "stamp_ns,x,y,z,vx,vy,vz\n1,0,0,0,0,0,0\n";
  EXPECT_EQ(folder.measures().count("proxy"), 0U);
}

TEST(RunMeasures, BrokenTablesAreNamed)
{
  const RunFolder folder(0.01, false, 0.0004);
  for (const char* text :
       {"", "stamp_ns,x\n1,2,3\n", "stamp_ns,x,y\n1,2,3\n",
        "stamp_ns,x,y,z,vx,vy,vz\n1,a,0,0,0,0,0\n"})
  {
    std::ofstream(folder.path / "states.csv") << text;
    try
    {
      (void)folder.measures();
      FAIL() << text;
    }
    catch (const std::runtime_error& e)
    {
      EXPECT_NE(std::string(e.what()).find("states.csv"), std::string::npos) << e.what();
    }
  }
}
}  // namespace
}  // namespace fastlio
