// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/evaluate.h>
#include <fastlio/math/time.h>

#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
void requirePositive(double value, const std::string& what)
{
  if (!(value > 0.0) || !std::isfinite(value))
    throw std::invalid_argument(what + " must be a number above 0, saw " + std::to_string(value));
}

void requireValid(const EvaluationOptions& options)
{
  requirePositive(options.rpe_seconds, "the span of the relative error per second");
  requirePositive(options.rpe_metres, "the span of the relative error per metre");
  for (const double length : options.segment_lengths)
    requirePositive(length, "a segment's length");
}

AlignedTrajectories applyAlignment(const AssociatedTrajectories& t, const Similarity& S)
{
  AlignedTrajectories aligned{t.reference, t.estimate};
  for (StampedPose& pose : aligned.estimate)
    pose.T_world_body = S * pose.T_world_body;
  return aligned;
}

}  // namespace

EvaluationReport evaluate(
    const Trajectory& estimate, const Trajectory& reference, const EvaluationOptions& options)
{
  requireValid(options);
  const AssociatedTrajectories associated = associate(estimate, reference, options.association);
  EvaluationReport r;
  r.options = options;
  r.estimate_source = estimate.source;
  r.reference_source = reference.source;
  r.association = associated.counts;
  r.alignment = align(associated, options.alignment);
  r.aligned = applyAlignment(associated, r.alignment);
  r.duration =
      toSeconds(associated.reference.back().stamp_ns - associated.reference.front().stamp_ns);
  r.errors = absoluteErrors(r.aligned);
  r.ape = summarize(r.errors);
  r.uncertain_turn = uncertainTurn(associated, options.alignment, r.ape.translation.rmse);
  r.rpe_second = summarize(relativeErrorsPerSecond(r.aligned, options.rpe_seconds));
  r.rpe_metre = summarize(relativeErrorsPerMetre(r.aligned, options.rpe_metres));
  r.segments = segmentErrors(r.aligned, options.segment_lengths);
  r.segment_average = averageOf(r.segments);
  r.drift = endToEndDrift(r.aligned);
  r.deviations = deviations(associated, options.nees_alignment);
  r.nees = consistency(associated, options.nees_alignment);
  return r;
}

}  // namespace fastlio
