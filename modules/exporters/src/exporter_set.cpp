// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/exporter.h>

#include <algorithm>
#include <exception>

namespace fastlio
{
void ExporterSet::add(std::unique_ptr<Exporter> exporter)
{
  exporters_.push_back(std::move(exporter));
}

void ExporterSet::onScan(const ScanResult& result, const std::vector<ImuRateState>& before)
{
  for (auto& exporter : exporters_)
  {
    if (!exporter) continue;
    try
    {
      exporter->onImuRate(before);
      exporter->onScan(result);
    }
    catch (const std::exception& e)
    {
      problems_.emplace_back(e.what());
      exporter.reset();  // its temporary file keeps the rows so far
    }
  }
}

bool ExporterSet::needMap() const
{
  return std::any_of(
      exporters_.begin(), exporters_.end(),
      [](const auto& exporter) { return exporter && exporter->needsMap(); });
}

RunSummary ExporterSet::finish(RunSummary summary, const OutputMap& map, const SurfaceMap* surfaces)
{
  summary.output_problems.insert(summary.output_problems.end(), problems_.begin(), problems_.end());
  for (auto& exporter : exporters_)
  {
    if (!exporter) continue;
    try
    {
      for (auto& file : exporter->finish({summary, map, surfaces}))
        summary.outputs.push_back(std::move(file));
    }
    catch (const std::exception& e)
    {
      summary.output_problems.emplace_back(e.what());
    }
  }
  return summary;
}

}  // namespace fastlio
