// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file extraction_test.cpp Features of simulated sensors against the surfaces that were hit. */

#include <fastlio/lidar/feature_extraction.h>
#include <fastlio/simulation/simulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <vector>

namespace fastlio::testing
{
namespace
{
/** A sensor in the office. */
struct SensorCase
{
  const char* name;
  LidarKind kind;
  bool with_rings;
  ScanLineOrder expected_order;
  std::size_t edges;    // at least, per scan
  double planar_share;  // of planar features whose surroundings are, at least
};

std::ostream& operator<<(std::ostream& out, const SensorCase& sensor)
{
  return out << sensor.name;
}

// The rosette's lasers count as rings: each draws a line of its own.
constexpr SensorCase kSensors[] = {
    {"vlp16", LidarKind::Vlp16, true, ScanLineOrder::Ring, 10, 0.97},
    {"vlp16_without_rings", LidarKind::Vlp16, false, ScanLineOrder::Elevation, 10, 0.97},
    {"os64", LidarKind::Os64, true, ScanLineOrder::Ring, 40, 0.97},
    {"os64_without_rings", LidarKind::Os64, false, ScanLineOrder::Elevation, 40, 0.97},
    {"livox", LidarKind::Livox, true, ScanLineOrder::Ring, 5, 0.85},
};

SimulationSettings settingsOf(const SensorCase& sensor)
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 12.0;
  settings.lidar.kind = sensor.kind;
  return settings;
}

/** A scan and the true normal of the surface at each point, world frame. */
struct KnownScan
{
  PointColumns points;
  std::vector<Vec3> normals;
};

KnownScan knownScan(const Simulation& simulation, std::size_t index, bool with_rings)
{
  const LidarScan scan = simulation.scan(index);
  KnownScan known{scan.points, {}};
  if (!with_rings) std::fill(known.points.ring.begin(), known.points.ring.end(), std::uint16_t{0});
  for (std::size_t i = 0; i < scan.points.size(); ++i)
  {
    const std::int64_t stamp_ns = scan.stamp_ns + scan.points.time_offset_ns[i];
    const Pose T_world_lidar = simulation.truth(stamp_ns).T_world_imu * scan.T_imu_lidar;
    const Vec3 direction(scan.points.x[i], scan.points.y[i], scan.points.z[i]);
    const auto hit = simulation.world().cast(
        {T_world_lidar.p, T_world_lidar.R * direction.normalized()},
        simulation.secondsSinceStart(stamp_ns), 200.0);
    known.normals.push_back(hit ? hit->normal : Vec3::Zero());
  }
  return known;
}

/** Least cosine between the normal at a point and those within a distance of it. */
double leastCosineAround(const KnownScan& scan, std::uint32_t i, double radius)
{
  const PointColumns& p = scan.points;
  double least = 1.0;
  for (std::size_t k = 0; k < p.size(); ++k)
  {
    const Vec3 apart(p.x[k] - p.x[i], p.y[k] - p.y[i], p.z[k] - p.z[i]);
    if (apart.squaredNorm() < radius * radius)
      least = std::min(least, scan.normals[k].dot(scan.normals[i]));
  }
  return least;
}

double shareOf(
    const std::vector<std::uint32_t>& indices, bool (*holds)(double), double radius,
    const KnownScan& scan)
{
  std::size_t count = 0;
  for (const std::uint32_t i : indices)
    count += holds(leastCosineAround(scan, i, radius)) ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(indices.size());
}
}  // namespace

class SensorFeatures : public ::testing::TestWithParam<SensorCase>
{
};

TEST_P(SensorFeatures, EdgesLieWhereSurfacesMeetAndPlanarPointsWhereTheyDoNot)
{
  const SensorCase& sensor = GetParam();
  const Simulation simulation(settingsOf(sensor));
  FeatureLimits limits;
  FeatureExtractor extractor;
  ScanFeatures features;
  for (const std::size_t index : {std::size_t{30}, std::size_t{70}, std::size_t{110}})
  {
    const KnownScan scan = knownScan(simulation, index, sensor.with_rings);
    extractor.extract(scan.points, limits, features);
    EXPECT_EQ(features.line_order, sensor.expected_order);
    ASSERT_GE(features.edges.size(), sensor.edges);
    ASSERT_GT(features.planar.size(), scan.points.size() / 20);
    // Every tenth planar point is enough.
    std::vector<std::uint32_t> planar;
    for (std::size_t k = 0; k < features.planar.size(); k += 10)
      planar.push_back(features.planar[k]);
    EXPECT_GT(
        shareOf(
            features.edges, [](double c) { return c < 0.5; }, 0.3, scan),
        0.95);
    EXPECT_GT(
        shareOf(
            planar, [](double c) { return c > 0.9; }, 0.05, scan),
        sensor.planar_share);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sensor, SensorFeatures, ::testing::ValuesIn(kSensors),
    [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace fastlio::testing
