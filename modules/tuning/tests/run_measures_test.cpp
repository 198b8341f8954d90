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
 * and fro; the residuals are 0.02 m, the standard deviation of each coordinate is \a sigma [m]. */
struct RunFolder
{
  RunFolder(double slip, bool alternating, double sigma = 0.03)
      : path(fs::path(::testing::TempDir()) / ("run" + std::to_string(getpid())))
  {
    fs::create_directories(path);
    std::ofstream states(path / "states.csv");
    std::ofstream timing(path / "timing.csv");
    states << "# comment\nstamp_ns,x,y,z,vx,vy,vz,sigma_pos_x,sigma_pos_y,sigma_pos_z\n";
    timing << "stamp_ns,status,points_downsampled,points_effective,residual_rms\n";
    double offset = 0.0;
    for (int i = 0; i < 100; ++i)
    {
      if (i > 0) offset += alternating && i % 2 == 0 ? -slip : slip;
      const std::string stamp = std::to_string(1700000000000000000LL + 100000000LL * i);
      states << stamp << ',' << 0.1 * i << ',' << offset << ",0,1,0,0";
      for (int axis = 0; axis < 3; ++axis)
        states << ',' << sigma;
      states << '\n';
      timing << stamp << (i == 0 ? ",first_scan,1000,0,0\n" : ",tracking,1000,800,0.02\n");
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
  EXPECT_NEAR(RunFolder(0.0, false).measures().at("slip"), 0.0, 1e-6);
  EXPECT_NEAR(RunFolder(0.01, false).measures().at("slip"), 0.1, 1e-6);
}

TEST(RunMeasures, WhiteCorrectionsSlipLess)
{
  EXPECT_LT(
      RunFolder(0.01, true).measures().at("slip"),
      0.3 * RunFolder(0.01, false).measures().at("slip"));
}

TEST(RunMeasures, TheProxyGrowsWithSlipAndReportedUncertainty)
{
  const Measures run = RunFolder(0.01, false, 0.03).measures();
  const Measures slips = RunFolder(0.02, false, 0.03).measures();
  const Measures uncertain = RunFolder(0.01, false, 0.06).measures();
  EXPECT_NEAR(run.at("position_std"), 0.03 * std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(run.at("proxy"), 0.1 * 0.03 * std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(slips.at("proxy"), 2.0 * run.at("proxy"), 1e-6);
  EXPECT_NEAR(uncertain.at("proxy"), 2.0 * run.at("proxy"), 1e-6);
}

TEST(RunMeasures, CountsPointsAndTime)
{
  const Measures run = RunFolder(0.01, false).measures();
  EXPECT_NEAR(run.at("residual"), 0.02, 1e-12);
  EXPECT_NEAR(run.at("inliers"), 0.8, 1e-12);
  EXPECT_NEAR(run.at("duration"), 9.9, 1e-6);
}

TEST(RunMeasures, FewScansTellNothing)
{
  const RunFolder folder(0.01, false);
  std::ofstream(folder.path / "states.csv")
      << "stamp_ns,x,y,z,vx,vy,vz,sigma_pos_x,sigma_pos_y,sigma_pos_z\n1,0,0,0,0,0,0,1,1,1\n";
  EXPECT_EQ(folder.measures().count("proxy"), 0U);
}

TEST(RunMeasures, BrokenTablesAreNamed)
{
  const RunFolder folder(0.01, false);
  for (const char* text :
       {"", "stamp_ns,x\n1,2,3\n", "stamp_ns,x,y\n1,2,3\n",
        "stamp_ns,x,y,z,vx,vy,vz\n1,a,0,0,0,0,0\n",
        "stamp_ns,x,y,z,vx,vy,vz\n1,0,0,0,0,0,0\n2,0,0,0,0,0,0\n600000000,0,0,0,0,0,0\n"})
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
