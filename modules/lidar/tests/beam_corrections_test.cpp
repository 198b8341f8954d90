// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/beam_corrections.h>
#include <fastlio/math/angles.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
PointColumns pointAt(double range, double azimuth, double elevation)
{
  PointColumns points;
  points.push_back(
      static_cast<float>(range * std::cos(elevation) * std::cos(azimuth)),
      static_cast<float>(range * std::cos(elevation) * std::sin(azimuth)),
      static_cast<float>(range * std::sin(elevation)), 0.0F, 0, 0);
  return points;
}

TEST(BeamCorrections, TakeTheOffsetsOff)
{
  for (const double elevation : {-15.0, -1.0, 1.0, 13.0, 40.0})
    for (const double azimuth : {0.3, 2.0, -1.5})
    {
      constexpr double kRange = 12.0, kOffset = 0.02, kTurn = 0.1 * kRadPerDeg;
      const double e = elevation * kRadPerDeg;
      PointColumns measured = pointAt(kRange + kOffset, azimuth, e + kTurn);
      BeamCorrections({elevation, kOffset, 0.1}).apply(measured);
      const PointColumns truth = pointAt(kRange, azimuth, e);
      EXPECT_NEAR(measured.x[0], truth.x[0], 1e-4) << elevation;
      EXPECT_NEAR(measured.y[0], truth.y[0], 1e-4) << elevation;
      EXPECT_NEAR(measured.z[0], truth.z[0], 1e-4) << elevation;
    }
}

TEST(BeamCorrections, TurnABeamBackToItsAzimuth)
{
  for (const double azimuth : {0.3, 2.0, -1.5})
  {
    constexpr double kRange = 12.0, kElevation = 5.0 * kRadPerDeg, kTurn = 0.1 * kRadPerDeg;
    BeamCorrections corrections;
    corrections.set(beamBin(std::sin(kElevation)), {0.0, 0.0, kTurn});
    PointColumns measured = pointAt(kRange, azimuth + kTurn, kElevation);
    corrections.apply(measured);
    const PointColumns truth = pointAt(kRange, azimuth, kElevation);
    EXPECT_NEAR(measured.x[0], truth.x[0], 1e-4) << azimuth;
    EXPECT_NEAR(measured.y[0], truth.y[0], 1e-4) << azimuth;
    EXPECT_EQ(measured.z[0], truth.z[0]) << azimuth;
  }
}

TEST(BeamCorrections, LeaveOtherBeamsAndTheAxisAlone)
{
  const BeamCorrections corrections({5.0, 0.05, 0.5});
  for (const double elevation : {-5.0, 1.0, 9.0, 90.0})
  {
    PointColumns points = pointAt(10.0, 1.0, elevation * kRadPerDeg);
    const PointColumns before = points;
    corrections.apply(points);
    EXPECT_EQ(points.x, before.x) << elevation;
    EXPECT_EQ(points.z, before.z) << elevation;
  }
  PointColumns origin = pointAt(0.0, 0.0, 0.0);
  corrections.apply(origin);
  EXPECT_EQ(origin.x[0], 0.0F) << "a missing return";
}

TEST(BeamCorrections, BinsCoverAllElevations)
{
  EXPECT_LT(beamBin(1.0), kBeamBins);
  EXPECT_EQ(beamBin(-1.0), 0U);
  for (std::size_t bin = 1; bin + 1 < kBeamBins; ++bin)
    EXPECT_EQ(beamBin(std::sin(beamElevation(bin))), bin);
  EXPECT_NE(beamBin(std::sin(-0.001)), beamBin(std::sin(0.001))) << "the horizon is an edge";
}
}  // namespace
}  // namespace fastlio
