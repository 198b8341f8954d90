// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What a map gets from a recording beside LiDAR and IMU.

#include "bag_writers.h"
#include "bridge_recording.h"
#include "rawlog_reading.h"
#include "test_files.h"
#include <fastlio/mapping/aids.h>
#include <fastlio/rawlog/rawlog_source.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
namespace
{
using testing::TopicMessage;
using testing::Wire;

class AidsOfARecording : public ::testing::Test
{
 protected:
  /** Fixes of GNSS beside clouds and inertial samples. \param covariances of one fix each */
  std::string bagWith(const std::vector<std::vector<double>>& covariances, std::uint8_t type)
  {
    std::vector<TopicMessage> messages = messagesOf(testing::recording(30), Wire::Ros1);
    for (const std::vector<double>& covariance : covariances)
    {
      const std::int64_t stamp_ns = messages.back().stamp_ns;
      messages.push_back(
          {"/fix", "sensor_msgs/NavSatFix", stamp_ns,
           testing::navSatFixMessage(Wire::Ros1, stamp_ns, covariance, type)});
    }
    testing::write(folder_.file("in.bag"), testing::bagOf(messages));
    return folder_.file("in.bag");
  }

  std::string rawlogOf(const std::string& recording)
  {
    std::vector<testing::Object> objects;
    RawlogSource source({recording});
    while (auto observation = source.next())
      objects.push_back(std::move(observation));
    testing::write(folder_.file("out.rawlog"), testing::serialize(objects));
    return folder_.file("out.rawlog");
  }

  static std::vector<GnssFix> fixesOf(const std::string& recording)
  {
    std::vector<std::string> problems;
    const auto is_given = [](std::string_view) { return false; };
    const Session session("walk", {recording}, Config{}, is_given);
    auto aids = readAids(session, problems);
    EXPECT_TRUE(problems.empty()) << problems.front();
    return aids.fixes;
  }

  testing::TemporaryFolder folder_;
};
}  // namespace

TEST_F(AidsOfARecording, AFixIsAsAccurateAsItsReceiverStates)
{
  const std::string bag = bagWith({{0.5, 0, 0, 0, 1.5, 0, 0, 0, 9.0}}, 2);
  for (const std::string& recording : {bag, rawlogOf(bag)})
  {
    const std::vector<GnssFix> fixes = fixesOf(recording);
    ASSERT_EQ(fixes.size(), 1U) << recording;
    EXPECT_NEAR(fixes[0].horizontal_std, 1.0, 1e-6) << recording;
    EXPECT_NEAR(fixes[0].vertical_std, 3.0, 1e-6) << recording;
    ASSERT_TRUE(fixes[0].usual) << recording;
    EXPECT_EQ(fixes[0].usual->horizontal, 2.0);
    EXPECT_EQ(fixes[0].usual->vertical, 4.0);
  }
}

TEST_F(AidsOfARecording, TheQualityTellsTheAccuracyWhereNothingIsStated)
{
  const std::vector<double> covariance{0.5, 0, 0, 0, 1.5, 0, 0, 0, 9.0}, zeros(9, 0.0);
  for (const auto& [stated, type] : {std::pair{covariance, 0}, {zeros, 2}})
  {
    const auto fixes = fixesOf(bagWith({stated}, static_cast<std::uint8_t>(type)));
    ASSERT_EQ(fixes.size(), 1U);
    EXPECT_EQ(fixes[0].horizontal_std, 2.0);
    EXPECT_EQ(fixes[0].vertical_std, 4.0);
    EXPECT_FALSE(fixes[0].usual);
  }
}

TEST_F(AidsOfARecording, NoReceiverKnowsMicrometres)
{
  const auto fixes = fixesOf(bagWith({{1e-12, 0, 0, 0, 1e-12, 0, 0, 0, 1e-12}}, 3));
  ASSERT_EQ(fixes.size(), 1U);
  EXPECT_GE(fixes[0].horizontal_std, 0.005);
  EXPECT_GE(fixes[0].vertical_std, 0.01);
}

}  // namespace fastlio
