// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bridge_recording.h"
#include "failure_message.h"
#include <fastlio/math/time.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/survey/recording_parts.h>

#include <stdexcept>
#include <sys/stat.h>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;
using Files = std::vector<std::string>;

class RecordingPartsTest : public BridgeTest
{
 protected:
  /** Inertial samples at 200 Hz and clouds at 10 Hz, from so many seconds on. */
  std::string fileFrom(
      double start, double seconds, const std::string& name, const std::string& lidar = "lidar")
  {
    std::vector<Object> objects = recording(static_cast<int>(10 * seconds));
    for (auto& object : objects)
    {
      auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object);
      observation->timestamp =
          toMrptTime(toNanoseconds(start) + toNanoseconds(observation->timestamp));
      if (observation->sensorLabel == "lidar") observation->sensorLabel = lidar;
    }
    const std::string file = folder_.file(name);
    write(file, gzip(serialize(objects)));
    return file;
  }

  static std::vector<Files> joined(const Files& files)
  {
    std::vector<Files> all;
    for (const RecordingParts& recording : partsOf(files, Joining::ByStamps))
      all.push_back(recording.files);
    return all;
  }
};
}  // namespace

TEST_F(RecordingPartsTest, FilesThatFollowEachOtherAreOneInTheOrderOfTime)
{
  const std::string a = fileFrom(0, 3, "a"), b = fileFrom(3, 3, "b"), c = fileFrom(6, 3, "c");
  EXPECT_EQ(joined({a, b, c}), (std::vector<Files>{{a, b, c}}));
  EXPECT_EQ(joined({c, a, b}), (std::vector<Files>{{a, b, c}}));
  EXPECT_EQ(joined({a}), (std::vector<Files>{{a}}));
  const auto one = partsOf({c, b, a}, Joining::ByStamps).front();
  ASSERT_EQ(one.pauses.size(), 2U);
  for (const double pause : one.pauses)
    EXPECT_NEAR(pause, 0.0, 0.11);
  EXPECT_NE(describe(one).find(b), std::string::npos);
  EXPECT_EQ(describe(RecordingParts{{a}}), "");
}

TEST_F(RecordingPartsTest, OthersStayAlone)
{
  const std::string a = fileFrom(0, 3, "a");
  EXPECT_EQ(joined({a, a}), (std::vector<Files>{{a}, {a}})) << "the same file twice";
  for (const double start : {0.0, 0.5, 2.2, 4.5, 100.0, 1e6})
  {
    const std::string b = fileFrom(start, 3, "b");
    EXPECT_EQ(joined({a, b}), (std::vector<Files>{{a}, {b}})) << "from " << start << " s on";
  }
  const std::string other = fileFrom(3, 3, "other", "roof");
  EXPECT_EQ(joined({a, other}), (std::vector<Files>{{a}, {other}})) << "another sensor";
}

TEST_F(RecordingPartsTest, TwoRecordingsInPartsAreTwo)
{
  const std::string a1 = fileFrom(0, 3, "a1"), a2 = fileFrom(3, 3, "a2");
  const std::string b1 = fileFrom(50, 3, "b1"), b2 = fileFrom(53, 3, "b2");
  EXPECT_EQ(joined({b1, a1, b2, a2}), (std::vector<Files>{{b1, b2}, {a1, a2}}));
}

TEST_F(RecordingPartsTest, PartsInOrderOfTimeMayBeJoinedAlways)
{
  const std::string a = fileFrom(0, 3, "a"), b = fileFrom(3, 3, "b"), c = fileFrom(60, 3, "c");
  const auto one = partsOf({a, b, c}, Joining::Always);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one.front().files, (Files{a, b, c}));
  EXPECT_EQ(partsOf({a, b, c}, Joining::ByStamps).size(), 2U);
  EXPECT_EQ(partsOf({a, b, c}, Joining::Never).size(), 3U);
  EXPECT_NO_THROW(requireInOrder({a, folder_.file("missing"), c}));
  EXPECT_NO_THROW(requireInOrder({a, fileFrom(2.9, 3, "cut")})) << "cut by bytes";
}

TEST_F(RecordingPartsTest, PartsThatOverlapOrGoBackAreRefused)
{
  const std::string a = fileFrom(0, 3, "a"), b = fileFrom(2, 3, "b"), c = fileFrom(6, 3, "c");
  const auto refusalOf = [](const Files& files)
  { return failureOf<std::invalid_argument>([&] { requireInOrder(files); }); };
  const std::string overlap = refusalOf({a, b, c});
  EXPECT_NE(overlap.find("'" + a + "' and '" + b + "' overlap by 0.9"), std::string::npos)
      << overlap;
  const std::string back = refusalOf({c, a});
  EXPECT_NE(back.find("'" + a + "' begins 6.000 s before '" + c + "'"), std::string::npos) << back;
}

TEST_F(RecordingPartsTest, WhatCannotBeReadStaysAlone)
{
  const std::string a = fileFrom(0, 3, "a"), b = fileFrom(3, 3, "b");
  const std::string missing = folder_.file("missing"), rubbish = folder_.file("rubbish");
  write(rubbish, "no recording");
  const std::string pipe = folder_.file("pipe");  // opening it would wait for a writer
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(
      joined({missing, b, rubbish, pipe, a}),
      (std::vector<Files>{{missing}, {rubbish}, {pipe}, {a, b}}));
}

TEST_F(RecordingPartsTest, AStampOfAnotherCenturyLeavesNoNumberOutOfRange)
{
  std::vector<Object> objects = recording(30);
  std::dynamic_pointer_cast<mrpt::obs::CObservation>(objects[3])->timestamp =
      toMrptTime(kLatestStamp - 1);
  const std::string wild = folder_.file("wild"), next = fileFrom(3, 3, "next");
  write(wild, gzip(serialize(objects)));
  EXPECT_NO_THROW((void)joined({wild, next}));
}
