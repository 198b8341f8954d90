// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file injection.h Which call of a process fails, and a journal of its calls: both from the
 * environment, FASTLIO_FAULT=KIND:N and FASTLIO_JOURNAL=FILE. Nothing here allocates memory. */
#pragma once

namespace fastlio::testing
{
/** Counts a call of this kind; true: it is the one that has to fail. \a about is for the journal.
 */
bool failsNow(const char* kind, const char* about);

/** A line of the journal: "what path other". */
void journal(const char* what, const char* path, const char* other = "");

/** The same for the bytes of a write. */
void journal(const char* what, const char* path, long bytes);

}  // namespace fastlio::testing
