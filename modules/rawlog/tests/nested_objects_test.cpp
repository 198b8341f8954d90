// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Objects in objects in objects, as no program writes them: MRPT would follow them by recursion.

#include "rawlog_reading.h"
#include <fastlio/compat/register_classes.h>

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/poses/CPosePDFParticles.h>

#include <algorithm>

namespace
{
using namespace fastlio::testing;
using fastlio::ReadProblem;
using fastlio::ReadProblemKind;
using mrpt::obs::CActionRobotMovement2D;

class NestedObjects : public RawlogTest
{
 protected:
  NestedObjects() { fastlio::registerBridgeClasses(); }
};

/** No lengths of it are checked before it is read. */
Object comment()
{
  auto observation = mrpt::obs::CObservationComment::Create();
  observation->timestamp = imuAt(0)->timestamp;
  return observation;
}

/** The beginning of an object that holds so many others, out of the bytes of an empty one. */
std::string beginningOf(const Object& empty, char count)
{
  std::string bytes = serialize({empty});
  bytes.resize(bytes.size() - 5);  // without its count and its end flag
  return bytes + count + std::string(3, '\0');
}

/** Each holds \a first and the next one; the last one is empty. */
std::string nested(const Object& empty, const std::string& first, std::size_t depth)
{
  const std::string beginning = beginningOf(empty, first.empty() ? '\1' : '\2') + first;
  std::string bytes;
  for (std::size_t i = 0; i < depth; ++i)
    bytes += beginning;
  return bytes + serialize({empty}) + std::string(depth, '\x88');
}

TEST_F(NestedObjects, FramesInFramesAreRefused)
{
  for (const std::string& first : {std::string(), serialize({comment()})})
  {
    const std::string frames = nested(mrpt::obs::CSensoryFrame::Create(), first, 30'000);
    const Reading reading = readAll({fileOf(serialize(samples(3)) + frames)});
    EXPECT_GE(reading.seconds.size(), 3U);
    ASSERT_FALSE(reading.problems.empty());
    EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::Corrupt) << reading.problems[0].message;
  }
}

TEST_F(NestedObjects, AFrameInAFrameTakesNoMemoryThatItClaims)
{
  const std::string inner =
      beginningOf(mrpt::obs::CSensoryFrame::Create(), '\1').substr(0, 1 + 24 + 1) +
      std::string("\x00\xE1\xF5\x05", 4);  // 100 million observations: 1.6 GB
  const std::string frame =
      beginningOf(mrpt::obs::CSensoryFrame::Create(), '\2') + serialize({comment()}) + inner;
  const Reading reading = readAll({fileOf(serialize(samples(3)) + frame)});
  ASSERT_FALSE(reading.problems.empty());
  const std::string& message = reading.problems[0].message;
  EXPECT_NE(message.find("it holds an object of class"), std::string::npos) << message;
}

// Of a map of frames and poses, of which there is one without a pose.
TEST_F(NestedObjects, WhatMrptReadsByItselfEndsAtSomeDepth)
{
  const std::string map = beginningOf(mrpt::maps::CSimpleMap::Create(), '\1') + "\x87nullptr\x88" +
                          nested(mrpt::obs::CSensoryFrame::Create(), "", 5000) + '\x88';
  const Reading reading = readAll({fileOf(serialize(samples(3)) + map + serialize(samples(2)))});
  EXPECT_EQ(reading.seconds.size(), 5U);
  EXPECT_TRUE(std::any_of(
      reading.problems.begin(), reading.problems.end(),
      [](const ReadProblem& problem)
      { return problem.message.find("nested too deeply") != std::string::npos; }));
}

// MRPT copies what it took for an action without a look at it.
TEST_F(NestedObjects, ACollectionHoldsActionsOnly)
{
  for (const Object& other : {comment(), Object(mrpt::obs::CActionCollection::Create())})
  {
    const std::string actions =
        beginningOf(mrpt::obs::CActionCollection::Create(), '\1') + serialize({other}) + '\x88';
    const Reading reading =
        readAll({fileOf(serialize(samples(3)) + actions + serialize(samples(2)))});
    EXPECT_GE(reading.seconds.size(), 5U);
    ASSERT_FALSE(reading.problems.empty());
    EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::Corrupt) << reading.problems[0].message;
  }
}

/** With an object where its pose belongs. */
std::string movementWith(const std::string& pose)
{
  auto movement = std::make_shared<CActionRobotMovement2D>();
  const auto gaussian = std::make_shared<mrpt::poses::CPosePDFGaussian>();
  movement->estimationMethod = CActionRobotMovement2D::emScan2DMatching;
  movement->poseChange = mrpt::poses::CPosePDF::Ptr(gaussian);
  std::string bytes = serialize({movement});
  const std::string own = serialize({gaussian});
  return bytes.replace(bytes.find(own), own.size(), pose);
}

// MRPT copies the pose behind the null pointer of a cast.
TEST_F(NestedObjects, AMovementHoldsAPose)
{
  const std::string null = "\x87nullptr\x88";
  const std::string collection = beginningOf(mrpt::obs::CActionCollection::Create(), '\1');
  const std::string map = beginningOf(mrpt::maps::CSimpleMap::Create(), '\1') + null;
  for (const std::string& pose : {null, serialize({comment()}), std::string("no object")})
  {
    std::string old = movementWith(pose);
    old.replace(0, 1, std::string(1, static_cast<char>(old[0] & 0x7F)) + std::string(3, '\0'));
    for (const std::string& object :
         {movementWith(pose), collection + movementWith(pose) + '\x88',
          map + movementWith(pose) + '\x88', map + old + '\x88'})
    {
      const Reading reading =
          readAll({fileOf(serialize(samples(3)) + object + serialize(samples(2)))});
      EXPECT_GE(reading.seconds.size(), 5U);
      ASSERT_FALSE(reading.problems.empty());
      EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::Corrupt);
      EXPECT_NE(reading.problems[0].message.find("movement"), std::string::npos)
          << reading.problems[0].message;
    }
  }
}

// 68 GB for particles of odometry, and of a pose; MRPT draws the former.
TEST_F(NestedObjects, AMovementTakesNoMemoryThatItClaims)
{
  auto odometry = std::make_shared<CActionRobotMovement2D>();
  CActionRobotMovement2D::TMotionModelOptions options;
  options.modelSelection = CActionRobotMovement2D::mmThrun;
  options.thrunModel.nParticlesCount = 54321;
  odometry->computeFromOdometry({1, 2, 0.5}, options);
  std::string drawn = serialize({odometry});
  const std::string many("\xFF\xFF\xFF\x7F", 4);
  drawn.replace(drawn.find(std::string("\x31\xD4\0\0", 4)), 4, many);
  std::string particles = serialize({std::make_shared<mrpt::poses::CPosePDFParticles>(1)});
  const std::size_t version = particles.find("Particles") + std::string("Particles").size();
  particles.replace(version + 1, 4, many);
  for (const std::string& object : {drawn, movementWith(particles)})
  {
    const Reading reading =
        readAll({fileOf(serialize(samples(3)) + object + serialize(samples(2)))});
    EXPECT_EQ(reading.seconds.size(), 5U);
    ASSERT_FALSE(reading.problems.empty());
    EXPECT_NE(reading.problems[0].message.find("claims 2147483647 particles"), std::string::npos)
        << reading.problems[0].message;
  }
}

TEST_F(NestedObjects, MovementsAreReadAsMrptReadsThem)
{
  const std::string pose = serialize({std::make_shared<mrpt::poses::CPosePDFGaussian>()});
  const std::string whole = movementWith(pose);
  auto odometry = std::make_shared<CActionRobotMovement2D>();
  odometry->computeFromOdometry({1, 2, 0.5}, {});
  const std::string actions = beginningOf(mrpt::obs::CActionCollection::Create(), '\2') + whole +
                              serialize({odometry}) + '\x88';
  const Reading reading =
      readAll({fileOf(serialize(samples(3)) + whole + actions + serialize(samples(2)))});
  EXPECT_EQ(reading.seconds.size(), 5U);
  EXPECT_TRUE(reading.problems.empty()) << reading.problems[0].message;
  for (std::size_t size = 1; size < whole.size(); ++size)
  {
    const Reading cut = readAll({fileOf(serialize(samples(3)) + whole.substr(0, size))});
    ASSERT_EQ(cut.problems.size(), 1U) << size;
    EXPECT_EQ(cut.problems[0].kind, ReadProblemKind::Truncated) << cut.problems[0].message;
  }
}

TEST_F(NestedObjects, FramesAreReadAsMrptReadsThem)
{
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(imuAt(0));
  frame->insert(std::dynamic_pointer_cast<mrpt::obs::CObservation>(comment()));
  frame->insert(imuAt(0.01));
  const Reading reading = readAll({fileOf(serialize({frame, imuAt(0.02)}))});
  EXPECT_TRUE(reading.problems.empty());
  EXPECT_EQ(reading.labels, (std::vector<std::string>{"imu", "", "imu", "imu"}));
}
}  // namespace
