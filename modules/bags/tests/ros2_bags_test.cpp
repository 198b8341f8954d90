// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// MCAP, SQLite, folders.

#include "recording_test_support.h"
#include "ros2_writers.h"

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

class RosTwoBags : public RecordingTest
{
 protected:
  static void expectAll(const Recorded& bag, const std::vector<TopicMessage>& messages)
  {
    EXPECT_TRUE(bag.problems.empty()) << bag.problems.front().message;
    ASSERT_EQ(bag.observations.size(), messages.size());
    for (std::size_t i = 0; i < messages.size(); ++i)
    {
      EXPECT_EQ(bag.observations[i]->sensorLabel, messages[i].topic);
      EXPECT_EQ(toNanoseconds(bag.observations[i]->timestamp), messages[i].stamp_ns);
    }
  }

  std::string db3Of(const std::vector<TopicMessage>& messages, const std::string& name = "bag.db3")
  {
    writeDb3(folder_.file(name), messages);
    return folder_.file(name);
  }
};

TEST_F(RosTwoBags, McapIsReadInEveryFormAndEncoding)
{
  for (const Wire wire : {Wire::Cdr, Wire::CdrBigEndian})
    for (const char* compression : {"none", "lz4", "zstd"})
      for (const std::size_t chunk : {0U, 30U})
        for (const bool summary : {true, false})
        {
          const auto messages = smallRecording(wire, 3);
          expectAll(
              readRecording(fileOf(mcapOf(messages, {compression, chunk, summary}))), messages);
        }
  const auto ros1 = smallRecording(Wire::Ros1, 3);
  expectAll(readRecording(fileOf(mcapOf(ros1, {}, "ros1"))), ros1);
}

TEST_F(RosTwoBags, McapOfAnotherEncodingIsNamed)
{
  const Recorded bag = readRecording(fileOf(mcapOf(smallRecording(Wire::Cdr, 2), {}, "protobuf")));
  EXPECT_TRUE(bag.observations.empty());
  ASSERT_EQ(bag.problems.size(), 2U);  // once for each topic
  EXPECT_EQ(bag.problems[0].kind, ReadProblemKind::NotSupported);
  EXPECT_TRUE(contains(bag.problems[0].message, "protobuf")) << bag.problems[0].message;
}

TEST_F(RosTwoBags, ACutMcapGivesAllThatIsBeforeTheCut)
{
  const auto messages = smallRecording(Wire::Cdr);
  for (const char* compression : {"none", "lz4", "zstd"})
    for (const std::size_t chunk : {0U, 20U})
    {
      const std::string whole = mcapOf(messages, {compression, chunk, true});
      constexpr std::size_t kBehindData = 60;  // without a summary
      const std::size_t data = mcapOf(messages, {compression, chunk, false}).size() - kBehindData;
      std::size_t before = 0;
      for (std::size_t size = 100; size < data; size += 1009)
      {
        const Recorded bag = readRecording(fileOf(whole.substr(0, size)));
        EXPECT_GE(bag.observations.size(), before);
        before = bag.observations.size();
        ASSERT_EQ(bag.problems.size(), 1U) << compression << ' ' << chunk << ' ' << size;
        EXPECT_EQ(bag.problems[0].kind, ReadProblemKind::Truncated) << bag.problems[0].message;
      }
      EXPECT_GT(before, messages.size() / 2);
    }
}

TEST_F(RosTwoBags, DamageInAChunkOfMcapIsReportedAndCostsThisChunkOnly)
{
  const auto messages = smallRecording(Wire::Cdr);
  for (const char* compression : {"none", "lz4", "zstd"})
  {
    std::string bytes = mcapOf(messages, {compression, 20, true});
    for (std::size_t at = 700; at < 720; ++at)
      bytes[at] = static_cast<char>(~bytes[at]);
    const Recorded bag = readRecording(fileOf(bytes));
    EXPECT_GE(bag.observations.size(), messages.size() - 20) << compression;
    ASSERT_FALSE(bag.problems.empty()) << compression;
    EXPECT_EQ(bag.problems.back().kind, ReadProblemKind::Corrupt) << bag.problems.back().message;
  }
}

TEST_F(RosTwoBags, McapGoesOnAtTheNextChunkBehindGarbage)
{
  const auto messages = smallRecording(Wire::Cdr);
  const std::string attachment_of_a_wrong_length =
      WireWriter(Wire::Ros1).number(std::uint8_t{9}).number(std::uint64_t{1} << 40U).bytes();
  for (const std::string& garbage : {std::string(100'000, '\x55'), attachment_of_a_wrong_length})
    for (const char* compression : {"lz4", "zstd"})
    {
      std::string bytes = mcapOf(messages, {compression, 20, true});
      const std::size_t second = bytes.find(compression, bytes.find(compression) + 1) - 41;
      bytes.insert(second, garbage);
      const Recorded bag = readRecording(fileOf(bytes));
      EXPECT_EQ(bag.observations.size(), messages.size()) << compression;
      ASSERT_EQ(bag.problems.size(), 1U);
      EXPECT_EQ(bag.problems[0].kind, ReadProblemKind::Corrupt) << bag.problems[0].message;
    }
}

TEST_F(RosTwoBags, SearchesBehindDamageAreBounded)
{
  // Heads of chunks that give their length right, hold nothing, and are followed by garbage.
  const std::string chunk = WireWriter(Wire::Ros1)
                                .number(std::uint8_t{6})
                                .number(std::uint64_t{28 + 7 + 8 + 1})
                                .raw(std::string(28, '\0'))
                                .text("lz4")
                                .number(std::uint64_t{1})
                                .raw(std::string(30, '\x55'))
                                .bytes();
  std::string bytes = mcapOf({}, {"none", 0, false}).substr(0, 30);
  const std::size_t head = bytes.size();
  for (int i = 0; i < 30'000; ++i)
    bytes += chunk;
  const std::string file = fileOf(bytes + std::string(100, '\x55'));
  const auto reader = recordingFormatOf(file)->open(file);
  std::size_t problems = 0;
  while (!std::holds_alternative<EndOfRecording>(reader->next()))
    ++problems;
  EXPECT_GT(problems, 10'000U) << head;
  EXPECT_LT(problems, 25'000U);
}

TEST_F(RosTwoBags, AnUnknownCompressionOfMcapIsNamed)
{
  const auto messages = smallRecording(Wire::Cdr);
  std::string bytes = mcapOf(messages, {"zstd", 20, true});
  bytes.replace(bytes.find("zstd"), 4, "xyzw");
  const std::string message = expectAChunkIsLeftOut(bytes, messages.size() - 20);
  EXPECT_TRUE(contains(message, "xyzw")) << message;
}

TEST_F(RosTwoBags, SqliteIsRead)
{
  for (const Wire wire : {Wire::Cdr, Wire::CdrBigEndian})
  {
    const auto messages = smallRecording(wire);
    expectAll(readRecording(db3Of(messages)), messages);
  }
}

TEST_F(RosTwoBags, ADatabaseOfSomethingElseIsRefused)
{
  const std::string file = db3Of(smallRecording(Wire::Cdr, 1));
  std::string bytes = contentOfFile(file);
  for (auto at = bytes.find("messages"); at != std::string::npos; at = bytes.find("messages", at))
    bytes.replace(at, 8, "massages");
  write(file, bytes);
  EXPECT_THROW((void)readRecording(file), std::runtime_error);
}

TEST_F(RosTwoBags, ACutDatabaseGivesWhatIsLeft)
{
  const auto messages = smallRecording(Wire::Cdr, 20);
  const std::string whole = contentOfFile(db3Of(messages));
  const Recorded bag = readRecording(fileOf(whole.substr(0, whole.size() / 2), "cut.db3"));
  EXPECT_GT(bag.observations.size(), messages.size() / 5);
  EXPECT_LT(bag.observations.size(), messages.size());
  ASSERT_FALSE(bag.problems.empty());
  EXPECT_EQ(bag.problems.back().kind, ReadProblemKind::Truncated) << bag.problems.back().message;
}

TEST_F(RosTwoBags, ADamagedPageOfADatabaseCostsItsRowsOnly)
{
  const auto messages = smallRecording(Wire::Cdr, 20);
  std::string bytes = contentOfFile(db3Of(messages));
  for (std::size_t at = bytes.size() / 2; at < bytes.size() / 2 + 4096; ++at)
    bytes[at] = '\x7F';
  const Recorded bag = readRecording(fileOf(bytes, "damaged.db3"));
  EXPECT_GT(bag.observations.size(), messages.size() * 3 / 4);
  EXPECT_FALSE(bag.problems.empty());
}

TEST_F(RosTwoBags, PagesThatLeadInCirclesEnd)
{
  // Every pointer to a page leads to one of the first pages.
  const std::string whole = contentOfFile(db3Of(smallRecording(Wire::Cdr, 20)));
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i)
  {
    std::string wrong = whole;
    for (std::size_t page = 4096; page < wrong.size(); page += 4096)
      if (random() % 4 == 0) wrong.replace(page, 4096, whole, random() % 6 * 4096, 4096);
    try
    {
      (void)readRecording(fileOf(wrong, "circles.db3"));
    }
    catch (const std::runtime_error&)
    {
      continue;  // refused when it is opened
    }
  }
}

TEST_F(RosTwoBags, AFolderIsReadInTheOrderOfItsNumbersAlsoCompressed)
{
  const auto messages = smallRecording(Wire::Cdr, 12);
  const std::size_t third = messages.size() / 3;
  const auto part = [&](std::size_t i)
  {
    const auto begin = messages.begin() + static_cast<std::ptrdiff_t>(i * third);
    return std::vector<TopicMessage>(
        begin, i == 2 ? messages.end() : begin + static_cast<std::ptrdiff_t>(third));
  };
  const std::string name = folder_.file("walk");
  std::filesystem::create_directory(name);
  writeDb3(name + "/walk_2.db3", part(0));
  write(name + "/walk_9.mcap", mcapOf(part(1)));
  writeDb3(folder_.file("last.db3"), part(2));
  write(name + "/walk_10.db3.zstd", zstd(contentOfFile(folder_.file("last.db3"))));
  write(name + "/metadata.yaml", "rosbag2_bagfile_information:\n  version: 5\n");
  expectAll(readRecording(name), messages);
  expectAll(readRecording(name + "/walk_10.db3.zstd"), part(2));
  EXPECT_EQ(recordingFormatOf(folder_.path())->name, std::string("rosbag2"));
}

TEST_F(RosTwoBags, AFileThatInflatesWithoutEndIsRefused)
{
  const std::string bomb = zstd(mcapOf({}) + std::string(std::size_t{300} << 20U, '\0'));
  ASSERT_LT(bomb.size(), std::size_t{1} << 20U);
  const Recorded bag = readRecording(fileOf(bomb, "bomb.mcap.zstd"));
  EXPECT_TRUE(bag.observations.empty());
  ASSERT_EQ(bag.problems.size(), 1U);
  EXPECT_TRUE(contains(bag.problems[0].message, "50 times")) << bag.problems[0].message;
}

TEST_F(RosTwoBags, MessagesCompressedOneByOneAreRead)
{
  auto packed = smallRecording(Wire::Cdr, 3);
  const auto messages = packed;
  for (TopicMessage& message : packed)
    message.data = zstd(message.data);
  expectAll(readRecording(db3Of(packed)), messages);
  packed[5].data.resize(packed[5].data.size() - 6);
  const Recorded cut = readRecording(db3Of(packed));
  EXPECT_EQ(cut.observations.size(), messages.size() - 1);
  EXPECT_EQ(cut.problems.size(), 1U);
}

TEST_F(RosTwoBags, NoDamageThrowsOrRunsAway)
{
  const auto messages = smallRecording(Wire::Cdr, 2);
  const std::string database = contentOfFile(db3Of(messages));
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i)
  {
    std::string wrong = i % 2 == 0 ? mcapOf(messages, {"zstd", 10, true}) : database;
    for (int k = 0; k < 5; ++k)
      wrong[16 + random() % (wrong.size() - 16)] = static_cast<char>(random());
    const std::string file = fileOf(wrong);
    try
    {
      (void)readRecording(file);
    }
    catch (const std::runtime_error&)
    {
      EXPECT_EQ(i % 2, 1);  // a database whose tables are gone is refused when it is opened
    }
  }
}
}  // namespace
