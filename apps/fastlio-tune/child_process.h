// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file child_process.h Runs a program and waits for it. */
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fastlio
{
struct ChildEnd
{
  enum class Kind
  {
    Exited,    //!< by itself: see the status
    Killed,    //!< by a signal that was not ours: see the status
    TimedOut,  //!< by us
    Stopped    //!< by us, as \a go_on said no
  };
  Kind kind = Kind::Exited;
  int status = 0;  //!< exit status, or the signal
};

/** Standard output is dropped, standard error goes to a file. The child is killed by the system
 * when this process ends, however it ends.
 * \param go_on asked some fifty times a second while the child runs
 * \exception std::runtime_error the program cannot be started or waited for */
[[nodiscard]] ChildEnd runChild(
    const std::vector<std::string>& words, const std::string& error_file, double timeout,
    const std::function<bool()>& go_on);
}  // namespace fastlio
