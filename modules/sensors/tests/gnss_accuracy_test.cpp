// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/sensors/gnss_accuracy.h>

#include <gtest/gtest.h>
#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/obs/gnss_messages_novatel.h>

#include <limits>
#include <optional>
#include <vector>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservationGPS;
using mrpt::obs::gnss::Message_NMEA_GGA;
using mrpt::obs::gnss::Message_NV_OEM6_BESTPOS;

CObservationGPS observationAt(double latitude, double longitude)
{
  CObservationGPS observation;
  Message_NMEA_GGA gga;
  gga.fields.fix_quality = 1;
  gga.fields.latitude_degrees = latitude;
  gga.fields.longitude_degrees = longitude;
  gga.fields.altitude_meters = 100.0;
  gga.fields.geoidal_distance = 46.0;
  observation.setMsg(gga);
  return observation;
}

/** As CObservationGPS is in newer versions of MRPT. */
struct NewerObservation
{
  std::optional<mrpt::math::CMatrixDouble33> covariance_enu;
};
}  // namespace

TEST(GnssAccuracy, IsWhatWasStated)
{
  CObservationGPS observation = observationAt(36.5, -4.25);
  EXPECT_FALSE(statedStdOf(observation));
  setStatedCovariance(observation, {0.25, 0.1, 0.0, 0.1, 4.0, 0.0, 0.0, 0.0, 9.0});
  ASSERT_TRUE(statedStdOf(observation));
  EXPECT_LT((*statedStdOf(observation) - Vec3(0.5, 2.0, 3.0)).norm(), 1e-6);
}

TEST(GnssAccuracy, OfWhatIsNoVarianceIsNotThere)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, nan, infinity, 1e9})
    for (const std::size_t at : {0U, 4U, 8U})
    {
      EnuCovariance covariance{1, 0, 0, 0, 1, 0, 0, 0, 1};
      covariance[at] = bad;
      CObservationGPS observation = observationAt(36.5, -4.25);
      setStatedCovariance(observation, covariance);
      EXPECT_FALSE(statedStdOf(observation)) << bad << " at " << at;
      EXPECT_EQ(observation.messages.size(), 1U);
    }
}

/** Whoever reads the second message finds the position of the first one. */
TEST(GnssAccuracy, ComesWithThePositionThatItIsOf)
{
  if (HasEnuCovariance<CObservationGPS>::value)
    GTEST_SKIP() << "MRPT has a member for the covariance";
  CObservationGPS observation = observationAt(36.5, -4.25);
  setStatedCovariance(observation, {0.25, 0, 0, 0, 4.0, 0, 0, 0, 9.0});
  const auto fields = observation.getMsgByClass<Message_NV_OEM6_BESTPOS>().fields;
  EXPECT_EQ(double{fields.lat}, 36.5);
  EXPECT_EQ(double{fields.lon}, -4.25);
  EXPECT_EQ(double{fields.hgt}, 100.0);
  EXPECT_EQ(float{fields.undulation}, 46.0F);
  EXPECT_EQ(float{fields.lon_sigma}, 0.5F);
  EXPECT_EQ(float{fields.lat_sigma}, 2.0F);
  EXPECT_EQ(float{fields.hgt_sigma}, 3.0F);
}

/** NovAtel's receivers send such messages without a position, too. */
TEST(GnssAccuracy, NeedsASolution)
{
  CObservationGPS observation = observationAt(36.5, -4.25);
  Message_NV_OEM6_BESTPOS message;
  message.fields.lat_sigma = message.fields.lon_sigma = message.fields.hgt_sigma = 1.0F;
  message.fields.solution_stat = mrpt::obs::gnss::nv_oem6_solution_status::COLD_START;
  observation.setMsg(message);
  EXPECT_FALSE(statedStdOf(observation));
  message.fields.solution_stat = mrpt::obs::gnss::nv_oem6_solution_status::SOL_COMPUTED;
  observation.setMsg(message);
  EXPECT_TRUE(statedStdOf(observation));
}

TEST(GnssAccuracy, GoesIntoTheMemberWhereThereIsOne)
{
  const EnuCovariance covariance{1, 2, 3, 2, 5, 6, 3, 6, 9};
  NewerObservation observation;
  EXPECT_FALSE(enuCovarianceOf(observation));
  setEnuCovariance(observation, covariance);
  ASSERT_TRUE(observation.covariance_enu);
  EXPECT_EQ((*observation.covariance_enu)(1, 2), 6.0);
  EXPECT_EQ(enuCovarianceOf(observation), std::optional(covariance));
}

}  // namespace fastlio
