// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file beams_in_map_test.cpp What errors of the beams do over many scans: they are in the map, too. */

#include "map_error_scans.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace fastlio::testing
{
namespace
{
constexpr int kAnError = 17;  // one of the errors of the sensor

/** Three scans that correct half of the error each, on planes that none of them shares with
 * another.
 * \param R_world_scan attitude of each scan
 * \return variance of the position along the sensor's x axis, by an error of the sensor [m^2] */
double varianceOfThreeScans(const std::array<Mat3, 3>& R_world_scan)
{
  MapErrorModel model;
  LinearizedUpdate update = fullTrust();
  update.gain *= 0.5;
  for (const Mat3& R : R_world_scan)
  {
    GroupedMeasurements scan = scanOn({1});
    scan.groups[0].shared_variance = 0.0;
    update.T_world_scan.R = R;
    const Vec3 forward = kScanInformation * R.col(0);
    BeamPulls beams = BeamPulls::Zero();
    beams.col(kAnError).tail<3>() = 2e-3 * forward;
    model.update(update, scan, beams);
  }
  const Matrix6 added = poseAddition(model);
  const Vec3 forward = R_world_scan.back().col(0);
  return forward.dot(added.bottomRightCorner<3, 3>() * forward);
}

// Half of the error comes with each scan, and half of what was there stays: 0.5 + 0.25 + 0.125 of
// 2 mm when the scans share it. Independent ones would add up to 1.15 mm.
TEST(MapError, OfTheSensorStaysWhenThePlanesChange)
{
  const Mat3 ahead = Mat3::Identity();
  EXPECT_NEAR(std::sqrt(varianceOfThreeScans({ahead, ahead, ahead})), 0.875 * 2e-3, 1e-6);
}

// After a quarter of a turn, the error that moved the platform ahead moves it to the left: along
// the new direction, only the last two scans count.
TEST(MapError, OfTheSensorTurnsWithIt)
{
  const Mat3 ahead = Mat3::Identity(), left = expSO3(Vec3(0.0, 0.0, 0.5 * M_PI));
  EXPECT_NEAR(std::sqrt(varianceOfThreeScans({ahead, left, left})), 0.75 * 2e-3, 1e-6);
}

/** One standard deviation of an error of the sensor puts a scan so far ahead [m]. */
BeamPulls aheadBy(double distance)
{
  BeamPulls beams = BeamPulls::Zero();
  beams(3, kAnError) = kScanInformation * distance;
  return beams;
}

/** The sensor measures every scan 2 mm too far ahead, and each scan lies on planes that the one
 * before has created. */
double varianceOnNewGround(std::uint32_t scans)
{
  MapErrorModel model;
  for (std::uint32_t scan = 1; scan <= scans; ++scan)
  {
    model.recordInsertion(scan, {}, {});
    model.update(fullTrust(), scanOn({scan}), aheadBy(2e-3));
  }
  return poseAddition(model)(3, 3);
}

// The map has the errors of the sensor, too, and so each scan goes on from the error of the one
// before: they add up. Independent errors would grow with the root of the number.
TEST(MapError, OfTheSensorAddsUpWhereTheMapIsNew)
{
  for (const std::uint32_t scans : {1U, 2U, 5U, 50U})
    EXPECT_NEAR(std::sqrt(varianceOnNewGround(scans)), scans * 2e-3, scans * 1e-8) << scans;
}

// A laser that is too long pushes the scan off the wall ahead, and the other way off the wall
// behind.
TEST(MapError, OfTheSensorCancelsWhereItPullsTheOtherWay)
{
  MapErrorModel model;
  for (std::uint32_t scan = 1; scan <= 50; ++scan)
  {
    model.recordInsertion(scan, {}, {});
    model.update(fullTrust(), scanOn({scan}), aheadBy(scan % 2 == 0 ? -2e-3 : 2e-3));
  }
  EXPECT_LT(poseAddition(model)(3, 3), 1e-15);
}

// A scan that lies on planes of several insertions has the mean of their errors. These differ, but
// they are all of the beams: nothing of them is left that the beams do not explain.
TEST(MapError, OfTheSensorExplainsThatOfPlanesOfAllAges)
{
  MapErrorModel model;
  for (std::uint32_t scan = 1; scan <= 200; ++scan)
  {
    model.recordInsertion(scan, {}, {});
    const auto older = [scan](std::uint32_t by) { return scan > by ? scan - by : 1; };
    model.update(fullTrust(), scanOn({scan, older(10), older(20)}), aheadBy(2e-3));
  }
  const double explained = std::pow(model.poseByBeams()(3, kAnError), 2);
  EXPECT_GT(std::sqrt(explained), 0.03);
  EXPECT_NEAR(poseAddition(model)(3, 3), explained, 1e-6 * explained);
}
}  // namespace
}  // namespace fastlio::testing
