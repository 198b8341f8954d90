// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/files/failure_text.h>
#include <fastlio/files/input_file.h>
#include <fastlio/report/report_reference.h>

#include <exception>
#include <filesystem>
#include <stdexcept>

namespace fastlio
{
namespace
{
template <typename T>
void keepEverySecond(std::vector<T>& values)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += 2)
    values[kept++] = values[i];
  values.resize(kept);
}

Trajectory readReference(const std::string& file)
{
  if (const auto problem = inputFileProblem(file))
    throw std::runtime_error("the reference '" + file + "' " + *problem);
  const std::uintmax_t bytes = std::filesystem::file_size(file);
  if (bytes > ReferenceComparison::kLargestFile)
    throw std::runtime_error(
        "the reference '" + file + "' has " + std::to_string(bytes) + " bytes, more than " +
        std::to_string(ReferenceComparison::kLargestFile) +
        ": use fastlio-eval, or a reference with fewer poses per second");
  return readTrajectory(file);
}

/** As fastlio-eval does by default; where positions on a line do not determine the rotation, by the
 * first pose. */
EvaluationReport evaluated(const Trajectory& estimate, const Trajectory& reference)
{
  try
  {
    EvaluationReport report = evaluate(estimate, reference, {});
    if (!report.uncertain_turn) return report;
  }
  catch (const std::invalid_argument&)  // NOLINT(bugprone-empty-catch): by the first pose, then
  {
  }
  EvaluationOptions options;
  options.alignment = Alignment::First;
  return evaluate(estimate, reference, options);
}
}  // namespace

ReferenceComparison::ReferenceComparison(std::string file, OutputFrame frame)
    : file_(std::move(file)), frame_(std::move(frame))
{
  poses_.source = "this run";
}

void ReferenceComparison::add(const ScanResult& result)
{
  if (file_.empty() || !hasPose(result.status)) return;
  if (seen_++ % poses_per_sample_ != 0) return;
  if (poses_.poses.size() == kMaxPoses)
  {
    keepEverySecond(poses_.poses);
    keepEverySecond(poses_.covariances);
    poses_per_sample_ *= 2;
    if ((seen_ - 1) % poses_per_sample_ != 0) return;
  }
  const PoseEstimate body = poseEstimateOf(result.filter, frame_.T_imu_body);
  poses_.poses.push_back({result.stamp_ns, body.T_world_body});
  poses_.covariances.push_back(body.covariance);
}

ReferenceFindings ReferenceComparison::findings() const
{
  ReferenceFindings findings;
  findings.file = file_;
  findings.body = frame_.name;
  findings.poses_per_sample = poses_per_sample_;
  if (file_.empty()) return findings;
  try
  {
    if (poses_.poses.empty()) throw std::runtime_error("the run has no pose to compare");
    findings.report = evaluated(poses_, readReference(file_));
  }
  catch (const std::exception& e)
  {
    findings.problem = failureText(e);
  }
  return findings;
}

}  // namespace fastlio
