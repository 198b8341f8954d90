// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "stack_run.h"
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/simulation/recording.h>

#include <mrpt/rtti/CObject.h>
#include <mrpt/system/os.h>

namespace fastlio::testing
{
namespace
{
using Plugin = StackTest;

const std::string kPlugin = FASTLIO_PLUGIN;

/** Variables with which a program of MRPT can load the plugin, \a libraries before all others: a
 * sanitizer that the plugin is built with has to be there first, and leaks of such a program are
 * not ours. */
std::vector<std::string> ableToLoadThePlugin(const std::string& libraries = {})
{
  return {
      std::string("LD_PRELOAD=") + FASTLIO_SANITIZER_RUNTIME + ":" + libraries,
      "ASAN_OPTIONS=detect_leaks=0"};
}

/** Loaded as any program does that links nothing of this project but the map's header. */
TEST_F(Plugin, MakesTheOdometryByName)
{
  std::string errors;
  ASSERT_TRUE(mrpt::system::loadPluginModules(kPlugin, errors)) << errors;
  const auto odometry = mrpt::rtti::classFactory("fastlio::CLidarInertialOdometry");
  ASSERT_TRUE(odometry);
  EXPECT_STREQ(odometry->GetRuntimeClass()->className, "fastlio::CLidarInertialOdometry");
  for (const auto* name :
       {"fastlio::CVoxelPlanesMap", "fastlio::CIncrementalPointsMap",
        "mrpt::maps::CPointsMapXYZIRT"})
    EXPECT_TRUE(mrpt::rtti::classFactory(name)) << name;
}

/** "Overall number of objects" of rawlog-edit --info. */
long objectsIn(const std::string& report)
{
  const std::string key = "Overall number of objects         : ";
  const auto at = report.find(key);
  return at == std::string::npos ? -1 : std::stol(report.substr(at + key.size()));
}

/** Clouds with the time of every point, as newer versions of MRPT record them. */
TEST_F(Plugin, LetsRawlogEditReadTimedClouds)
{
  REQUIRE_PROGRAM("rawlog-edit");
  SimulationSettings settings = defaultSettings("uav");
  settings.duration = 2.0;
  const Simulation simulation(settings);
  const auto files = writeRecording(simulation, file("uav"));
  const auto expected = static_cast<long>(simulation.scanCount() + simulation.imu().samples.size());
  const auto with =
      run("rawlog-edit", {"-p", kPlugin, "--info", "-i", files.rawlog}, ableToLoadThePlugin());
  EXPECT_EQ(with.exit_status, 0) << with.output;
  EXPECT_EQ(objectsIn(with.output), expected) << with.output;
  if (FASTLIO_MRPT_HAS_XYZIRT) return;  // knows the class
  const auto without = run("rawlog-edit", {"--info", "-i", files.rawlog});
  EXPECT_LT(objectsIn(without.output), expected) << without.output;
}

/** A program without an option for plugins builds our map from its INI file. */
TEST_F(Plugin, LetsObservationsToMapBuildTheMapOfPlanes)
{
  REQUIRE_PROGRAM("observations2map");
  const auto config = write(
      "planes.ini",
      "[MappingApplication]\nfastlio::CVoxelPlanesMap_count=1\n"
      "[MappingApplication_fastlio::CVoxelPlanesMap_00_creationOpts]\nvoxel_size=0.6\n"
      "[MappingApplication_fastlio::CVoxelPlanesMap_00_insertOpts]\nradius=0\n"
      "[MappingApplication_fastlio::CVoxelPlanesMap_00_likelihoodOpts]\nsigma_dist=0.3\n");
  const std::vector<std::string> arguments = {
      config, stack().output("observations", "keyframes.simplemap"), file("planes")};
  const auto without = run("observations2map", arguments);
  const std::string built = file("planes_fastlio__CVoxelPlanesMap_00.metricmap");
  EXPECT_FALSE(std::filesystem::exists(built)) << without.output;
  const auto with = run("observations2map", arguments, ableToLoadThePlugin(kPlugin));
  EXPECT_EQ(with.exit_status, 0) << with.output;
  CVoxelPlanesMap map;
  ASSERT_NO_THROW(map.loadFromFile(built)) << with.output;
  EXPECT_EQ(map.planes().options().voxel_size, 0.6);
  EXPECT_EQ(map.likelihoodOptions.sigma_dist, 0.3);
  EXPECT_GT(map.planes().bestPlanes().size(), 100U);
}

TEST_F(Plugin, LetsIcpSlamBuildOurMaps)
{
  REQUIRE_PROGRAM("icp-slam");
  REQUIRE_PROGRAM("rawlog-edit");
  const auto config = write(
      "icp-planes.ini",
      "[MappingApplication]\nrawlog_file=" + file("scans.rawlog") +
          "\nlogOutput_dir=" + file("icp-planes") +
          "\nrawlog_offset=0\nLOG_FREQUENCY=1000000\nSAVE_3D_SCENE=0\nSAVE_POSE_LOG=0\n"
          "CAMERA_3DSCENE_FOLLOWS_ROBOT=0\nSHOW_PROGRESS_3D_REAL_TIME=0\n"
          "localizationLinDistance=0.1\nlocalizationAngDistance=3\ninsertionLinDistance=0.5\n"
          "insertionAngDistance=20\nminICPgoodnessToAccept=0.40\nmatchAgainstTheGrid=0\n"
          "verbosity_level=ERROR\nfastlio::CIncrementalPointsMap_count=1\n"
          "fastlio::CVoxelPlanesMap_count=1\n"
          "[MappingApplication_fastlio::CIncrementalPointsMap_00_creationOpts]\n"
          "min_spacing=0.05\n"
          "[MappingApplication_fastlio::CIncrementalPointsMap_00_insertOpts]\nisPlanarMap=0\n"
          "minDistBetweenLaserPoints=0.05\n"
          "[MappingApplication_fastlio::CVoxelPlanesMap_00_creationOpts]\nvoxel_size=0.5\n"
          "[ICP]\nmaxIterations=80\nthresholdDist=0.3\nthresholdAng_DEG=5\nALFA=0.8\n"
          "smallestThresholdDist=0.05\nICP_algorithm=icpClassic\n");
  const auto scans =
      run("rawlog-edit",
          {"--keep-label", "pseudo_2d_scan,odometry_2d", "--overwrite", "-i",
           stack().output("observations", "odometry.rawlog"), "-o", file("scans.rawlog")});
  ASSERT_EQ(scans.exit_status, 0) << scans.output;
  const auto result = run("icp-slam", {config}, ableToLoadThePlugin(kPlugin));
  EXPECT_EQ(result.exit_status, 0) << result.output;
  CVoxelPlanesMap map;
  ASSERT_NO_THROW(
      map.loadFromFile(file("icp-planes/_finalmaps_.txt_fastlio__CVoxelPlanesMap_01.metricmap")))
      << result.output;
  EXPECT_EQ(map.planes().options().voxel_size, 0.5);
  EXPECT_FALSE(map.isEmpty());
}

}  // namespace
}  // namespace fastlio::testing
