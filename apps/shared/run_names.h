// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_names.h Folders of runs that nobody has named. */
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace fastlio
{
/** The name of a recording without folder and suffix: "walk" of "data/walk.rawlog.gz". */
[[nodiscard]] std::string recordingName(const std::string& path);

/** \a first, or else "first-2" and so on: the first that is not taken. */
[[nodiscard]] std::string firstFree(
    const std::string& first, const std::function<bool(const std::string&)>& is_taken);

/** A folder that is not there yet, in the current one: "walk-run", or "walk-run-2" and so on. */
[[nodiscard]] std::string freeRunFolder(
    const std::string& recording, const std::string& suffix = "-run");

/** Makes "latest", in the current folder, a symbolic link to the folder of a run.
 * \return why it was not made; what is no symbolic link stays as it is, and so does a link that
 * leads to something else than a run */
[[nodiscard]] std::optional<std::string> linkLatest(const std::string& folder);

}  // namespace fastlio
