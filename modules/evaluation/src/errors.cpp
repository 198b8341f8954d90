// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/errors.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
PoseError magnitude(const Pose& E)
{
  return {E.p.norm(), rotationAngle(E.R)};
}

PoseError operator/(const PoseError& e, double span)
{
  return {e.translation / span, e.rotation / span};
}

/** Spans shorter by this fraction still count: sums of steps and rounded stamps miss a span by a
 * hair.
 */
constexpr double kSpanTolerance = 1e-6;

/** Index of the first entry at least \a span behind entry i; abscissa.size() when there is none. */
std::size_t endOfSpan(const std::vector<double>& abscissa, std::size_t i, double span)
{
  const double target = abscissa[i] + span * (1.0 - kSpanTolerance);
  return static_cast<std::size_t>(
      std::lower_bound(abscissa.begin(), abscissa.end(), target) - abscissa.begin());
}

/** Relative errors from each pose to the first one at least \a delta farther along \a abscissa (any
 * non-decreasing measure of progress), divided by the abscissa between both. */
std::vector<PoseError> relativeErrorsAlong(
    const std::vector<double>& abscissa, double delta, const AlignedTrajectories& t)
{
  std::vector<PoseError> errors;
  for (std::size_t i = 0; i < abscissa.size(); ++i)
  {
    const std::size_t j = endOfSpan(abscissa, i, delta);
    if (j == abscissa.size()) break;
    errors.push_back(relativeError(t, i, j) / (abscissa[j] - abscissa[i]));
  }
  return errors;
}

/** Seconds since the first pose. */
std::vector<double> elapsed(const std::vector<StampedPose>& poses)
{
  std::vector<double> seconds;
  seconds.reserve(poses.size());
  for (const StampedPose& pose : poses)
    seconds.push_back(toSeconds(pose.stamp_ns - poses.front().stamp_ns));
  return seconds;
}

SegmentError segmentErrorsOf(
    const AlignedTrajectories& t, const std::vector<double>& path, double length)
{
  SegmentError mean;
  mean.length = length;
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    const std::size_t j = endOfSpan(path, i, length);
    if (j == path.size()) break;
    const PoseError e = relativeError(t, i, j) / length;
    ++mean.count;
    mean.translation += (e.translation - mean.translation) / static_cast<double>(mean.count);
    mean.rotation += (e.rotation - mean.rotation) / static_cast<double>(mean.count);
  }
  return mean;
}

}  // namespace

std::vector<PoseError> absoluteErrors(const AlignedTrajectories& t)
{
  std::vector<PoseError> errors;
  for (std::size_t i = 0; i < t.reference.size(); ++i)
    errors.push_back(magnitude(t.reference[i].T_world_body.inverse() * t.estimate[i].T_world_body));
  return errors;
}

PoseError relativeError(const AlignedTrajectories& t, std::size_t i, std::size_t j)
{
  const Pose Q_ij = t.reference[i].T_world_body.inverse() * t.reference[j].T_world_body;
  const Pose P_ij = t.estimate[i].T_world_body.inverse() * t.estimate[j].T_world_body;
  return magnitude(Q_ij.inverse() * P_ij);
}

PoseErrorStatistics summarize(const std::vector<PoseError>& errors)
{
  std::vector<double> translation, rotation;
  for (const PoseError& e : errors)
  {
    translation.push_back(e.translation);
    rotation.push_back(e.rotation);
  }
  return {summarize(std::move(translation)), summarize(std::move(rotation))};
}

std::vector<PoseError> relativeErrorsPerSecond(const AlignedTrajectories& t, double delta)
{
  return relativeErrorsAlong(elapsed(t.reference), delta, t);
}

std::vector<PoseError> relativeErrorsPerMetre(const AlignedTrajectories& t, double delta)
{
  return relativeErrorsAlong(pathLengths(t.reference), delta, t);
}

std::vector<SegmentError> segmentErrors(
    const AlignedTrajectories& t, const std::vector<double>& lengths)
{
  const std::vector<double> path = pathLengths(t.reference);
  std::vector<SegmentError> rows;
  for (const double length : lengths)
  {
    const SegmentError row = segmentErrorsOf(t, path, length);
    if (row.count > 0) rows.push_back(row);
  }
  return rows;
}

std::optional<SegmentError> averageOf(const std::vector<SegmentError>& rows)
{
  if (rows.empty()) return std::nullopt;
  SegmentError sum;
  for (const SegmentError& row : rows)
  {
    const auto n = static_cast<double>(row.count);
    sum.count += row.count;
    sum.translation += n * row.translation;
    sum.rotation += n * row.rotation;
  }
  const auto total = static_cast<double>(sum.count);
  sum.translation /= total;
  sum.rotation /= total;
  return sum;
}

std::optional<double> EndToEndDrift::ratio() const
{
  if (!(path_length > 0.0)) return std::nullopt;
  return error.translation / path_length;
}

EndToEndDrift endToEndDrift(const AlignedTrajectories& t)
{
  return {relativeError(t, 0, t.reference.size() - 1), pathLengths(t.reference).back()};
}

}  // namespace fastlio
