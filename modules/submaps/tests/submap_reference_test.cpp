// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// How well the reference of a submap is known as seen from its surfaces.

#include <fastlio/math/time.h>
#include <fastlio/submaps/submap.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
/** The i-th scan of a drive along y that looks along y. \param own what its pose does not share
 * with its neighbours \param shared what it does, by the map */
ScanResult scan(int i, const Matrix6& own, const Matrix6& shared)
{
  ScanResult result;
  result.status = ScanStatus::Tracking;
  result.stamp_ns = toNanoseconds(100.0 + 0.1 * i);
  result.filter.x.R = expSO3({0, 0, 0.5 * M_PI});
  result.filter.x.p = {0.0, 0.1 * i, 0.0};
  result.filter.x.g = {0, 0, -9.81};
  result.filter.P.topLeftCorner<6, 6>() = own + shared;
  result.map_covariance = shared;
  return result;
}

/** A variance of one coordinate of a pose: attitude 0 to 2, position 3 to 5. */
Matrix6 variance(int coordinate, double std)
{
  Matrix6 covariance = Matrix6::Zero();
  covariance(coordinate, coordinate) = std * std;
  return covariance;
}

constexpr int kScans = 21;

/** \param first of the first scan, own and shared \param later of all others */
Submap submapOf(
    const Matrix6& first_own, const Matrix6& first_shared, const Matrix6& later_own,
    const Matrix6& later_shared)
{
  SubmapBuilder builder(0);
  for (int i = 0; i < kScans; ++i)
    EXPECT_FALSE(builder.add(
        i == 0 ? scan(i, first_own, first_shared) : scan(i, later_own, later_shared), {},
        Vec3::Zero()));
  return *builder.finish();
}

const Matrix6 kNone = Matrix6::Zero();
}  // namespace

TEST(SubmapReference, OwnNoiseOfTheFirstScanCountsOnceAndThatOfOthersAveragesOut)
{
  const Matrix6 noise = variance(0, 0.002) + variance(5, 0.01);
  const Submap submap = submapOf(noise, kNone, 0.25 * noise, kNone);
  EXPECT_LT((submap.reference_covariance - noise).norm(), 1e-12);
}

TEST(SubmapReference, WhatAllScansShareIsNoErrorOfIt)
{
  const Matrix6 shared = variance(3, 0.2) + variance(5, 0.1);
  const Submap submap = submapOf(kNone, shared, kNone, shared);
  EXPECT_LT(submap.reference_covariance.norm(), 1e-9);
}

/** A run that begins is unsure of its attitude from the second scan on. The surfaces are those of
 * the later scans. */
TEST(SubmapReference, WhatGrowsAfterItCounts)
{
  const Matrix6 grown = variance(2, 0.004);
  const Submap submap = submapOf(kNone, kNone, kNone, grown);
  const Matrix6& covariance = submap.reference_covariance;
  EXPECT_NEAR(std::sqrt(covariance(2, 2)), 0.004, 1e-4);
  // The reference is up to 2 m behind scans that do not know their heading, and looks along the
  // way.
  const double to_the_side = std::sqrt(covariance(4, 4));
  EXPECT_GT(to_the_side, 0.004 * 1.0);
  EXPECT_LT(to_the_side, 0.004 * 1.4);
  EXPECT_LT(covariance(3, 3), 1e-9);
  EXPECT_LT(covariance(5, 5), 1e-9);
}

}  // namespace fastlio
