// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/exporter.h>
#include <fastlio/files/failure_text.h>

#include <algorithm>
#include <exception>

namespace fastlio
{
namespace
{
std::string problemWith(const std::string& file, const std::string& reason)
{
  const bool named = file.empty() || reason.find(file) != std::string::npos;
  return named ? reason : "cannot write '" + file + "': " + reason;
}
}  // namespace

void ExporterSet::add(std::unique_ptr<Exporter> exporter, std::string file)
{
  members_.push_back({std::move(exporter), std::move(file)});
}

void ExporterSet::giveUp(Member& member, const std::string& reason)
{
  member.exporter.reset();  // its file keeps the content that it had before the run
  problems_.push_back(problemWith(member.file, reason));
}

void ExporterSet::onScan(const ScanResult& result, const std::vector<ImuRateState>& before)
{
  for (Member& member : members_)
  {
    if (!member.exporter) continue;
    try
    {
      member.exporter->onImuRate(before);
      member.exporter->onScan(result);
    }
    catch (const std::exception& e)
    {
      giveUp(member, failureText(e));
    }
  }
}

void ExporterSet::giveUpMap(const std::string& reason)
{
  map_problem_ = reason;
  for (Member& member : members_)
    if (member.exporter && member.exporter->needsMap()) giveUp(member, reason);
}

bool ExporterSet::needMap() const
{
  return map_problem_.empty() &&
         std::any_of(
             members_.begin(), members_.end(),
             [](const Member& member) { return member.exporter && member.exporter->usesMap(); });
}

RunSummary ExporterSet::finish(RunSummary summary, const OutputMap& map, const SurfaceMap* surfaces)
{
  summary.output_problems.insert(summary.output_problems.end(), problems_.begin(), problems_.end());
  for (Member& member : members_)
  {
    if (!member.exporter) continue;
    try
    {
      for (auto& file : member.exporter->finish({summary, map, surfaces, map_problem_}))
        summary.outputs.push_back(std::move(file));
    }
    catch (const std::exception& e)
    {
      summary.output_problems.push_back(problemWith(member.file, failureText(e)));
      member.exporter.reset();  // frees the disk for the others
    }
  }
  return summary;
}

}  // namespace fastlio
