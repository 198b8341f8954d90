// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "planar_error.h"
#include "rewrite.h"
#include "stack_run.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/poses/CPosePDFGaussian.h>

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
  mrpt::poses::CPosePDFGaussian unknown;
  unknown.cov(0, 0) = unknown.cov(1, 1) = 0.1 * 0.1;
  unknown.cov(2, 2) = 0.05 * 0.05;
  CActionRobotMovement2D motion;
  motion.poseChange = mrpt::poses::CPosePDFGaussian::Create(unknown);
  motion.estimationMethod = CActionRobotMovement2D::emScan2DMatching;
  auto actions = CActionCollection::Create();
  actions->insert(motion);
  rewriteRawlog(
      from, to,
      [&](const mrpt::serialization::CSerializable::Ptr& object)
          -> mrpt::serialization::CSerializable::Ptr
      {
        if (std::dynamic_pointer_cast<CActionCollection>(object)) return actions;
        return object;
      });
}

PlanarError errorOf(const std::string& simplemap, const std::string& what)
{
  mrpt::maps::CSimpleMap map;
  EXPECT_TRUE(map.loadFromFile(simplemap)) << simplemap;
  const PlanarError error = planarError(map, StackRun::get().simulation());
  std::cout << "[  FIGURE  ] rbpf-slam " << what << ": map error " << 100.0 * error.rms
            << " cm rms, " << 100.0 * error.largest << " cm at most, " << error.points
            << " points of " << error.key_frames << " keyframes\n";
  return error;
}

/** A particle filter draws its particles from the motions' distributions. */
TEST_F(RbpfSlam, MapsWithTheOdometryOnly)
{
  REQUIRE_PROGRAM("rbpf-slam");
  const std::string motions = stack().output("actions", "odometry.rawlog");
  forgetMotions(motions, file("no-motion.rawlog"));
  auto result =
      run("rbpf-slam", {write("rbpf-with.ini", configuration(motions, file("rbpf-with")))});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const auto with = errorOf(file("rbpf-with/_finalmap_.simplemap"), "with odometry");
  EXPECT_GT(with.key_frames, 10U);
  EXPECT_LT(with.rms, 0.15);

  result = run(
      "rbpf-slam",
      {write("rbpf-without.ini", configuration(file("no-motion.rawlog"), file("rbpf-without")))});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const auto without = errorOf(file("rbpf-without/_finalmap_.simplemap"), "without odometry");
  // It takes scans into the map when the motions show that there is something new to see.
  EXPECT_LT(without.key_frames, 3U);
}

}  // namespace
}  // namespace fastlio::testing
