// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file archived_object.h One object out of a file of its own. */
#pragma once

#include <fastlio/archives/object_stream.h>

#include <mrpt/serialization/CSerializable.h>

#include <string>

namespace fastlio
{
/** The object at hand. Lengths inside of it are checked before MRPT allocates what they say.
 * \exception std::runtime_error it is cut off, damaged, of an unknown class, or too large; the
 * sentence goes on behind "the file" */
[[nodiscard]] mrpt::serialization::CSerializable::Ptr readObjectHere(ObjectStream& stream);

/** The first object of a file of MRPT, gzip or not, of up to kLargestRecord bytes. */
[[nodiscard]] mrpt::serialization::CSerializable::Ptr readArchivedObject(const std::string& path);

}  // namespace fastlio
