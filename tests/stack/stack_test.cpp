// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "planar_error.h"
#include "rewrite.h"
#include "stack_run.h"
#include "surface_distance.h"
#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <iostream>
#include <map>

namespace fastlio::testing
{
namespace
{
using RawlogEdit = StackTest;
using IcpSlam = StackTest;
using ObservationsToMap = StackTest;
using GraphSlam = StackTest;

std::string icpConfiguration(const std::string& rawlog, const std::string& folder)
{
  return "[MappingApplication]\nrawlog_file=" + rawlog + "\nlogOutput_dir=" + folder +
         "\nrawlog_offset=0\nLOG_FREQUENCY=1000000\nSAVE_3D_SCENE=0\nSAVE_POSE_LOG=0\n"
         "CAMERA_3DSCENE_FOLLOWS_ROBOT=0\nSHOW_PROGRESS_3D_REAL_TIME=0\n"
         "localizationLinDistance=0.1\nlocalizationAngDistance=3\ninsertionLinDistance=1.0\n"
         "insertionAngDistance=30\nminICPgoodnessToAccept=0.40\nmatchAgainstTheGrid=0\n"
         "verbosity_level=ERROR\npointsMap_count=1\n"
         "[MappingApplication_pointsMap_00_insertOpts]\nminDistBetweenLaserPoints=0.05\n"
         "fuseWithExisting=0\nisPlanarMap=1\nalso_interpolate=1\n"
         "[ICP]\nmaxIterations=80\nminAbsStep_trans=1e-6\nminAbsStep_rot=1e-6\n"
         "thresholdDist=0.3\nthresholdAng_DEG=5\nALFA=0.8\nsmallestThresholdDist=0.05\n"
         "onlyClosestCorrespondences=1\nICP_algorithm=icpClassic\n";
}

PlanarError errorOf(const std::string& simplemap, const Simulation& simulation)
{
  mrpt::maps::CSimpleMap map;
  EXPECT_TRUE(map.loadFromFile(simplemap)) << simplemap;
  return planarError(map, simulation);
}

void report(const std::string& what, const PlanarError& error)
{
  std::cout << "[  FIGURE  ] " << what << ": map error " << 100.0 * error.rms << " cm rms, "
            << 100.0 * error.largest << " cm at most, " << error.points << " points of "
            << error.key_frames << " keyframes\n";
}

TEST_F(RawlogEdit, ListsTheOdometryOfEveryScan)
{
  REQUIRE_PROGRAM("rawlog-edit");
  const auto result =
      run("rawlog-edit", {"--info", "-i", stack().output("observations", "odometry.rawlog")});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  const std::string scans = std::to_string(stack().simulation().scanCount());
  for (const auto* label : {"imu", "lidar", "pseudo_2d_scan", "odometry", "odometry_2d"})
    EXPECT_NE(result.output.find(std::string(" ") + label + " /"), std::string::npos)
        << label << "\n"
        << result.output;
}

/** 2D SLAM on the planar scans, with our odometry and without: ten scans per second of a walk find
 * each other without any odometry, so that the figures are alike. */
TEST_F(IcpSlam, MapsOnThePlanarScans)
{
  REQUIRE_PROGRAM("icp-slam");
  REQUIRE_PROGRAM("rawlog-edit");
  keepFewScans(stack().output("observations", "odometry.rawlog"), file("with.rawlog"), 1);
  const auto removed =
      run("rawlog-edit", {"--remove-label", "odometry,odometry_2d", "-i", file("with.rawlog"), "-o",
                          file("without.rawlog"), "--overwrite"});
  ASSERT_EQ(removed.exit_status, 0) << removed.output;
  std::map<std::string, PlanarError> errors;
  for (const std::string name : {"with", "without"})
  {
    const auto config =
        write(name + ".ini", icpConfiguration(file(name + ".rawlog"), file("icp-" + name)));
    const auto result = run("icp-slam", {config});
    ASSERT_EQ(result.exit_status, 0) << result.output;
    errors[name] = errorOf(file("icp-" + name + "/_finalmap_.simplemap"), stack().simulation());
    report("icp-slam " + name + " odometry", errors[name]);
  }
  EXPECT_GT(errors["with"].key_frames, 10U);
  EXPECT_LT(errors["with"].rms, 0.25);
}

TEST_F(ObservationsToMap, BuildsTheRoomsFromTheKeyFrames)
{
  REQUIRE_PROGRAM("observations2map");
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(stack().output("observations", "keyframes.simplemap")));
  ASSERT_GT(map.size(), 10U);
  const auto config = write(
      "o2m.ini",
      "[MappingApplication]\npointsMap_count=1\n[MappingApplication_pointsMap_00_insertOpts]\n"
      "minDistBetweenLaserPoints=0.05\nisPlanarMap=0\n");
  const auto result =
      run("observations2map",
          {config, stack().output("observations", "keyframes.simplemap"), file("o2m")});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  mrpt::maps::CSimplePointsMap built;
  ASSERT_TRUE(built.load3D_from_text_file(file("o2m_mrpt__maps__CSimplePointsMap_00.txt")));
  ASSERT_GT(built.size(), 20000U);
  const KeyFrameView first = keyFrame(map, 0);
  const auto scan = first.frame->getObservationByClass<mrpt::obs::CObservationVelodyneScan>();
  ASSERT_TRUE(scan);
  const Pose T_est_imu = toPose(first.pose->getMeanVal());
  const Pose T_sim_est =
      stack().simulation().truth(toNanoseconds(scan->timestamp)).T_world_imu * T_est_imu.inverse();
  std::vector<double> distances;
  for (std::size_t i = 0; i < built.size(); i += 7)
  {
    float x = 0, y = 0, z = 0;
    built.getPoint(i, x, y, z);
    const Vec3 point =
        T_sim_est * Vec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    distances.push_back(testing::surfaceDistance(stack().simulation().world(), point, 0.0));
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  std::cout << "[  FIGURE  ] observations2map: " << built.size() << " points of " << map.size()
            << " keyframes, median distance to the true surfaces " << 100.0 * *middle << " cm\n";
  EXPECT_LT(*middle, 0.05);
}

TEST_F(ObservationsToMap, KeyFramesTellTheTwist)
{
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(stack().output("observations", "keyframes.simplemap")));
  const auto comment =
      keyFrame(map, 5).frame->getObservationByClass<mrpt::obs::CObservationComment>();
  ASSERT_TRUE(comment);
  EXPECT_NE(comment->text.find("linear_velocity: ["), std::string::npos);
  EXPECT_NE(comment->text.find("angular_velocity: ["), std::string::npos);
}

/** Nodes of a graph file of MRPT. */
std::map<int, Vec3> nodesOf(const std::string& path)
{
  std::ifstream in(path);
  std::map<int, Vec3> nodes;
  for (std::string line; std::getline(in, line);)
  {
    std::istringstream cells(line);
    std::string key;
    int id = 0;
    Vec3 p;
    if (cells >> key >> id >> p.x() >> p.y() >> p.z(); key.rfind("VERTEX", 0) == 0) nodes[id] = p;
  }
  return nodes;
}

/** Without loops, the optimum is where the nodes are already. */
TEST_F(GraphSlam, OptimisesThePoseGraph)
{
  REQUIRE_PROGRAM("graph-slam");
  for (const std::string name : {"poses.graph", "poses.g2o"})
  {
    const std::string graph = stack().output("observations", name);
    const auto result =
        run("graph-slam",
            {"--3d", "--levmarq", "--no-span", "-i", graph, "-o", file("optimised.graph")});
    ASSERT_EQ(result.exit_status, 0) << result.output;
    const auto before = nodesOf(graph), after = nodesOf(file("optimised.graph"));
    ASSERT_GT(before.size(), 10U);
    ASSERT_EQ(before.size(), after.size());
    for (const auto& [id, p] : before)
      EXPECT_LT((after.at(id) - p - after.at(0) + before.at(0)).norm(), 1e-3) << name << " " << id;
  }
}

}  // namespace
}  // namespace fastlio::testing
