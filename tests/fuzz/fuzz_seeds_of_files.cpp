// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "fuzz_targets.h"
#include "test_files.h"
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/pointmap/incremental_points_map.h>

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <cstring>
#include <stdexcept>

namespace fastlio::testing
{
namespace
{
std::string numbers(std::initializer_list<float> values)
{
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.begin(), bytes.size());
  return bytes;
}

std::vector<Seed> plySeeds()
{
  const std::string xyz =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
  return {
      {"ascii", "ply\nformat ascii 1.0\ncomment small\n" + xyz + "end_header\n1 2 3\n4 5 -6.5e1\n"},
      {"binary", "ply\nformat binary_little_endian 1.0\n" + xyz + "end_header\n" +
                     numbers({1, 2, 3, 4, 5, 6})},
      {"lists", "ply\nformat ascii 1.0\nelement camera 1\nproperty list uchar int ids\n" + xyz +
                    "end_header\n3 7 8 9\n1 2 3\n4 5 6\n"},
      {"big_endian",
       "ply\nformat binary_big_endian 1.0\nelement face 1\n"
       "property list uint8 float64 weights\nelement vertex 1\nproperty double x\n"
       "property short y\nproperty uchar z\nend_header\n" +
           std::string("\1\0\0\0\0\0\0\0\0\x3F\xF0\0\0\0\0\0\0\0\1\2", 20)}};
}

std::vector<Seed> pcdSeeds()
{
  const std::string head =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\n"
      "COUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";
  return {
      {"ascii", head + "DATA ascii\n1 2 3 4\n5 6 7 8\n"},
      {"binary", head + "DATA binary\n" + numbers({1, 2, 3, 4, 5, 6, 7, 8})},
      {"wide",
       "VERSION 0.7\nFIELDS rgb z x normal y\nSIZE 4 8 4 4 4\nTYPE U F F F F\n"
       "COUNT 1 1 1 3 1\nPOINTS 1\nDATA ascii\n7 3.5 1.25 0 0 1 2\n"}};
}

std::vector<Seed> archiveSeeds()
{
  mrpt::maps::CSimplePointsMap points;
  CIncrementalPointsMap incremental(0.1);
  CVoxelPlanesMap planes;
  WorldPoints wall;
  for (int i = 0; i < 60; ++i)
  {
    wall.x.push_back(0.1F * static_cast<float>(i % 10));
    wall.y.push_back(0.1F * static_cast<float>(i / 10));
    wall.z.push_back(0.0F);
    points.insertPoint(wall.x.back(), wall.y.back(), 0.0F);
    incremental.insertPoint(wall.x.back(), wall.y.back(), 0.0F);
  }
  planes.insertPoints(wall, {0.0, 0.0, 5.0});
  mrpt::maps::CMultiMetricMap several;
  several.maps.push_back(mrpt::maps::CSimplePointsMap::Create());
  several.maps.push_back(std::make_shared<mrpt::maps::CSimplePointsMap>(points));
  return {
      {"points", serialize(points)},
      {"incremental", serialize(incremental)},
      {"planes", serialize(planes)},
      {"several", serialize(several)}};
}

std::vector<Seed> trajectorySeeds()
{
  return {
      {"tum", "# time x y z qx qy qz qw\n1.5 0 0 0 0 0 0 1\n1.6 1 2 3 0 0 0.6 0.8\n"},
      {"kitti", "1 0 0 0 0 1 0 0 0 0 1 0\n0 -1 0 1 1 0 0 2 0 0 1 3e0\n"},
      {"states.csv",
       "stamp_ns,x,y,z,qx,qy,qz,qw,vx\n1500000000,0,0,0,0,0,0,1,0\n1600000000,1,2,3,0,0,0,1,0\n"},
      {"covariance.csv",
       "stamp_ns,x,y,z,qx,qy,qz,qw,c_rx_rx,c_rx_ry,c_rx_rz,c_rx_px,c_rx_py,c_rx_pz,c_ry_ry,c_ry_rz,"
       "c_ry_px,c_ry_py,c_ry_pz,c_rz_rz,c_rz_px,c_rz_py,c_rz_pz,c_px_px,c_px_py,c_px_pz,c_py_py,"
       "c_py_pz,c_pz_pz\n1500000000,0,0,0,0,0,0,1,1,0,0,0,0,0,1,0,0,0,0,1,0,0,0,1,0,0,1,0,1\n"}};
}

std::vector<Seed> labelSeeds()
{
  return {
      {"plain", "lidar_\\d+\nlidar_12"},
      {"nested", "((a|b)+[[:alpha:]]*)+?x{2,50}\naaaabbbb"},
      {"exponential", "(a+)+b\naaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"},
      {"escaped", "lidar\\(1\\)|\\x41\\Q.\\E[^a-z]$\nlidar(1)\x1B[2J\xE2\x80\xAE"}};
}

std::vector<Seed> externalSeeds()
{
  mrpt::maps::CSimplePointsMap points;
  points.insertPoint(1, 2, 3);
  return {
      {"archive", "own.bin\n" + serialize(points)},
      {"kitti", "./own.bin\n" + numbers({1, 2, 3, 0.5F, 4, 5, 6, 0.25F})},
      {"text", "near.bin\n1 2 3\n4 5 6\n"},
      {"flat", "near.bin\n1 2\n4 5\n"},
      {"outside", "../log.rawlog\nx"},
      {"device", "/dev/zero\nx"}};
}

std::vector<Seed> commandLineSeeds()
{
  return {
      {"run", "-c\nparams.yaml\n--input-rawlog\na.rawlog\n--output-dir\nout\n--threads\n2\n"},
      {"map",
       "--input-rawlog=a\n--output-tum-path=b\n--map-in\nm\n--initial-pose\n1,2,3,4,5,6\n"
       "--no-map-update\n"},
      {"dump", "--dump-config\nmain\n-v\nDEBUG\n--skip-first-n\n3\n--only-first-n\n9\n"},
      {"help", "--help\n--version\n--export\nply,pcd\n--frame\nimu\n--imu-rate\n"}};
}
}  // namespace

std::vector<Seed> seedsOfFiles(const std::string& target)
{
  if (target == "ply") return plySeeds();
  if (target == "pcd") return pcdSeeds();
  if (target == "archive") return archiveSeeds();
  if (target == "trajectory") return trajectorySeeds();
  if (target == "label") return labelSeeds();
  if (target == "external") return externalSeeds();
  if (target == "commandline") return commandLineSeeds();
  throw std::invalid_argument("no seeds for " + target);
}

}  // namespace fastlio::testing
