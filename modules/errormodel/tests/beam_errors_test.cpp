// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/beam_errors.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace fastlio
{
namespace
{
constexpr double kWeight = 1.0 / 4e-4;  // of a range noise of 2 cm
constexpr double kRadius = 8.0;         // of the room [m]

/** A scan of sixteen lasers in a round room of surfaces that are turned at random. */
class RandomRoom
{
 public:
  /** \param leaning how much the surfaces look upward, all alike: then range and elevation do the
   * same to most of the residuals */
  explicit RandomRoom(double leaning = 0.0) : leaning_(leaning) {}

  template <typename OffsetOf>
  void scan(BeamErrors& beams, double noise, const OffsetOf& offsetOf)
  {
    DeskewedScan scan;
    scan.surfaces.resize(std::size_t{kLines} * kColumns);
    std::vector<PlaneMatch> matches(scan.surfaces.size());
    for (int i = 0; i < kLines * kColumns; ++i)
    {
      const double elevation = (-15.0 + 2.0 * (i % kLines)) * M_PI / 180.0;
      const double azimuth = 0.5 * M_PI * i / (kLines * kColumns);  // one corner of the room
      const double cosine = std::cos(elevation);
      const Vec3 beam(cosine * std::cos(azimuth), cosine * std::sin(azimuth), std::sin(elevation));
      const Vec3 upward(
          -std::sin(elevation) * std::cos(azimuth), -std::sin(elevation) * std::sin(azimuth),
          cosine);
      const Vec3 turned(normal_(random_), normal_(random_), normal_(random_));
      const Vec3 normal = (beam + 0.5 * turned + leaning_ * upward).normalized();
      const Vec3 sideways(-beam.y(), beam.x(), 0.0);
      const BeamOffset offset = offsetOf(i % kLines);
      const double z = offset.range * normal.dot(beam) +
                       kRadius * offset.elevation * normal.dot(upward) +
                       kRadius * offset.azimuth * normal.dot(sideways) + noise * normal_(random_);
      const auto k = static_cast<std::size_t>(i);
      scan.surfaces.x[k] = static_cast<float>(kRadius * beam.x());
      scan.surfaces.y[k] = static_cast<float>(kRadius * beam.y());
      scan.surfaces.z[k] = static_cast<float>(kRadius * beam.z());
      scan.surfaces.beam_bin[k] = static_cast<std::uint16_t>(beamBin(beam.z()));
      PlaneMatch& plane = matches[k];
      plane.nx = static_cast<float>(normal.x());
      plane.ny = static_cast<float>(normal.y());
      plane.nz = static_cast<float>(normal.z());
      plane.d = static_cast<float>(z - kRadius * normal.dot(beam));
      plane.variance = static_cast<float>(1.0 / kWeight);
      plane.created_insertion = 1;
    }
    beams.add(Pose{}, scan, measured(scan, matches), matches);
  }

 private:
  static constexpr int kLines = 16, kColumns = 60;

  /** The planes' offsets are all that is uncertain. */
  static MeasuredScan measured(const DeskewedScan& scan, const std::vector<PlaneMatch>& matches)
  {
    ResidualModel model;
    model.range_variance = 0.0;
    model.gate = 1e6;
    MeasuredScan measured;
    measured.measure(Workers(1), Pose{}, scan.surfaces, matches, model);
    return measured;
  }

  double leaning_;
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

constexpr int kScans = 3000;  // one of four is sampled

TEST(BeamErrors, AreNoneInNoise)
{
  RandomRoom room;
  BeamErrors beams(false);
  EXPECT_EQ(beams.rangeOffset(), 0.0);
  EXPECT_EQ(beams.pulls(Mat3::Identity()).norm(), 0.0);
  for (int i = 0; i < kScans; ++i)
    room.scan(beams, 0.02, [](int) { return BeamOffset{}; });
  EXPECT_LT(beams.rangeOffset(), 5e-4);
  EXPECT_LT(beams.elevationOffset(), 1e-4);
  EXPECT_LT(beams.azimuthOffset(), 1e-4);
}

TEST(BeamErrors, AreAsLargeAsTheOffsetsOfTheLasers)
{
  const auto sign = [](int line) { return line % 2 == 0 ? 1.0 : -1.0; };
  RandomRoom room;
  BeamErrors by_range(false), by_elevation(false), by_azimuth(false);
  for (int i = 0; i < kScans; ++i)
  {
    room.scan(by_range, 0.02, [&](int line) { return BeamOffset{0.01 * sign(line), 0.0, 0.0}; });
    room.scan(
        by_elevation, 0.02,
        [&](int line) {
          return BeamOffset{0.0, 1e-3 * sign(line), 0.0};
        });
    room.scan(by_azimuth, 0.02, [&](int line) { return BeamOffset{0.0, 0.0, 1e-3 * sign(line)}; });
  }
  EXPECT_NEAR(by_range.rangeOffset(), 0.01, 5e-4);
  EXPECT_NEAR(by_elevation.elevationOffset(), 1e-3, 5e-5);
  EXPECT_NEAR(by_azimuth.azimuthOffset(), 1e-3, 5e-5);
}

TEST(BeamErrors, OfTheElevationAreNotTakenForThoseOfTheRange)
{
  RandomRoom room(0.7);
  BeamErrors beams(false);
  for (int i = 0; i < kScans; ++i)
    room.scan(
        beams, 0.02,
        [](int line) {
          return BeamOffset{0.0, line % 2 == 0 ? 1e-3 : -1e-3, 0.0};
        });
  EXPECT_LT(beams.rangeOffset(), 5e-4);
  EXPECT_NEAR(beams.elevationOffset(), 1e-3, 5e-5);
}

/** What offsets of 1 cm do to a scan whose planes were created from there. */
double traceWithPlanesFrom(const Pose& T_world_lidar)
{
  RandomRoom room;
  BeamErrors beams(false);
  beams.recordInsertion(1, T_world_lidar);
  for (int i = 0; i < 200; ++i)
    room.scan(
        beams, 0.02,
        [](int line) {
          return BeamOffset{line % 2 == 0 ? 0.01 : -0.01, 0.0, 0.0};
        });
  return beams.pulls(Mat3::Identity()).squaredNorm();
}

TEST(BeamErrors, AreInTheMapWhereTheSameBeamsHaveMadeIt)
{
  const double here = traceWithPlanesFrom({});
  const double elsewhere = traceWithPlanesFrom({Mat3::Identity(), {0.0, 0.0, 3.0}});
  EXPECT_GT(elsewhere, 0.0);
  EXPECT_LT(here, 1e-6 * elsewhere);
}

TEST(CreatingViews, KnowFromWhereAnInsertionWasMade)
{
  CreatingViews views;
  EXPECT_EQ(views.T_lidar_world(1), nullptr);
  for (std::uint32_t insertion = 5; insertion < 1005; ++insertion)
    views.record(insertion, {Mat3::Identity(), {0.1 * insertion, 0.0, 0.0}});
  EXPECT_EQ(views.T_lidar_world(4), nullptr);
  ASSERT_NE(views.T_lidar_world(1004), nullptr);
  EXPECT_DOUBLE_EQ(views.T_lidar_world(1004)->p.x(), -100.4);
  // Of a thousand, old ones are thinned out to every sixteenth.
  EXPECT_NEAR(views.T_lidar_world(500)->p.x(), -50.0, 1.6);
  views.clear();
  EXPECT_EQ(views.T_lidar_world(1004), nullptr);
}

TEST(BeamErrors, DoNotAverageOutWithTheNumberOfPoints)
{
  // The sum over all points of a laser grows with their number, and so does its standard deviation:
  // independent errors would grow with the root.
  RandomRoom room;
  BeamErrors beams(false);
  for (int i = 0; i < 200; ++i)
    room.scan(
        beams, 0.02,
        [](int line) {
          return BeamOffset{line % 2 == 0 ? 0.01 : -0.01, 0.0, 0.0};
        });
  constexpr double kPoints = 16 * 60;
  const double independent = kPoints * std::pow(kWeight * 0.01, 2);
  const double trace = beams.pulls(Mat3::Identity()).bottomRows<3>().squaredNorm();
  EXPECT_GT(trace, 3.0 * independent);
}

TEST(BeamErrors, TurnWithTheSensor)
{
  // Errors along the beams: what they do to the position is turned by R.
  RandomRoom room;
  BeamErrors beams(false);
  for (int i = 0; i < 200; ++i)
    room.scan(
        beams, 0.02,
        [](int line) {
          return BeamOffset{line % 2 == 0 ? 0.01 : -0.01, 0.0, 0.0};
        });
  const Mat3 R = expSO3({0.2, -0.4, 1.0});
  const BeamPulls before = beams.pulls(Mat3::Identity()), after = beams.pulls(R);
  EXPECT_GT(before.norm(), 0.0);
  EXPECT_TRUE(after.topRows<3>().isApprox(before.topRows<3>()));
  EXPECT_TRUE(after.bottomRows<3>().isApprox(R * before.bottomRows<3>()));
}
}  // namespace
}  // namespace fastlio
