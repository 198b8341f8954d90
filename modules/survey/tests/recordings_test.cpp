// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Recordings of other programs and versions of MRPT; skipped where there are none.

#include "test_files.h"
#include <fastlio/rawlog/decode_ahead_source.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/velodyne_decoder.h>
#include <fastlio/sensors/xyzirt_access.h>
#include <fastlio/survey/sensor_selection.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

std::vector<std::string> recordings(const std::string& name_part)
{
  std::vector<std::string> files;
  if (recordingsFolder().empty()) return files;
  for (const auto& entry : std::filesystem::directory_iterator(recordingsFolder()))
  {
    const std::string file = entry.path().string();
    const bool is_rawlog = entry.path().extension() == ".rawlog";
    if (is_rawlog && file.find(name_part) != std::string::npos) files.push_back(file);
  }
  return files;
}

// The uncompressed bytes, by gzip itself.
std::string unpacked(const std::string& file)
{
  std::string bytes;
  const std::string command = "gzip -dc '" + file + "'";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return bytes;
  std::vector<char> chunk(1U << 20U);
  while (const std::size_t n = fread(chunk.data(), 1, chunk.size(), pipe))
    bytes.append(chunk.data(), n);
  pclose(pipe);
  return bytes;
}
}  // namespace

TEST(Recordings, AreReadToTheLastByteAndWrittenBackAsTheyWere)
{
  const auto files = recordings("");
  if (files.empty()) GTEST_SKIP() << "MRPT_FASTLIO_RECORDINGS_DIR is not set";
  for (const std::string& file : files)
  {
    const std::string original = unpacked(file);
    RawlogSource source({file}, {0.0});
    std::size_t at = 0;
    while (const auto observation = source.next())
    {
      const std::string bytes = serialize({observation});
      ASSERT_EQ(original.compare(at, bytes.size(), bytes), 0) << file << " at byte " << at;
      at += bytes.size();
    }
    EXPECT_EQ(at, original.size()) << file;
    EXPECT_TRUE(source.problems().empty()) << source.problems().front().message;
  }
}

TEST(Recordings, GoThroughTheBridgeWithoutLoss)
{
  const auto files = recordings("");
  if (files.empty()) GTEST_SKIP() << "MRPT_FASTLIO_RECORDINGS_DIR is not set";
  for (const std::string& file : files)
  {
    const auto selection = selectSensors(surveySensors({file}, {}), {});
    DecodeAheadSource source(RawlogSource({file}), ObservationBridge(selection));
    std::int64_t last_ns = 0;
    while (const auto input = source.next())
    {
      const auto* sample = std::get_if<ImuSample>(&input->data);
      const auto* scan = std::get_if<LidarScan>(&input->data);
      const std::int64_t stamp_ns = sample != nullptr ? sample->stamp_ns : scan->stamp_ns;
      EXPECT_GE(stamp_ns, last_ns) << file;
      last_ns = stamp_ns;
      if (scan == nullptr) continue;
      const ScanSpan span = spanOf(*scan);
      EXPECT_GE(span.begin_ns, stamp_ns - 1000) << file;
      EXPECT_LE(span.end_ns, stamp_ns + 150'000'000) << file;
      EXPECT_GT(scan->points.size(), 4000U) << file;
    }
    const BridgeStatistics& s = source.statistics();
    EXPECT_TRUE(source.problems().empty());
    EXPECT_EQ(s.scans_without_point_times + s.scans_unreadable + s.other_sensors, 0U) << file;
    EXPECT_EQ(s.packet_blocks_corrupt + s.packet_times_corrupt, 0U) << file;
  }
}

TEST(Recordings, PacketsAgreeWithMrptOnTheFirstFiring)
{
  const auto files = recordings("v");
  std::size_t compared = 0;
  for (const std::string& file : files)
  {
    RawlogSource source({file});
    for (int scans = 0; scans < 20;)
    {
      const auto observation = source.next();
      if (!observation) break;
      const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(observation);
      if (!scan) continue;
      ++scans;
      scan->generatePointCloud();
      const auto sweep = decodeVelodyne(*scan);
      // Both go through the blocks in the same order; theirs skips the second firing.
      std::size_t i = 0;
      double worst = 0;
      for (std::size_t k = 0; k < scan->point_cloud.size(); ++k)
      {
        const auto& theirs = scan->point_cloud;
        const auto differs = [&]
        {
          const double range = std::hypot(theirs.x[k], theirs.y[k], theirs.z[k]);
          return std::hypot(
                     theirs.x[k] - sweep.points.x[i], theirs.y[k] - sweep.points.y[i],
                     theirs.z[k] - sweep.points.z[i]) /
                 range;
        };
        while (i < sweep.points.size() && differs() > 1e-3)
          ++i;
        ASSERT_LT(i, sweep.points.size()) << "a point of MRPT's is missing";
        worst = std::max(worst, differs());
        ++i;
        ++compared;
      }
      EXPECT_LT(worst, 4.5e-4);
    }
  }
  if (compared == 0) GTEST_SKIP() << "no recordings with packets";
}
