// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file stack_anchor.h The same bytes wherever the stack begins. */
#pragma once

namespace fastlio
{
/** On the stack of a function: all that is called from there lies at the same places within cache
 * lines, whoever the caller is. Eigen's loops over blocks of a matrix begin with the first number
 * that is aligned for the widest registers, those before it are treated one by one, and the last
 * bit of a sum depends on it. */
class StackAnchor
{
 public:
  StackAnchor() { asm volatile("" : : "r"(line_) : "memory"); }  // which keeps it in place

 private:
  alignas(64) char line_[64];
};

}  // namespace fastlio
