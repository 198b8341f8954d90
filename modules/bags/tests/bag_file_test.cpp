// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failure_message.h"
#include "recording_test_support.h"

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

TopicMessage fixedIn(const char* parent, const char* child, const Pose& T_parent_child)
{
  return {
      "/tf_static", "tf2_msgs/TFMessage", kStart,
      transformMessage(Wire::Ros1, parent, child, T_parent_child)};
}

class BagFileTest : public RecordingTest
{
};

TEST_F(BagFileTest, ReadsEveryCompressionWithAndWithoutIndex)
{
  const auto messages = smallRecording(Wire::Ros1);
  for (const char* compression : {"none", "bz2", "lz4"})
    for (const bool index : {true, false})
    {
      const Recorded bag = readRecording(fileOf(bagOf(messages, {compression, 50, index})));
      ASSERT_EQ(bag.observations.size(), messages.size()) << compression << ' ' << index;
      EXPECT_TRUE(bag.problems.empty()) << bag.problems.front().message;
      for (std::size_t i = 0; i < messages.size(); ++i)
      {
        EXPECT_EQ(bag.observations[i]->sensorLabel, messages[i].topic);
        EXPECT_EQ(toNanoseconds(bag.observations[i]->timestamp), messages[i].stamp_ns);
      }
    }
}

TEST_F(BagFileTest, TopicsTellWhatIsTakenAndWhatIsNot)
{
  auto messages = smallRecording(Wire::Ros1, 2);
  messages.push_back({"/camera", "sensor_msgs/Image", kStart, std::string(5000, 'x')});
  const Recorded bag = readRecording(fileOf(bagOf(messages)));
  ASSERT_EQ(bag.topics.size(), 3U);
  EXPECT_EQ(bag.topic("/lidar")->messages, 2U);
  EXPECT_EQ(bag.topic("/lidar")->taken, 2U);
  EXPECT_EQ(bag.topic("/camera")->messages, 1U);
  EXPECT_EQ(bag.topic("/camera")->taken, 0U);
  EXPECT_TRUE(contains(bag.topic("/camera")->reason, "not read"));
  EXPECT_TRUE(contains(bag.topic("/imu")->reason, "IMU"));
}

TEST_F(BagFileTest, PosesOfSensorsComeFromTheTransforms)
{
  Pose T_base_lidar, T_base_imu;
  T_base_lidar.p = Vec3(0.5, 0.0, 1.5);
  T_base_imu.p = Vec3(0.1, 0.2, 0.3);
  T_base_imu.R = expSO3(Vec3(0, 0, 0.5));
  auto messages = smallRecording(Wire::Ros1, 2);
  const auto transform = [](const char* child, const Pose& T)
  {
    return TopicMessage{
        "/tf_static", "tf2_msgs/TFMessage", kStart,
        transformMessage(Wire::Ros1, "base_link", child, T)};
  };
  messages.insert(
      messages.begin() + 7, {transform("/lidar", T_base_lidar), transform("imu", T_base_imu)});
  const Recorded bag = readRecording(fileOf(bagOf(messages)));
  for (const auto& observation : bag.observations)
  {
    mrpt::poses::CPose3D pose;
    observation->getSensorPose(pose);
    const Pose& truth = observation->sensorLabel == "/lidar" ? T_base_lidar : T_base_imu;
    EXPECT_LT((toPose(pose).p - truth.p).norm(), 1e-12);
    EXPECT_LT((toPose(pose).R - truth.R).norm(), 1e-12);
  }
  ASSERT_EQ(bag.notes.size(), 2U);
  EXPECT_TRUE(contains(bag.notes[1], "base_link")) << bag.notes[1];
}

TEST_F(BagFileTest, LidarAndImuDecideOnTheFrameOfTheVehicle)
{
  Pose T_base_lidar;
  T_base_lidar.p = Vec3(0.5, 0.0, 1.5);
  WireWriter fix(Wire::Ros1);
  fix.header(kStart, "gps").number(std::int8_t{0}).number(std::uint16_t{1});
  fix.numbers({36.5, -4.25, 100.0}).numbers(std::vector<double>(9, 0.0)).number(std::uint8_t{0});
  const TopicMessage gps{"/fix", "sensor_msgs/NavSatFix", kStart, fix.bytes()};
  const TopicMessage camera{
      "/camera", "sensor_msgs/Imu", kStart,
      imuMessage(Wire::Ros1, kStart, Vec3(0, 0, 0), Vec3(0, 0, 9.8), "camera_imu")};
  // A frame with a usual name goes before the tree of the first IMU; without one a GNSS has no say.
  for (const auto& [first, vehicle] : {std::pair{camera, "base_link"}, {gps, "rig"}})
  {
    auto messages = smallRecording(Wire::Ros1, 2);
    messages.insert(
        messages.begin(),
        {first, fixedIn("camera_link", "camera_imu", Pose{}), fixedIn("mast", "gps", Pose{}),
         fixedIn(vehicle, "lidar", T_base_lidar), fixedIn(vehicle, "imu", Pose{})});
    const Recorded bag = readRecording(fileOf(bagOf(messages)));
    ASSERT_EQ(bag.count("/lidar"), 2U);
    for (const auto& observation : bag.observations)
    {
      mrpt::poses::CPose3D pose;
      observation->getSensorPose(pose);
      const double z = observation->sensorLabel == "/lidar" ? 1.5 : 0.0;
      EXPECT_NEAR(pose.z(), z, 1e-12) << observation->sensorLabel << " in " << vehicle;
    }
  }
}

TEST_F(BagFileTest, ACutBagGivesAllThatIsBeforeTheCut)
{
  const auto messages = smallRecording(Wire::Ros1);
  for (const char* compression : {"none", "bz2", "lz4"})
  {
    const std::string whole = bagOf(messages, {compression, 20, false});
    std::size_t before = 0;
    for (std::size_t size = 5000; size < whole.size(); size += 997)
    {
      const Recorded bag = readRecording(fileOf(whole.substr(0, size)));
      EXPECT_GE(bag.observations.size(), before) << size;
      before = bag.observations.size();
      if (bag.problems.empty()) continue;  // cut between two chunks
      EXPECT_EQ(bag.problems[0].kind, ReadProblemKind::Truncated) << bag.problems[0].message;
      EXPECT_EQ(bag.problems.size(), 1U);
    }
    EXPECT_GT(before, messages.size() / 2) << compression;
  }
}

TEST_F(BagFileTest, ADamagedChunkCostsItsOwnMessagesOnly)
{
  const auto messages = smallRecording(Wire::Ros1);
  for (const char* compression : {"bz2", "lz4"})
  {
    std::string bytes = bagOf(messages, {compression, 20, true});
    for (std::size_t at = 4400; at < 4500; ++at)
      bytes[at] = static_cast<char>(~bytes[at]);
    const Recorded bag = readRecording(fileOf(bytes));
    EXPECT_GE(bag.observations.size(), messages.size() - 60) << compression;
    EXPECT_LT(bag.observations.size(), messages.size()) << compression;
    ASSERT_FALSE(bag.problems.empty());
    EXPECT_EQ(bag.problems[0].kind, ReadProblemKind::Corrupt) << bag.problems[0].message;
  }
}

TEST_F(BagFileTest, ReadingGoesOnAtTheNextChunkBehindGarbage)
{
  const auto messages = smallRecording(Wire::Ros1);
  const std::string bytes = bagOf(messages, {"none", 20, false});
  const std::size_t second = bytes.find("compression=none", bytes.find("compression=none") + 1);
  const std::string broken =
      bytes.substr(0, second - 8) + std::string(100'000, '\x55') + bytes.substr(second - 8);
  const Recorded bag = readRecording(fileOf(broken));
  EXPECT_EQ(bag.observations.size(), messages.size());
  ASSERT_EQ(bag.problems.size(), 1U);
  EXPECT_EQ(bag.problems[0].kind, ReadProblemKind::Corrupt) << bag.problems[0].message;
}

TEST_F(BagFileTest, AnUnknownCompressionIsNamedAndTheRestIsRead)
{
  const auto messages = smallRecording(Wire::Ros1);
  std::string bytes = bagOf(messages, {"none", 20, true});
  const std::string name = "compression=none";
  bytes.replace(bytes.find(name), name.size(), "compression=zpaq");
  const std::string message = expectAChunkIsLeftOut(bytes, messages.size() - 20);
  EXPECT_TRUE(contains(message, "zpaq")) << message;
}

TEST_F(BagFileTest, AChunkWithoutACompressionIsNotLostInSilence)
{
  const auto messages = smallRecording(Wire::Ros1);
  std::string bytes = bagOf(messages, {"none", 20, true});
  bytes.replace(bytes.find("compression=none"), 4, "comb");
  expectAChunkIsLeftOut(bytes, messages.size() - 20);
}

TEST_F(BagFileTest, MessagesWhoseConnectionIsLostAreNotLostInSilence)
{
  std::string bytes = bagOf(smallRecording(Wire::Ros1), {"none", 20, false});
  const std::string name = "compression=none";
  bytes.replace(bytes.find(name), name.size(), "compression=zpaq");
  const Recorded bag = readRecording(fileOf(bytes));
  EXPECT_TRUE(bag.observations.empty());
  ASSERT_EQ(bag.problems.size(), 3U);  // the chunk, and each of two connections
  EXPECT_TRUE(contains(bag.problems[1].message, "connection")) << bag.problems[1].message;
}

TEST_F(BagFileTest, AMessageOfAnotherTypeThanItSaysIsCountedAsAProblem)
{
  auto messages = smallRecording(Wire::Ros1, 2);
  messages.push_back({"/wrong", "sensor_msgs/Imu", kStart, "not an IMU"});
  const Recorded bag = readRecording(fileOf(bagOf(messages)));
  EXPECT_EQ(bag.observations.size(), messages.size() - 1);
  ASSERT_EQ(bag.problems.size(), 1U);
  EXPECT_TRUE(contains(bag.problems[0].message, "/wrong")) << bag.problems[0].message;
}

TEST_F(BagFileTest, OtherVersionsAreRefusedByName)
{
  const std::string file = fileOf("#ROSBAG V1.2\nwhatever");
  const std::string refusal = failureOf([&] { (void)recordingFormatOf(file)->open(file); });
  EXPECT_TRUE(contains(refusal, "V1.2")) << refusal;
}

TEST_F(BagFileTest, NoDamageThrowsOrRunsAway)
{
  const std::string whole = bagOf(smallRecording(Wire::Ros1, 2), {"lz4", 20, true});
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i)
  {
    std::string wrong = whole;
    for (int k = 0; k < 5; ++k)
      wrong[13 + random() % (wrong.size() - 13)] = static_cast<char>(random());
    (void)readRecording(fileOf(wrong));
  }
}
}  // namespace
