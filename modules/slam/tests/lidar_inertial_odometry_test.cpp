// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "walk.h"
#include <fastlio/config/config_document.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/slam/CLidarInertialOdometry.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <optional>

namespace fastlio
{
namespace
{
using testing::observations;
using testing::walk;

CLidarInertialOdometry::Ptr madeByName()
{
  registerSlamClasses();
  const auto object = mrpt::rtti::classFactory("fastlio::CLidarInertialOdometry");
  auto odometry = std::dynamic_pointer_cast<CLidarInertialOdometry>(object);
  if (odometry) odometry->setMinLoggingLevel(mrpt::system::LVL_WARN);
  return odometry;
}

TEST(CLidarInertialOdometry, MadeByNameAndSetUpFromYamlItFollowsTheWalk)
{
  const auto odometry = madeByName();
  ASSERT_TRUE(odometry);
  const Config config = matchingConfig(walk().settings());
  odometry->initialize(mrpt::containers::yaml::FromText(toYaml(config)));
  std::size_t called = 0;
  odometry->setCallback([&called](const OdometryEstimate&) { ++called; });
  for (const auto& observation : observations())
    odometry->onNewObservation(observation);
  odometry->finish();
  EXPECT_NEAR(static_cast<double>(called), static_cast<double>(walk().scanCount()), 3.0);
  ASSERT_TRUE(odometry->latest() && odometry->latest()->vehicle);
  const TrackedPose& last = *odometry->latest()->vehicle;
  const Pose T_true_first = walk().truth(odometry->track().poses().front().stamp_ns).T_world_imu;
  const Pose T_true_last = walk().truth(last.stamp_ns).T_world_imu;
  const Pose expected = T_true_first.inverse() * T_true_last;
  const Pose seen = odometry->track().poses().front().T_world_body.inverse() * last.T_world_body;
  EXPECT_GT(expected.p.norm(), 1.0);
  EXPECT_LT((expected.p - seen.p).norm(), 0.1);
  EXPECT_GT(odometry->map()->size(), 1000U);
}

TEST(CLidarInertialOdometry, RefusesBadYamlAndStaysAsItWas)
{
  const auto odometry = madeByName();
  ASSERT_TRUE(odometry);
  const auto bad = mrpt::containers::yaml::FromText("lidar: {min_rage: 1.0}");
  EXPECT_THROW(odometry->initialize(bad), std::invalid_argument);
  EXPECT_EQ(odometry->parameters().lidar.min_range, OdometryOptions{}.lidar.min_range);
}

/** Two seconds of clouds whose LiDAR has a name, and of inertial samples. */
void feedBeginning(CLidarInertialOdometry& odometry, const std::string& lidar_label)
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 2.0;
  settings.lidar.kind = LidarKind::Os64;
  settings.lidar.stride = 16;
  const Simulation simulation(settings);
  for (const auto& sample : simulation.imu().samples)
    odometry.onNewObservation(toImuObservation(sample));
  for (std::size_t i = 0; i < simulation.scanCount(); ++i)
  {
    const auto scan = toLidarObservation(simulation, i);
    scan->sensorLabel = lidar_label;
    odometry.onNewObservation(scan);
  }
}

TEST(CLidarInertialOdometry, TakesThePresetOfTheLidarThatTheRecordingNames)
{
  const auto odometry = madeByName();
  ASSERT_TRUE(odometry);
  const double given = OdometryOptions{}.lidar.max_range;
  feedBeginning(*odometry, "os2");
  EXPECT_EQ(odometry->parameters().lidar.max_range, 240.0);
  EXPECT_TRUE(odometry->latest());

  // What the user gave stays, also where it is the default; in code, where it is not.
  odometry->initialize(
      mrpt::containers::yaml::FromText("lidar: {max_range: " + std::to_string(given) + "}"));
  feedBeginning(*odometry, "os2");
  EXPECT_EQ(odometry->parameters().lidar.max_range, given);
  Config config;
  config.odometry.lidar.max_range = 33.0;
  odometry->initialize(config);
  feedBeginning(*odometry, "os2");
  EXPECT_EQ(odometry->parameters().lidar.max_range, 33.0);

  odometry->initialize(mrpt::containers::yaml());
  feedBeginning(*odometry, "lidar");
  EXPECT_EQ(odometry->parameters().lidar.max_range, given);
}

TEST(CLidarInertialOdometry, LeavesOtherSensorsAlone)
{
  const auto odometry = madeByName();
  ASSERT_TRUE(odometry);
  odometry->initialize(mrpt::containers::yaml::FromText("input: {imu_sensor_label: 'other'}"));
  odometry->onNewObservation(nullptr);
  odometry->onNewObservation(mrpt::obs::CObservationOdometry::Create());
  for (std::size_t i = 0; i < 900; ++i)
    odometry->onNewObservation(observations()[i]);
  odometry->finish();
  EXPECT_FALSE(odometry->latest());
}

TEST(CLidarInertialOdometry, InitializeStartsAnew)
{
  const auto odometry = madeByName();
  ASSERT_TRUE(odometry);
  std::vector<Vec3> ends;
  for (int run = 0; run < 2; ++run)
  {
    odometry->initialize(matchingConfig(walk().settings()));
    EXPECT_FALSE(odometry->latest());
    for (std::size_t i = 0; i < 900; ++i)
      odometry->onNewObservation(observations()[i]);
    ASSERT_TRUE(odometry->latest() && odometry->latest()->vehicle);
    ends.push_back(odometry->latest()->vehicle->T_world_body.p);
  }
  EXPECT_EQ(ends[0], ends[1]);
}

/** Feeds a part of the walk, in hundredths of its observations. */
void feed(CLidarInertialOdometry& odometry, std::size_t from, std::size_t to)
{
  const std::size_t count = observations().size();
  for (std::size_t i = count * from / 100; i < count * to / 100; ++i)
    odometry.onNewObservation(observations()[i]);
}

CLidarInertialOdometry::Ptr following(const Config& config)
{
  const auto odometry = madeByName();
  odometry->initialize(config);
  return odometry;
}

/** An undisturbed run of the walk: others are compared with it, and use its map. */
const CLidarInertialOdometry& undisturbed()
{
  static const auto odometry = []
  {
    auto run = following(matchingConfig(walk().settings()));
    feed(*run, 0, 100);
    return run;
  }();
  return *odometry;
}

/** Where the vehicle is after so many hundredths, as somebody would guess it. */
VehicleGuess guessAt(std::size_t hundredths)
{
  const auto& at = *observations()[observations().size() * hundredths / 100];
  VehicleGuess guess;
  guess.T_map_vehicle = undisturbed().track().at(toNanoseconds(at.timestamp)).value().T_world_body;
  guess.T_map_vehicle.p += Vec3(-0.2, 0.2, 0.0);
  guess.T_map_vehicle.R = guess.T_map_vehicle.R * expSO3({0.0, 0.0, 0.05});
  return guess;
}

/** Compares the poses from \a first on with the undisturbed run. \return their number */
std::size_t posesInMap(const CLidarInertialOdometry& odometry, std::size_t first)
{
  const auto& poses = odometry.track().poses();
  std::size_t compared = 0;
  for (std::size_t i = first; i < poses.size(); ++i)
  {
    const auto expected = undisturbed().track().at(poses[i].stamp_ns);
    if (!expected) continue;  // the end, by an estimated offset of the clocks
    EXPECT_LT((expected->T_world_body.p - poses[i].T_world_body.p).norm(), 0.05) << i;
    ++compared;
  }
  return compared;
}

TEST(CLidarInertialOdometry, GoesOnInAMapThatIsLoadedInTheMiddleOfARun)
{
  const auto odometry = following(matchingConfig(walk().settings()));
  feed(*odometry, 0, 50);
  const std::size_t before = odometry->track().poses().size();
  EXPECT_GT(before, 10U);
  EXPECT_THROW(odometry->startIn({}, guessAt(50)), std::invalid_argument);
  EXPECT_EQ(odometry->track().poses().size(), before);
  odometry->startIn(undisturbed().savedMap(), guessAt(50));
  EXPECT_TRUE(odometry->track().poses().empty());
  feed(*odometry, 50, 75);
  const std::size_t found = posesInMap(*odometry, 0);
  EXPECT_GT(found, 10U);
  EXPECT_TRUE(odometry->relocalize(guessAt(75)));
  feed(*odometry, 75, 100);
  EXPECT_GT(posesInMap(*odometry, found), 10U);
}

// The second guess says which of the places it is that the first one left open.
TEST(CLidarInertialOdometry, ACertainGuessReplacesAnUncertainOne)
{
  const auto odometry = following(matchingConfig(walk().settings()));
  feed(*odometry, 0, 50);
  const auto positionStd = [&]
  {
    const auto& P = odometry->latest()->result.filter.P;
    return std::sqrt(P.block<3, 3>(kPosition, kPosition).diagonal().maxCoeff());
  };
  VehicleGuess guess = guessAt(50);
  guess.position_std = 0.8;
  odometry->startIn(undisturbed().savedMap(), guess);
  feed(*odometry, 50, 75);
  EXPECT_GT(positionStd(), 0.5);
  guess = guessAt(75);
  guess.position_std = 0.25;
  EXPECT_TRUE(odometry->relocalize(guess));
  feed(*odometry, 75, 100);
  EXPECT_LT(positionStd(), 0.3);
  EXPECT_TRUE(hasPose(odometry->latest()->result.status));
}

/** Whoever is told of a pose may search the vehicle anew at once. */
TEST(CLidarInertialOdometry, AnEstimateOutlivesASearchWithinItsCallback)
{
  const auto odometry = following(matchingConfig(walk().settings()));
  std::optional<Vec3> told;
  odometry->setCallback(
      [&](const OdometryEstimate& estimate)
      {
        if (told || !estimate.vehicle || odometry->track().poses().size() < 5) return;
        told = estimate.vehicle->T_world_body.p;
        const OdometryEstimate* const latest = &odometry->latest().value();
        VehicleGuess guess;
        guess.T_map_vehicle = estimate.vehicle->T_world_body;
        EXPECT_TRUE(odometry->relocalize(guess));
        EXPECT_FALSE(odometry->latest());
        EXPECT_NE(&estimate, latest) << "it went with the latest one";
        EXPECT_EQ(estimate.vehicle->T_world_body.p, *told);
      });
  feed(*odometry, 0, 60);
  EXPECT_TRUE(told);
}

TEST(CLidarInertialOdometry, AMapMayBeLoadedBeforeTheSensorsAreKnown)
{
  const auto odometry = following(matchingConfig(walk().settings()));
  odometry->startIn(undisturbed().savedMap(), {});
  feed(*odometry, 0, 35);
  EXPECT_GT(posesInMap(*odometry, 0), 5U);
  EXPECT_GT(odometry->map()->size(), undisturbed().map()->size() / 2);
}

TEST(CLidarInertialOdometry, AMapOfPlanesIsPointsForARunThatTakesNoPlanes)
{
  Config config = matchingConfig(walk().settings());
  config.odometry.map.type = MapType::Knn;
  const auto odometry = following(config);
  odometry->startIn(undisturbed().savedMap(), {});
  EXPECT_GT(odometry->map()->size(), undisturbed().map()->size() / 4);
}

// A guess that is far off, and believed to be near: no pose is better than a wrong one.
TEST(CLidarInertialOdometry, IsRelocalizedWhereItIsAndNowhereElse)
{
  const auto odometry = following(matchingConfig(walk().settings()));
  EXPECT_FALSE(odometry->relocalize({}));
  feed(*odometry, 0, 60);
  const std::size_t before = odometry->track().poses().size();
  const std::size_t points = odometry->map()->size();
  VehicleGuess far;
  far.T_map_vehicle.p = {60.0, -40.0, 0.0};
  EXPECT_TRUE(odometry->relocalize(far));
  feed(*odometry, 60, 63);
  EXPECT_EQ(odometry->track().poses().size(), before);
  EXPECT_FALSE(odometry->latest() && odometry->latest()->vehicle);

  EXPECT_TRUE(odometry->relocalize(guessAt(63)));
  feed(*odometry, 63, 100);
  EXPECT_GT(posesInMap(*odometry, before), 10U);
  EXPECT_GT(odometry->map()->size(), points / 2);

  const std::size_t at_end = odometry->track().poses().size();
  far.position_std = -1.0;
  EXPECT_THROW((void)odometry->relocalize(far), std::invalid_argument);
  EXPECT_EQ(odometry->track().poses().size(), at_end);
}

}  // namespace
}  // namespace fastlio
