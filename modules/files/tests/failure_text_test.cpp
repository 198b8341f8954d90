// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/failure_text.h>

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace fastlio
{
namespace
{
TEST(FailureText, ASentenceStaysAsItIs)
{
  EXPECT_EQ(failureText(std::runtime_error("cannot write 'a'")), "cannot write 'a'");
  EXPECT_EQ(failureText(std::bad_alloc()), "there is not enough memory");
}

// A disk that is full while MRPT serialises an object: fastlio-map printed addresses of code.
TEST(FailureText, WhatMrptPutsAroundItIsTakenOff)
{
  const std::string inner =
      "==== MRPT exception ====\ncannot write 'a'\nCall stack backtrace:\n[0 ] 0x7f15 \n";
  EXPECT_EQ(failureText(std::runtime_error(inner)), "cannot write 'a'");
  const std::string outer =
      "==== MRPT exception ====\n" + inner + "\nCall stack backtrace:\n[1 ] 0x55 \n";
  EXPECT_EQ(failureText(std::runtime_error(outer)), "cannot write 'a'");
  EXPECT_EQ(failureText(std::runtime_error("==== MRPT exception ====\ncut")), "cut");
}

}  // namespace
}  // namespace fastlio
