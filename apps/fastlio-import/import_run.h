// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file import_run.h Inputs to rawlog. */
#pragma once

#include "command_line.h"

#include <stdexcept>

namespace fastlio
{
/** Nothing in the inputs can be used. */
class ImportInputError : public std::runtime_error
{
 public:
  using std::runtime_error::runtime_error;
};

/** Prints to standard output, problems to standard error.
 * \exception ImportInputError an input does not exist, or has nothing that is asked for
 * \exception std::invalid_argument the arguments do not go together
 * \exception std::runtime_error an output cannot be written */
[[nodiscard]] ImportStatus runImport(const ImportArguments& arguments);

}  // namespace fastlio
