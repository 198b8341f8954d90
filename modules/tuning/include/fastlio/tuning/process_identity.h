// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file process_identity.h Which process holds something, and whether it still runs. */
#pragma once

#include <cstdint>
#include <string>

namespace fastlio
{
/** A process, distinguished from a later one that gets the same number. */
struct ProcessIdentity
{
  std::string host;        //!< name, boot and process namespace: where the number means something
  std::int64_t pid = 0;    //!< number
  std::int64_t start = 0;  //!< when it began, in ticks since the boot
};

/** The process that asks. \exception std::runtime_error /proc cannot be read */
[[nodiscard]] ProcessIdentity thisProcess();

/** Whether a process of this host still runs; one that nobody has waited for (a zombie) does not.
 */
[[nodiscard]] bool isRunning(const ProcessIdentity& process);

}  // namespace fastlio
