// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The power fails after any call of a run: what the disk holds then follows from the order of
// calls.

#include "failing_run.h"

#include <filesystem>
#include <set>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;

/** The data of a process that a disk surely holds, by its calls. */
class Disk
{
 public:
  void take(const JournalLine& line)
  {
    if (line.what == "write") unsynced_.insert(line.path);
    if (line.what == "fsync") unsynced_.erase(line.path);
    if (line.what == "fsync") unsynced_names_.erase(line.path);
    if (line.what == "rename") rename(line);
    if (line.what == "remove") expectEverythingThere(line.path);
  }

  /** Removing what the earlier run left is for when the new run is safe; also the end is. */
  void expectEverythingThere(const std::string& at) const
  {
    EXPECT_TRUE(unsynced_names_.empty()) << *unsynced_names_.begin() << " is not synced at " << at;
  }

  [[nodiscard]] const std::set<std::string>& names() const { return names_; }

 private:
  /** The file gets a name that an older one has: it has to be on the disk as a whole. */
  void rename(const JournalLine& line)
  {
    EXPECT_EQ(unsynced_.count(line.path), 0U)
        << line.other << " may be empty after a power failure";
    EXPECT_EQ(fs::path(line.path).parent_path(), fs::path(line.other).parent_path());
    names_.insert(fs::path(line.other).filename().string());
    unsynced_names_.insert(fs::path(line.other).parent_path().string());
  }

  std::set<std::string> unsynced_;        //!< files with bytes that a power failure takes away
  std::set<std::string> unsynced_names_;  //!< folders with new names that it takes away
  std::set<std::string> names_;
};

using PowerLoss = FailingRuns;

TEST_F(PowerLoss, LeavesTheOldOrTheNewFileAtAnyTime)
{
  const FailingRun good = run("none", 0, true);
  ASSERT_EQ(good.result.exit_status, 0) << good.result.output;
  Disk disk;
  bool leftover_removed = false;
  for (const JournalLine& line : good.journal)
  {
    disk.take(line);
    if (line.what != "remove" || fs::path(line.path).filename() != "poses.graph") continue;
    leftover_removed = true;
    EXPECT_EQ(disk.names().size(), complete().size()) << "removed before the run was complete";
  }
  disk.expectEverythingThere("the end");
  EXPECT_TRUE(leftover_removed);
  for (const auto& [name, content] : complete())
    EXPECT_EQ(disk.names().count(name), 1U) << name;
}

}  // namespace
}  // namespace fastlio::testing
