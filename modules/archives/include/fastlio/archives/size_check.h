// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file size_check.h Whether an object can be as large as it says, before MRPT allocates what it
 * says. */
#pragma once

#include <fastlio/archives/object_stream.h>

namespace fastlio
{
/** The verdict on the lengths inside a serialised object. */
enum class SizeVerdict
{
  Plausible,  //!< everything announced is there, as far as the layout of its class is known
  RunsOut,    //!< the file ends before
  Misaligned  //!< the object does not end where its lengths say
};

/** Follows the lengths of the object at hand, whose start the stream must be at; moves nothing.
 * Knows the classes that odometry works on; about others it says Plausible. */
[[nodiscard]] SizeVerdict checkSizes(ObjectStream& stream);

}  // namespace fastlio
