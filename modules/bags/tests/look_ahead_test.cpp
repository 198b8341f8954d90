// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// How much of a recording is read before its first observation.

#include "look_ahead.h"

#include "mcap_file.h"
#include "recording_test_support.h"
#include "ros2_writers.h"

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

/** Gives messages, and counts them. */
class CountedMessages : public RosMessageSource
{
 public:
  CountedMessages(const std::vector<TopicMessage>& messages, bool lists_all)
      : messages_(messages), lists_all_(lists_all)
  {
    for (const TopicMessage& message : messages)
      topics_[message.topic] = {message.topic, message.type, WireFormat::Ros1, ""};
  }

  [[nodiscard]] NextMessage next(const TopicFilter& wanted) override
  {
    if (given == messages_.size()) return EndOfRecording{};
    const TopicMessage& message = messages_[given++];
    const RosTopic& topic = topics_.at(message.topic);
    data_.assign(message.data.begin(), message.data.end());
    return RosMessage{&topic, wanted(topic) ? &data_ : nullptr, given};
  }
  [[nodiscard]] std::uint64_t position() const override { return given; }
  [[nodiscard]] std::vector<const RosTopic*> topics() const override
  {
    std::vector<const RosTopic*> all;
    for (const auto& [name, topic] : topics_)
      all.push_back(&topic);
    return all;
  }
  [[nodiscard]] bool listsAllTopics() const override { return lists_all_; }

  std::size_t given = 0;

 private:
  std::vector<TopicMessage> messages_;
  std::map<std::string, RosTopic> topics_;
  Bytes data_;
  bool lists_all_;
};

TopicMessage transform(const std::string& topic, const char* parent, const char* child)
{
  return {topic, "tf2_msgs/TFMessage", kStart, transformMessage(Wire::Ros1, parent, child, Pose{})};
}

/** Messages that are read of a recording that begins with these. */
std::size_t readOf(std::vector<TopicMessage> first, bool lists_all = true)
{
  const auto rest = smallRecording(Wire::Ros1, 20);
  first.insert(first.end(), rest.begin(), rest.end());
  CountedMessages messages(first, lists_all);
  TransformTree transforms;
  OusterTopics ouster;
  LookAhead(transforms, ouster).lookThrough(messages);
  return messages.given == first.size() ? 0 : messages.given;
}

TEST(LookAhead, EndsWhereEverySensorIsFixedToTheVehicle)
{
  const TopicMessage lidar = transform("/tf_static", "base_link", "lidar");
  const TopicMessage imu = transform("/tf_static", "base_link", "imu");
  const std::size_t read = readOf({lidar, imu});
  EXPECT_GT(read, 2U);
  EXPECT_LT(read, 10U);
  EXPECT_LT(readOf({lidar, transform("/tf_static", "lidar", "imu")}), 10U);

  constexpr std::size_t kAll = 0;
  EXPECT_EQ(readOf({lidar, imu}, false), kAll);  // another sensor may come
  EXPECT_EQ(readOf({lidar}), kAll);
  EXPECT_EQ(readOf({lidar, transform("/tf", "base_link", "imu")}), kAll);  // it may move yet
  EXPECT_EQ(readOf({lidar, transform("/tf_static", "world", "imu")}), kAll);
}

TEST(LookAhead, ReadsNothingWhereNothingCanBeFound)
{
  CountedMessages messages(smallRecording(Wire::Ros1, 20), true);
  TransformTree transforms;
  OusterTopics ouster;
  LookAhead(transforms, ouster).lookThrough(messages);
  EXPECT_EQ(messages.given, 0U);
}

class McapLookAhead : public RecordingTest
{
 protected:
  /** Messages that are given when only transforms are wanted; the first of them is in the last
   * chunk. */
  std::size_t givenOf(std::string bytes)
  {
    McapFile file(fileOf(bytes));
    file.leaveOutUnwanted();
    std::size_t given = 0;
    bool found = false;
    const TopicFilter transforms = [](const RosTopic& topic) { return topic.name == "/tf_static"; };
    for (;; ++given)
    {
      const NextMessage next = file.next(transforms);
      EXPECT_FALSE(std::holds_alternative<ReadProblem>(next));
      const auto* message = std::get_if<RosMessage>(&next);
      if (message == nullptr) break;
      found = found || message->data != nullptr;
    }
    EXPECT_TRUE(found);
    return given;
  }
};

TEST_F(McapLookAhead, InflatesOnlyChunksThatHoldWhatIsWanted)
{
  auto messages = smallRecording(Wire::Cdr, 20);
  constexpr std::size_t kChunk = 10;
  messages.resize(messages.size() / kChunk * kChunk);
  const std::size_t others = messages.size();
  messages.push_back(
      {"/tf_static", "tf2_msgs/TFMessage", kStart,
       transformMessage(Wire::Cdr, "base_link", "lidar", Pose{})});
  EXPECT_EQ(givenOf(mcapOf(messages, {"zstd", kChunk, true})), 1U);
  EXPECT_EQ(givenOf(mcapOf(messages, {"zstd", kChunk, false})), others + 1);
  EXPECT_EQ(givenOf(mcapOf(messages, {"zstd", 0, true})), others + 1);

  // They are read where everything is wanted, and the poses are found.
  const Recorded all = readRecording(fileOf(mcapOf(messages, {"zstd", kChunk, true})));
  EXPECT_EQ(all.observations.size(), others);
  EXPECT_TRUE(contains(all.notes.back(), "base_link")) << all.notes.back();
}

TEST(McapChunks, BelieveNoDamagedRecord)
{
  McapChunks chunks;
  const auto none = [](std::uint16_t) { return false; };
  for (std::size_t size = 0; size < 60; ++size)
    chunks.add(Bytes(size, 0xFF));
  WireWriter record(Wire::Ros1);
  record.number(std::uint64_t{0}).number(std::uint64_t{0}).number(std::uint64_t{77});
  record.number(std::uint64_t{10}).number(std::uint32_t{10});
  std::string bytes = record.bytes();
  chunks.add(Bytes(bytes.begin(), bytes.end()));  // ends ahead of its channel
  EXPECT_FALSE(chunks.holdsNone(77, none));
  bytes += record.number(std::uint16_t{3}).number(std::uint64_t{1}).bytes().substr(bytes.size());
  chunks.add(Bytes(bytes.begin(), bytes.end()));
  EXPECT_TRUE(chunks.holdsNone(77, none));
  EXPECT_FALSE(chunks.holdsNone(77, [](std::uint16_t channel) { return channel == 3; }));
  EXPECT_FALSE(chunks.holdsNone(78, none));
}
}  // namespace
