// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file one_file_exporter.h Exporters of one file, each made from the function that writes it
 * (internal). */
#pragma once

#include <fastlio/exporters/exporter.h>
#include <fastlio/files/gzip_file.h>

#include <functional>
#include <memory>
#include <string>

namespace fastlio
{
/** A file with a header and what \a row gives for each scan: a line with its end, or nothing. */
[[nodiscard]] std::unique_ptr<Exporter> rowPerScan(
    const std::string& path, const std::string& header,
    std::function<std::string(const ScanResult&)> row);

/** A file that is written when the run is over. */
[[nodiscard]] std::unique_ptr<Exporter> writtenAtEnd(
    const std::string& path, std::function<void(const RunEnd&, AtomicFile&)> write);

/** The same for an archive of MRPT. \param needs_map whether it holds the map */
[[nodiscard]] std::unique_ptr<Exporter> archiveAtEnd(
    const std::string& path, bool needs_map, std::function<void(const RunEnd&, GzipFile&)> write);

/** A file that holds the map. */
[[nodiscard]] std::unique_ptr<Exporter> mapFile(
    const std::string& path, std::function<void(const OutputMap&, AtomicFile&)> write);

}  // namespace fastlio
