// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "import_inputs.h"

#include <utility>

namespace fastlio
{
ImportInputs::ImportInputs(const std::vector<std::string>& files, bool merge)
{
  if (!merge)
    inputs_.push_back({RawlogSource(files), nullptr});
  else
    for (const std::string& file : files)
      inputs_.push_back({RawlogSource({file}), nullptr});
  for (Input& input : inputs_)
    input.waiting = input.source.next();
}

mrpt::obs::CObservation::Ptr ImportInputs::next()
{
  Input* first = nullptr;
  for (Input& input : inputs_)
    if (input.waiting && (first == nullptr || input.waiting->timestamp < first->waiting->timestamp))
      first = &input;
  if (first == nullptr) return nullptr;
  auto observation = std::move(first->waiting);
  first->waiting = first->source.next();
  return observation;
}

std::vector<ReadProblem> ImportInputs::problems() const
{
  std::vector<ReadProblem> problems;
  for (const Input& input : inputs_)
    problems.insert(problems.end(), input.source.problems().begin(), input.source.problems().end());
  return problems;
}

ReadProgress ImportInputs::progress() const
{
  ReadProgress all;
  for (const Input& input : inputs_)
  {
    const ReadProgress progress = input.source.progress();
    all.bytes_read += progress.bytes_read;
    all.bytes_total += progress.bytes_total;
    all.objects_read += progress.objects_read;
    all.observations_read += progress.observations_read;
  }
  return all;
}

}  // namespace fastlio
