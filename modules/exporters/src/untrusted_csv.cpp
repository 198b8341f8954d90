// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/number_text.h>

namespace fastlio
{
namespace
{
constexpr const char* kUntrustedHeader =
    "# Stretches of the run that cannot be trusted; no rows: there are none. Stamps: ends of the\n"
    "# first and the last scan, seconds since the first scan's begin. cause: as in timing.csv.\n"
    "begin_ns,end_ns,begin_s,end_s,scans,cause\n";

void writeUntrusted(const RunEnd& end, AtomicFile& file)
{
  file.write(kUntrustedHeader);
  for (const UntrustedStretch& stretch : end.summary.statistics.health().untrusted())
    file.write(
        std::to_string(stretch.begin_ns) + "," + std::to_string(stretch.end_ns) + "," +
        fixedText(stretch.begin_s, 3) + "," + fixedText(stretch.end_s, 3) + "," +
        std::to_string(stretch.scans) + "," + toString(stretch.cause) + "\n");
}
}  // namespace

std::unique_ptr<Exporter> makeUntrustedExporter(const std::string& path)
{
  return writtenAtEnd(path, writeUntrusted);
}

}  // namespace fastlio
