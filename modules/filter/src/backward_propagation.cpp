// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/backward_propagation.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
/** Number of samples that hold for a time before end_ns. */
std::size_t countBefore(const std::vector<ImuSample>& samples, std::int64_t end_ns)
{
  const auto later = [](const ImuSample& a, const ImuSample& b) { return a.stamp_ns < b.stamp_ns; };
  const auto fault = std::is_sorted_until(samples.begin(), samples.end(), later);
  if (fault != samples.end())
  {
    throw std::invalid_argument(
        "backwardPropagate: inertial sample " + std::to_string(fault - samples.begin()) +
        " has stamp " + std::to_string(fault->stamp_ns) + " ns, before its predecessor's " +
        std::to_string((fault - 1)->stamp_ns) + " ns; sort the samples by stamp");
  }
  const auto end = std::partition_point(
      samples.begin(), samples.end(), [end_ns](const ImuSample& s) { return s.stamp_ns < end_ns; });
  return static_cast<std::size_t>(end - samples.begin());
}

/** One step of eq. 9 from the knot at the right to the stamp of the sample that holds before it.
 *
 * The forward step (eq. 4) turns by half, accelerates there, and turns by the other half, so going
 * back the attitude comes first, then the velocity, then the position with the mean of both
 * velocities: the exact inverse of eq. 4. Eq. 9 as printed takes R_j and v_j at the right end; both
 * agree to first order in dt, but only this one meets the forward poses again. */
MotionKnot stepBack(
    const MotionKnot& right, const ImuSample& sample, const NavState& end_state, const Vec3& g_k)
{
  const double dt = toSeconds(right.stamp_ns - sample.stamp_ns);
  MotionKnot left;
  left.stamp_ns = sample.stamp_ns;
  left.w = sample.gyro - end_state.gyro_bias;
  const Mat3 R_middle = right.R * expSO3(-0.5 * dt * left.w);
  left.R.noalias() = right.R * expSO3(-dt * left.w);
  left.a = R_middle * (sample.accel - end_state.accel_bias) + g_k;
  left.v = right.v - dt * left.a;
  left.p = right.p - dt * left.v - 0.5 * dt * dt * left.a;
  return left;
}
}  // namespace

// Eq. 9, from R = I, p = 0, v = R_k^T v_k at t_k.
void backwardPropagate(
    const NavState& end_state, std::int64_t end_ns, const std::vector<ImuSample>& samples,
    std::vector<MotionKnot>& knots)
{
  const std::size_t n = countBefore(samples, end_ns);
  const Vec3 g_k = end_state.R.transpose() * end_state.g;
  knots.resize(n + 1);
  knots[n] = MotionKnot{};
  knots[n].stamp_ns = end_ns;
  knots[n].v = end_state.R.transpose() * end_state.v;
  for (std::size_t i = n; i-- > 0;)
    knots[i] = stepBack(knots[i + 1], samples[i], end_state, g_k);
  if (n == 0) return;
  // Instants after t_k (a late point) go on with the last input.
  knots[n].w = knots[n - 1].w;
  knots[n].a = knots[n - 1].a;
}

// T_Ik_Ij of eq. 10: inside an interval the same zero-order hold as between the knots, so that the
// motion is continuous at them.
Pose poseAfter(const MotionKnot& knot, double dt)
{
  return {knot.R * expSO3(dt * knot.w), knot.p + dt * knot.v + 0.5 * dt * dt * knot.a};
}

Pose bodyPoseAt(const std::vector<MotionKnot>& knots, std::int64_t stamp_ns)
{
  if (knots.empty())
  {
    throw std::invalid_argument("bodyPoseAt: no knots; call backwardPropagate first");
  }
  const auto right = std::upper_bound(
      knots.begin(), knots.end(), stamp_ns,
      [](std::int64_t stamp, const MotionKnot& knot) { return stamp < knot.stamp_ns; });
  const MotionKnot& left = right == knots.begin() ? knots.front() : *(right - 1);
  return poseAfter(left, toSeconds(stamp_ns - left.stamp_ns));
}

}  // namespace fastlio
