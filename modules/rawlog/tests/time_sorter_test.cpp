// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What the sorter of observations holds where stamps do not go forward.

#include "time_sorter.h"

#include "test_files.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRotatingScan.h>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

constexpr std::int64_t kWindowNs = 200'000'000;

/** Says that it has a million points. */
mrpt::obs::CObservation::Ptr largeScan(const mrpt::Clock::time_point& stamp)
{
  auto scan = std::make_shared<mrpt::obs::CObservationRotatingScan>();
  scan->timestamp = stamp;
  scan->rowCount = scan->columnCount = 1000;
  return scan;
}

std::size_t heldOf(const mrpt::Clock::time_point& stamp)
{
  TimeSorter sorter(kWindowNs);
  std::size_t held = 0;
  for (int i = 0; i < 100; ++i, ++held)
  {
    sorter.push(largeScan(stamp));
    for (; sorter.ready(); --held)
      (void)sorter.pop();
  }
  return held;
}

TEST(TimeSorter, HoldsABoundedNumberOfPoints)
{
  EXPECT_EQ(heldOf(imuAt(0)->timestamp), 10U);
}

TEST(TimeSorter, WhatHasNoTimeDoesNotWait)
{
  EXPECT_EQ(heldOf(INVALID_TIMESTAMP), 0U);
}

TEST(TimeSorter, SmallObservationsWaitForTheWindow)
{
  TimeSorter sorter(kWindowNs);
  for (int i = 0; i < 1000; ++i)
    sorter.push(imuAt(0.0001 * i));
  EXPECT_FALSE(sorter.ready());
  sorter.push(imuAt(0.2));
  EXPECT_TRUE(sorter.ready());
}
}  // namespace
