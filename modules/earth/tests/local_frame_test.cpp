// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failure_message.h"
#include "proj_objects.h"
#include <fastlio/earth/local_frame.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace fastlio
{
namespace
{
using testing::failureOf;

const std::vector<GeodeticPoint> kDatums = {
    {48.137, 11.575, 520}, {-33.86, 151.21, 20}, {0, 0, 0},
    {89.9999, 45, 0},      {-90, 0, 2800},       {90, 0, 0},
    {27.99, 86.93, 8848},  {31.5, 35.5, -430},   {-17.7, 179.9999, 5.5},
    {71.2, -180, 0}};

/** PROJ's "topocentric" after its "cart": another implementation of the same frame. */
class ProjTopocentric
{
 public:
  explicit ProjTopocentric(const GeodeticPoint& datum)
      : context_(proj_context_create()),
        pipeline_(proj_create(
            context_.get(),
            ("+proj=pipeline +step +proj=cart +ellps=WGS84 +step +proj=topocentric "
             "+ellps=WGS84 +lon_0=" +
             std::to_string(datum.longitude_deg) + " +lat_0=" + std::to_string(datum.latitude_deg) +
             " +h_0=" + std::to_string(datum.height_m))
                .c_str()))
  {
  }

  Vec3 enuOf(const GeodeticPoint& point)
  {
    const PJ_COORD out = proj_trans(
        pipeline_.get(), PJ_FWD,
        proj_coord(
            proj_torad(point.longitude_deg), proj_torad(point.latitude_deg), point.height_m, 0));
    return {out.xyz.x, out.xyz.y, out.xyz.z};
  }

 private:
  ProjContext context_;
  ProjObject pipeline_;
};

TEST(Geocentric, KnownPlaces)
{
  EXPECT_LT((geocentricOf({0, 0, 0}) - Vec3(6378137, 0, 0)).norm(), 1e-9);
  EXPECT_LT((geocentricOf({0, 90, 100}) - Vec3(0, 6378237, 0)).norm(), 1e-9);
  EXPECT_LT((geocentricOf({90, 0, 0}) - Vec3(0, 0, 6356752.314245179)).norm(), 1e-8);
  EXPECT_LT((geocentricOf({-90, 0, 10}) - Vec3(0, 0, -6356762.314245179)).norm(), 1e-8);
}

TEST(Geocentric, RoundTripEverywhere)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1), height(-12e3, 100e3);
  double worst = 0;
  for (int i = 0; i < 100'000; ++i)
  {
    const GeodeticPoint point{
        std::asin(unit(random)) * 57.29577951308232, 180 * unit(random), height(random)};
    const Vec3 there = geocentricOf(point);
    const GeodeticPoint back = geodeticOf(there);
    worst = std::max(worst, (geocentricOf(back) - there).norm());
    EXPECT_NEAR(back.height_m, point.height_m, 1e-6);
    EXPECT_NEAR(back.latitude_deg, point.latitude_deg, 1e-11);
  }
  EXPECT_LT(worst, 1e-7);
}

TEST(Geocentric, PolesHaveHeights)
{
  for (const double z : {6356752.314245179 + 5, -6356752.314245179 - 5})
  {
    const GeodeticPoint pole = geodeticOf({0, 0, z});
    EXPECT_NEAR(pole.latitude_deg, z > 0 ? 90 : -90, 1e-12);
    EXPECT_NEAR(pole.height_m, 5, 1e-8);
    EXPECT_EQ(pole.longitude_deg, 0);
  }
}

TEST(LocalFrame, RoundTripWithin50Kilometres)
{
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> metres(-50e3, 50e3), up(-500, 3000);
  for (const GeodeticPoint& datum : kDatums)
  {
    const LocalFrame frame(datum);
    for (int i = 0; i < 1000; ++i)
    {
      const Vec3 enu(metres(random), metres(random), up(random));
      EXPECT_LT((frame.enuOf(frame.geodeticOf(enu)) - enu).norm(), 1e-6);
    }
  }
}

TEST(LocalFrame, AgreesWithProj)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> metres(-50e3, 50e3), up(-500, 3000);
  for (const GeodeticPoint& datum : kDatums)
  {
    const LocalFrame frame(datum);
    ProjTopocentric proj(datum);
    for (int i = 0; i < 200; ++i)
    {
      const GeodeticPoint point = frame.geodeticOf({metres(random), metres(random), up(random)});
      EXPECT_LT((frame.enuOf(point) - proj.enuOf(point)).norm(), 1e-6);
    }
  }
}

TEST(LocalFrame, AxesAreEastNorthUp)
{
  const LocalFrame frame({48, 11, 500});
  EXPECT_LT(frame.enuOf({48, 11, 500}).norm(), 1e-8);
  EXPECT_LT((frame.enuOf({48, 11, 510}) - Vec3(0, 0, 10)).norm(), 1e-8);
  EXPECT_NEAR(frame.enuOf({48.001, 11, 500}).y(), 111.2, 0.1);
  EXPECT_NEAR(frame.enuOf({48, 11.001, 500}).x(), 74.6, 0.1);
  // The plane leaves the curved earth.
  EXPECT_NEAR(frame.geodeticOf({1000, 0, 0}).height_m - 500, 0.078, 0.001);
  EXPECT_NEAR(frame.geodeticOf({50'000, 0, 0}).height_m - 500, 196, 1);
}

TEST(LocalFrame, RefusesWhatIsNoPlace)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const GeodeticPoint& wrong : std::vector<GeodeticPoint>{
           {90.1, 0, 0},
           {0, 180.5, 0},
           {0, 0, 2e5},
           {nan, 0, 0},
           {0, nan, 0},
           {0, 0, nan},
           {0, 0, -13e3}})
    EXPECT_THROW(LocalFrame{wrong}, std::invalid_argument);
  EXPECT_EQ(
      failureOf(
          [] {
            const LocalFrame frame({4812.5, 11, 0});
          }),
      "the datum (latitude 4812.5, longitude 11, height 0) is no place on the earth: the latitude "
      "is not within -90 to 90 degrees");
}
}  // namespace
}  // namespace fastlio
