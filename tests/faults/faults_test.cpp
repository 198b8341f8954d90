// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file faults_test.cpp Every fault: never a crash, a hang, a number that is not finite or lost
 * outputs; a bounded error where the fault can be recovered from. The table is printed at the end
 * (docs/robustness.md). */

#include "faults.h"

#include "fault_run.h"
#include "repeats.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace fastlio::testing
{
namespace
{
constexpr std::size_t kSeeds = 3;    // of each fault of observations, one of them in a sample
constexpr double kAllowance = 0.02;  // beside the factor [m]
// Of a file that is damaged.
const char* const kFileWords =
    "damaged.rawlog: object .*(Copy the file anew|was cut off|class is not known)";

/** A row of the table. */
struct Row
{
  std::string fault;
  std::size_t tried = 0, ok = 0, named = 0;
  double worst = 0.0, limit = 0.0;
};

class FaultTable : public ::testing::Environment
{
 public:
  static std::vector<Row>& rows()
  {
    static std::vector<Row> table;
    return table;
  }

  void TearDown() override
  {
    std::printf(
        "\n| fault | tried | survived | named | largest error [m] | limit [m] |\n"
        "|---|--:|--:|--:|--:|--:|\n");
    for (const Row& row : rows())
    {
      const bool bounded = row.limit > 0.0;
      std::printf(
          bounded ? "| %s | %zu | %zu | %zu | %.3f | %.3f |\n"
                  : "| %s | %zu | %zu | %zu | - | - |\n",
          row.fault.c_str(), row.tried, row.ok, row.named, row.worst, row.limit);
    }
  }
};

const auto* const kTable = ::testing::AddGlobalTestEnvironment(new FaultTable);

/** Properties of every fault. */
bool survived(const FaultOutcome& outcome)
{
  EXPECT_TRUE(outcome.ended) << "exit status " << outcome.exit_status << "\n" << outcome.log;
  EXPECT_TRUE(outcome.outputs_complete) << outcome.log;
  EXPECT_TRUE(outcome.finite) << outcome.log;
  return outcome.ended && outcome.outputs_complete && outcome.finite;
}

void addRow(const Row& row)
{
  FaultTable::rows().push_back(row);
}

void tryFault(
    const ObservationFault& fault, const FaultRecording& recording, const FaultOutcome& clean,
    const std::string& folder, const std::string& sensor)
{
  SCOPED_TRACE(fault.name);
  Row row;
  row.fault = fault.name + sensor;
  if (fault.error_factor > 0.0) row.limit = fault.error_factor * clean.worst_position + kAllowance;
  for (std::size_t seed = 0; seed < sampled(kSeeds); ++seed)
  {
    Random random(seed);
    Observations observations = copyOf(recording.observations);
    fault.inject(observations, random);
    const FaultOutcome outcome = replayBytes(
        serialized(observations).bytes, recording, folder, fault.error_factor > 0.0, fault.words);
    ++row.tried;
    row.ok += survived(outcome) ? 1 : 0;
    row.named += outcome.named ? 1 : 0;
    EXPECT_EQ(outcome.named, !fault.words.empty()) << outcome.log;
    EXPECT_GE(
        static_cast<double>(outcome.poses), fault.poses_share * static_cast<double>(clean.poses))
        << outcome.log;
    if (fault.error_factor == 0.0) continue;
    row.worst = std::max(row.worst, outcome.worst_position);
    EXPECT_LE(outcome.worst_position, row.limit) << outcome.log;
  }
  addRow(row);
}

void tryAll(LidarKind kind, const std::vector<ObservationFault>& faults, const std::string& sensor)
{
  const TemporaryFolder folder;
  const FaultRecording recording = makeFaultRecording(kind);
  const FaultOutcome clean =
      replayBytes(serialized(recording.observations).bytes, recording, folder.path(), true, "");
  ASSERT_TRUE(survived(clean));
  ASSERT_EQ(clean.exit_status, 0) << clean.log;
  ASSERT_LT(clean.worst_position, 0.05);
  ASSERT_GT(clean.poses, 80U);
  for (const ObservationFault& fault : faults)
    tryFault(fault, recording, clean, folder.path(), sensor);
}
}  // namespace

TEST(Faults, OfObservations)
{
  tryAll(LidarKind::Vlp16, observationFaults(), "");
}

TEST(Faults, OfPoints)
{
  tryAll(LidarKind::Os64, pointFaults(), " (points)");
}

TEST(Faults, OfFiles)
{
  const TemporaryFolder folder;
  const FaultRecording recording = makeFaultRecording(LidarKind::Vlp16);
  const RawlogBytes rawlog = serialized(recording.observations);
  Random random(1);
  for (const FileFault& fault : fileFaults())
  {
    SCOPED_TRACE(fault.name);
    Row row;
    row.fault = fault.name;
    // Spread over all places of the fault.
    const std::size_t step = everything() ? 1 : 3;
    for (std::size_t i = 0; i < repeats(fault.count); i += step)
    {
      const FaultOutcome outcome =
          replayBytes(fault.damage(rawlog, i, random), recording, folder.path(), false, kFileWords);
      ++row.tried;
      row.ok += survived(outcome) ? 1 : 0;
      row.named += outcome.named ? 1 : 0;
      EXPECT_TRUE(outcome.named || !fault.always_seen) << outcome.log;
    }
    addRow(row);
  }
}

}  // namespace fastlio::testing
