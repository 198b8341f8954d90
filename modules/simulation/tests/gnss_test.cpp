// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "folder_listing.h"
#include "short_simulation.h"
#include <fastlio/math/angles.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>
#include <mrpt/topography/conversions.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservationGPS;
using mrpt::obs::gnss::Message_NMEA_GGA;

/** A receiver that stands at the datum for more than a day. */
SimulationSettings longRest()
{
  SimulationSettings settings = defaultSettings("rest");
  settings.duration = 1e5;
  settings.gnss.rate = 1.0;
  return settings;
}

std::vector<SimulatedFix> fixesOf(const SimulationSettings& settings)
{
  return simulateGnss(Motion({}, {}), settings);
}

/** Mean product of an axis' errors that lie so many fixes apart. */
double covarianceOf(const std::vector<SimulatedFix>& fixes, Eigen::Index axis, std::size_t apart)
{
  double sum = 0.0;
  for (std::size_t i = 0; i + apart < fixes.size(); ++i)
    sum += fixes[i].error[axis] * fixes[i + apart].error[axis];
  return sum / static_cast<double>(fixes.size() - apart);
}

TEST(Gnss, NoiseHasTheGivenSizeAndHalfOfItLasts)
{
  SimulationSettings settings = longRest();
  settings.gnss.noise = 1.5;
  settings.gnss.correlation_time = 30.0;
  const auto fixes = fixesOf(settings);
  ASSERT_EQ(fixes.size(), 100001U);
  for (const Eigen::Index axis : {0, 1, 2})
  {
    // 3000 correlation times: 3 sigma of the variance is 5 %.
    const double variance = (axis == 2 ? 4.0 : 1.0) * 1.5 * 1.5;
    EXPECT_NEAR(covarianceOf(fixes, axis, 0), variance, 0.08 * variance);
    EXPECT_NEAR(
        covarianceOf(fixes, axis, 1), 0.5 * std::exp(-1.0 / 30) * variance, 0.06 * variance);
    EXPECT_NEAR(covarianceOf(fixes, axis, 30), 0.5 * std::exp(-1.0) * variance, 0.06 * variance);
    EXPECT_NEAR(covarianceOf(fixes, axis, 300), 0.0, 0.06 * variance);
  }
}

TEST(Gnss, NoiseIsWhiteWithoutACorrelationTime)
{
  SimulationSettings settings = longRest();
  settings.gnss.correlation_time = 0.0;
  const auto fixes = fixesOf(settings);
  EXPECT_NEAR(covarianceOf(fixes, 0, 0), 1.0, 0.02);
  EXPECT_NEAR(covarianceOf(fixes, 0, 1), 0.0, 0.02);
}

TEST(Gnss, LosesThePositionOncePerIntervalForTheGivenTime)
{
  SimulationSettings settings = longRest();
  settings.gnss.outage_interval = 100.0;
  settings.gnss.outage_length = 20.0;
  const auto fixes = fixesOf(settings);
  std::size_t begins = 0, lost = 0;
  for (std::size_t i = 1; i < fixes.size(); ++i)
  {
    begins += fixes[i - 1].known && !fixes[i].known ? 1 : 0;
    lost += fixes[i].known ? 0 : 1;
  }
  EXPECT_NEAR(static_cast<double>(begins), 1000.0, 10.0);  // two that touch are one
  EXPECT_NEAR(static_cast<double>(lost) / static_cast<double>(fixes.size()), 0.2, 0.002);
}

TEST(Gnss, MultipathIsAsFrequentLongAndFarAsItShouldBe)
{
  SimulationSettings settings = longRest();
  const auto clear = fixesOf(settings);
  settings.gnss.multipath = 0.15;
  const auto fixes = fixesOf(settings);
  std::size_t off = 0, run = 0;
  for (std::size_t i = 0; i < fixes.size(); ++i)
  {
    const Vec3 offset = fixes[i].error - clear[i].error;
    EXPECT_EQ(fixes[i].multipath, offset.norm() > 1e-9);
    run = fixes[i].multipath && run > 0 ? run + 1 : (fixes[i].multipath ? 1 : 0);
    if (!fixes[i].multipath) continue;
    ++off;
    EXPECT_GE(offset.head<2>().norm(), 5.0 - 1e-9);
    EXPECT_LE(offset.head<2>().norm(), 30.0 + 1e-9);
    EXPECT_LE(std::abs(offset.z()), offset.head<2>().norm() + 1e-9);
    EXPECT_LT(run, 25U);  // rarely, one begins shortly after another
  }
  EXPECT_NEAR(static_cast<double>(off) / static_cast<double>(fixes.size()), 0.15, 0.01);
}

/** The office with a receiver, for seconds. */
SimulationSettings officeWithReceiver()
{
  SimulationSettings settings = testing::shortSettings("office", 8.0, 100);
  settings.gnss.rate = 5.0;
  settings.gnss.lever_arm = {0.2, -0.1, 0.6};
  settings.gnss.outage_interval = 8.0;
  settings.gnss.outage_length = 2.0;
  return settings;
}

TEST(Gnss, MeasuresTheAntennaAtItsLeverArm)
{
  SimulationSettings settings = officeWithReceiver();
  settings.gnss.noise = 0.0;
  const Simulation simulation(settings);
  ASSERT_EQ(simulation.gnss().size(), 41U);
  for (const SimulatedFix& fix : simulation.gnss())
  {
    const Pose pose = simulation.truth(fix.stamp_ns).T_world_imu;
    EXPECT_LT((fix.antenna - pose * settings.gnss.lever_arm).norm(), 1e-12);
  }
}

TEST(Gnss, LeavesAllOtherSensorsAsTheyWere)
{
  SimulationSettings settings = officeWithReceiver();
  const Simulation with(settings);
  settings.gnss.rate = 0.0;
  const Simulation without(settings);
  EXPECT_TRUE(without.gnss().empty());
  EXPECT_EQ(with.scan(30).points.x, without.scan(30).points.x);
  ASSERT_EQ(with.imu().samples.size(), without.imu().samples.size());
  for (std::size_t i = 0; i < with.imu().samples.size(); ++i)
  {
    ASSERT_EQ(with.imu().samples[i].gyro, without.imu().samples[i].gyro);
    ASSERT_EQ(with.imu().samples[i].accel, without.imu().samples[i].accel);
  }
  EXPECT_EQ(groundTruthText(with), groundTruthText(without));
}

/** East, north and up of the datum, as a user of the recording computes it. */
Vec3 worldOf(const CObservationGPS& observation, const GnssSettings& settings)
{
  const auto& gga = observation.getMsgByClass<Message_NMEA_GGA>().fields;
  mrpt::math::TPoint3D enu;
  mrpt::topography::geodeticToENU_WGS84(
      {gga.latitude_degrees, gga.longitude_degrees, gga.altitude_meters + gga.geoidal_distance},
      enu, {settings.latitude, settings.longitude, settings.height});
  return {enu.x, enu.y, enu.z};
}

TEST(Gnss, FixesSurviveTheRecordingInTheOrderOfStamps)
{
  const testing::TemporaryFolder directory;
  const SimulationSettings settings = officeWithReceiver();
  const Simulation simulation(settings);
  RawlogSource source({writeRecording(simulation, directory.path()).rawlog});
  std::size_t fixes = 0, lost = 0;
  std::int64_t last = 0;
  while (const auto observation = source.next())
  {
    EXPECT_GE(toNanoseconds(observation->timestamp), last);
    last = toNanoseconds(observation->timestamp);
    const auto gnss = std::dynamic_pointer_cast<CObservationGPS>(observation);
    if (!gnss) continue;
    ASSERT_LT(fixes, simulation.gnss().size());
    const SimulatedFix& meant = simulation.gnss()[fixes++];
    const auto& gga = gnss->getMsgByClass<Message_NMEA_GGA>().fields;
    EXPECT_EQ(gnss->sensorLabel, "gnss");
    EXPECT_EQ(last, meant.stamp_ns);
    EXPECT_EQ(gnss->sensorPose.z(), 0.6);
    EXPECT_EQ(gga.fix_quality, meant.known ? 1 : 0);
    EXPECT_EQ(gga.satellitesUsed > 3, meant.known);
    lost += meant.known ? 0 : 1;
    const double off = (worldOf(*gnss, settings.gnss) - meant.antenna).norm();
    EXPECT_TRUE(meant.known ? off < 1e-5 : gga.latitude_degrees == 0.0) << off;
  }
  EXPECT_EQ(fixes, simulation.gnss().size());
  EXPECT_NEAR(static_cast<double>(lost), 10.0, 1.0);
}

TEST(Gnss, MessagesTellTimeHeightsAndQuality)
{
  SimulatedFix fix;
  fix.stamp_ns = 1'700'000'000'250'000'000;  // 2023-11-14 22:13:20.25
  fix.antenna = {0.0, 0.0, 3.0};
  GnssSettings settings;
  const auto message = [&]
  { return toGnssObservation(fix, settings)->getMsgByClass<Message_NMEA_GGA>().fields; };
  EXPECT_EQ(message().UTCTime.hour, 22);
  EXPECT_EQ(message().UTCTime.minute, 13);
  EXPECT_NEAR(message().UTCTime.sec, 20.25, 1e-9);
  EXPECT_NEAR(message().latitude_degrees, 48.1, 1e-11);
  EXPECT_NEAR(message().longitude_degrees, 11.6, 1e-11);
  EXPECT_NEAR(message().altitude_meters, 560.0 + 3.0 - 46.0, 1e-5);
  EXPECT_NEAR(message().geoidal_distance, 46.0, 1e-12);
  EXPECT_NEAR(message().orthometric_altitude, 563.0, 1e-5);
  EXPECT_EQ(message().fix_quality, 1);
  settings.noise = 0.4;
  EXPECT_EQ(message().fix_quality, 2);
  settings.noise = 0.02;
  EXPECT_EQ(message().fix_quality, 4);
}

/** Earth-centred place, by the formulas of the ellipsoid WGS84. */
Vec3 earthCentred(double latitude, double longitude, double height)
{
  constexpr double kA = 6378137.0, kF = 1.0 / 298.257223563, kE2 = kF * (2.0 - kF);
  const double lat = latitude * kRadPerDeg, lon = longitude * kRadPerDeg;
  const double n = kA / std::sqrt(1.0 - kE2 * std::sin(lat) * std::sin(lat));
  return {
      (n + height) * std::cos(lat) * std::cos(lon), (n + height) * std::cos(lat) * std::sin(lon),
      (n * (1.0 - kE2) + height) * std::sin(lat)};
}

TEST(Gnss, PlacesOnTheEarthLieAsInTheWorld)
{
  // Distances over 50 km and all quadrants of the earth.
  for (const double latitude : {-33.9, 0.0, 48.1, 78.2})
    for (const double longitude : {-151.2, 18.4, 180.0})
    {
      GnssSettings settings;
      settings.latitude = latitude;
      settings.longitude = longitude;
      const auto placeOf = [&](const Vec3& world)
      {
        SimulatedFix fix;
        fix.antenna = world;
        const auto f = toGnssObservation(fix, settings)->getMsgByClass<Message_NMEA_GGA>().fields;
        EXPECT_LE(std::abs(f.longitude_degrees), 180.0);
        return earthCentred(
            f.latitude_degrees, f.longitude_degrees, f.altitude_meters + f.geoidal_distance);
      };
      const Vec3 origin = placeOf(Vec3::Zero());
      for (const Vec3& world :
           {Vec3(40.0, -700.0, 8.0), Vec3(-30000.0, 40000.0, 120.0), Vec3(0.0, 0.0, 50.0)})
        EXPECT_NEAR((placeOf(world) - origin).norm(), world.norm(), 1e-4);
      // Up is away from the earth's middle, north towards its axis' end.
      EXPECT_GT((placeOf({0, 0, 10}) - origin).dot(origin), 0.99 * 10.0 * origin.norm());
      EXPECT_NEAR((placeOf({0, 10, 0}) - origin).z(), 10.0 * std::cos(latitude * kRadPerDeg), 1e-3);
      EXPECT_NEAR((placeOf({10, 0, 0}) - origin).z(), 0.0, 1e-3);
    }
}

TEST(Gnss, SameSettingsGiveTheSameBytesAndTheScenarioTellsTheTruth)
{
  const testing::TemporaryFolder a, b;
  SimulationSettings settings = officeWithReceiver();
  settings.gnss.multipath = 0.9;
  const Simulation simulation(settings);
  const RecordingFiles one = writeRecording(simulation, a.path());
  const RecordingFiles same = writeRecording(Simulation(settings), b.path());
  EXPECT_EQ(testing::contentOf(one.rawlog), testing::contentOf(same.rawlog));
  const auto scenario = nlohmann::json::parse(testing::contentOf(one.scenario));
  const auto truth = scenario["truth"]["gnss"];
  EXPECT_EQ(truth["datum"]["latitude_deg"], 48.1);
  EXPECT_EQ(truth["lever_arm_m"][2], 0.6);
  EXPECT_EQ(scenario["counts"]["gnss_fixes"], 41);
  ASSERT_EQ(truth["outages_s"].size(), 1U);
  const double begin = truth["outages_s"][0][0], end = truth["outages_s"][0][1];
  EXPECT_NEAR(end - begin, 1.9, 0.15);
  EXPECT_FALSE(truth["multipath_s"].empty());
  settings.gnss.rate = 0.0;
  const auto off = nlohmann::json::parse(scenarioJson(Simulation(settings)));
  EXPECT_FALSE(off["truth"].contains("gnss"));
}
}  // namespace
}  // namespace fastlio
