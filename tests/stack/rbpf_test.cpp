// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "planar_error.h"
#include "stack_run.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <iostream>

namespace fastlio::testing
{
namespace
{
using RbpfSlam = StackTest;

std::string configuration(const std::string& rawlog, const std::string& folder)
{
  return "[MappingApplication]\nrawlog_file=" + rawlog + "\nlogOutput_dir=" + folder +
         "\nrawlog_offset=0\nverbosity_level=ERROR\nLOG_FREQUENCY=1000000\n"
         "GENERATE_LOG_JOINT_H=0\nGENERATE_LOG_INFO=0\nSAVE_MAP_IMAGES=0\nSAVE_3D_SCENE=0\n"
         "SAVE_POSE_LOG=0\nSAVE_ENOSE_READINGS=0\nSHOW_PROGRESS_IN_WINDOW=0\n"
         "SHOW_PROGRESS_IN_WINDOW_DELAY_MS=0\nCAMERA_3DSCENE_FOLLOWS_ROBOT=0\n"
         "debugForceInsertion=0\nPF_algorithm=0\nadaptiveSampleSize=0\nresamplingMethod=0\n"
         "BETA=0.5\nsampleSize=10\npowFactor=0.02\ninsertionLinDistance=1.0\n"
         "insertionAngDistance_deg=30\nlocalizeLinDistance=0.4\nlocalizeAngDistance_deg=10\n"
         "mapSelection=0\npfOptimalProposal_mapSelection=0\noccupancyGrid_count=1\n"
         "[MappingApplication_occupancyGrid_00_creationOpts]\nresolution=0.07\n"
         "[MappingApplication_occupancyGrid_00_insertOpts]\nmapAltitude=0\nuseMapAltitude=0\n"
         "maxDistanceInsertion=20\nmaxOccupancyUpdateCertainty=0.55\n"
         "[MappingApplication_occupancyGrid_00_likelihoodOpts]\nlikelihoodMethod=4\n"
         "LF_decimation=20\nLF_stdHit=0.20\nLF_maxCorrsDistance=0.30\nLF_zHit=0.999\n"
         "LF_zRandom=0.001\nLF_maxRange=80\n";
}

/** Every motion unknown: none, give or take 10 cm and 3 degrees in a tenth of a second. */
void forgetMotions(const std::string& from, const std::string& to)
{
  using namespace mrpt::obs;
  mrpt::io::CFileGZInputStream in(from);
  mrpt::io::CFileGZOutputStream out(to);
  auto reading = mrpt::serialization::archiveFrom(in);
  auto writing = mrpt::serialization::archiveFrom(out);
  mrpt::poses::CPosePDFGaussian unknown;
  unknown.cov(0, 0) = unknown.cov(1, 1) = 0.1 * 0.1;
  unknown.cov(2, 2) = 0.05 * 0.05;
  CActionRobotMovement2D motion;
  motion.poseChange = mrpt::poses::CPosePDFGaussian::Create(unknown);
  motion.estimationMethod = CActionRobotMovement2D::emScan2DMatching;
  CActionCollection actions;
  actions.insert(motion);
  try
  {
    while (true)
    {
      const auto object = reading.ReadObject();
      if (std::dynamic_pointer_cast<CActionCollection>(object))
        writing << actions;
      else
        writing << *object;
    }
  }
  catch (const mrpt::serialization::CExceptionEOF&)
  {
    // The end.
  }
}

/** A particle filter draws its particles from the motions' distributions. */
TEST_F(RbpfSlam, MapsBetterWithTheOdometry)
{
  REQUIRE_PROGRAM("rbpf-slam");
  forgetMotions(stack().output("actions", "odometry.rawlog"), file("no-motion.rawlog"));
  double with = 0.0, without = 0.0;
  for (const bool known : {true, false})
  {
    const std::string name = known ? "rbpf-with" : "rbpf-without";
    const std::string rawlog =
        known ? stack().output("actions", "odometry.rawlog") : file("no-motion.rawlog");
    const auto result = run("rbpf-slam", {write(name + ".ini", configuration(rawlog, file(name)))});
    ASSERT_EQ(result.exit_status, 0) << result.output;
    mrpt::maps::CSimpleMap map;
    ASSERT_TRUE(map.loadFromFile(file(name + "/_finalmap_.simplemap")));
    const PlanarError error = planarError(map, stack().simulation());
    std::cout << "[  FIGURE  ] rbpf-slam " << (known ? "with" : "without")
              << " odometry: map error " << 100.0 * error.rms << " cm rms, "
              << 100.0 * error.largest << " cm at most, " << error.points << " points of "
              << error.key_frames << " key frames\n";
    EXPECT_GT(error.key_frames, 5U);
    (known ? with : without) = error.rms;
  }
  EXPECT_LT(with, 0.1);
  EXPECT_LT(with, 0.5 * without);
}

}  // namespace
}  // namespace fastlio::testing
