// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recording_test_support.h A recording in memory, its messages, and reading them back. */
#pragma once

#include "bag_writers.h"
#include "bridge_recording.h"
#include "test_files.h"
#include <fastlio/math/time.h>
#include <fastlio/rawlog/recording_formats.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** All that a reader delivers. */
struct Recorded
{
  std::vector<mrpt::obs::CObservation::Ptr> observations;
  std::vector<ReadProblem> problems;
  std::vector<TopicReport> topics;
  std::vector<std::string> notes;

  /** Observations with a label. */
  [[nodiscard]] std::size_t count(const std::string& label) const
  {
    std::size_t n = 0;
    for (const auto& observation : observations)
      n += observation->sensorLabel == label ? 1U : 0U;
    return n;
  }
  [[nodiscard]] const TopicReport* topic(const std::string& name) const
  {
    for (const TopicReport& report : topics)
      if (report.name == name) return &report;
    return nullptr;
  }
};

inline Recorded readRecording(const std::string& path)
{
  Recorded recorded;
  const RecordingFormat* format = recordingFormatOf(path);
  if (format == nullptr) throw std::runtime_error("no format recognises " + path);
  const auto reader = format->open(path);
  for (;;)
  {
    NextRecorded next = reader->next();
    if (std::holds_alternative<EndOfRecording>(next)) break;
    if (auto* observation = std::get_if<mrpt::obs::CObservation::Ptr>(&next))
      recorded.observations.push_back(*observation);
    else
      recorded.problems.push_back(std::get<ReadProblem>(next));
  }
  recorded.topics = reader->topics();
  recorded.notes = reader->notes();
  EXPECT_TRUE(std::holds_alternative<EndOfRecording>(reader->next()));
  return recorded;
}

/** Three points with times, lines and brightness. */
inline LidarScan smallScan(std::int64_t stamp_ns = kStart)
{
  LidarScan scan;
  scan.stamp_ns = stamp_ns;
  scan.points.push_back(1.5F, -2.0F, 0.25F, 10.0F, 0, 3);
  scan.points.push_back(-4.0F, 2.5F, 1.0F, 20.0F, 12'345'678, 7);
  scan.points.push_back(8.0F, 0.5F, -0.5F, 30.0F, 99'000'001, 15);
  return scan;
}

/** Clouds at 10 Hz and inertial samples at 200 Hz. */
inline std::vector<TopicMessage> smallRecording(Wire wire, int scans = 10)
{
  return messagesOf(recording(scans), wire);
}

inline std::string contentOfFile(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/** The fields of a cloud. */
inline CloudColumns columnsOf(const mrpt::obs::CObservation& observation)
{
  return readColumns(
      *dynamic_cast<const mrpt::obs::CObservationPointCloud&>(observation).pointcloud);
}

/** Has a folder for recordings. */
class RecordingTest : public ::testing::Test
{
 protected:
  std::string fileOf(const std::string& bytes, const std::string& name = "recording")
  {
    write(folder_.file(name), bytes);
    return folder_.file(name);
  }

  /** All but a chunk whose compression is not known is read. \param rest observations
   * \return the message about the chunk */
  std::string expectAChunkIsLeftOut(const std::string& bytes, std::size_t rest)
  {
    const Recorded bag = readRecording(fileOf(bytes));
    EXPECT_EQ(bag.observations.size(), rest);
    EXPECT_EQ(bag.problems.size(), 1U);
    if (bag.problems.empty()) return {};
    EXPECT_EQ(bag.problems[0].kind, ReadProblemKind::NotSupported) << bag.problems[0].message;
    return bag.problems[0].message;
  }

  TemporaryFolder folder_;
};

}  // namespace fastlio::testing
