// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file read_problem.h A problem while reading a recording. */
#pragma once

#include <cstddef>
#include <string>

namespace fastlio
{
enum class ReadProblemKind
{
  NotFound,      //!< no such file, or it cannot be opened
  NotARawlog,    //!< the content is something else, or empty
  Truncated,     //!< the file ends inside an object or inside the compressed data
  Corrupt,       //!< an object or the compressed data cannot be decoded
  UnknownClass,  //!< an object of a class that this MRPT does not know
  ExternalFile,  //!< the data of an observation lie in another file that cannot be read
  NotSupported   //!< a compression, an encoding or a message that this program does not read
};

[[nodiscard]] const char* toString(ReadProblemKind kind);

/** One problem; the same kind with the same class in one file is reported once and counted. */
struct ReadProblem
{
  std::string file;
  ReadProblemKind kind = ReadProblemKind::Corrupt;
  std::string class_name;  //!< class of the object, type of the message; empty when unknown
  std::string message;     //!< what happened, where, and what to do
  std::size_t occurrences = 1;
};

/** The message, with the number of times where there are several. */
[[nodiscard]] std::string sentenceOf(const ReadProblem& problem);

}  // namespace fastlio
