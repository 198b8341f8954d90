// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/deskew.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{
using Mat3f = Eigen::Matrix3f;
using Vec3f = Eigen::Vector3f;

// A first-order step of this angle leaves an error of angle^2/8 of the range: 0.1 mm at 10 m.
constexpr double kMaxStepAngle = 0.01;

MotionStep stepAt(
    const MotionKnot& knot, std::int64_t begin_ns, std::int64_t middle_ns, const Pose& T_imu_lidar)
{
  const double dt = toSeconds(middle_ns - knot.stamp_ns);
  const Pose middle = poseAfter(knot, dt);
  const Vec3 v = knot.v + dt * knot.a;
  const Mat3 R_rate = middle.R * skew(knot.w);
  MotionStep step;
  step.begin_ns = begin_ns;
  step.middle_ns = middle_ns;
  step.M = (middle.R * T_imu_lidar.R).cast<float>();
  step.N = (R_rate * T_imu_lidar.R).cast<float>();
  step.b = (middle * T_imu_lidar.p).cast<float>();
  step.c = (R_rate * T_imu_lidar.p + v).cast<float>();
  return step;
}

/** Splits the knots' intervals so that no step turns by more than kMaxStepAngle. */
void splitMotion(
    const std::vector<MotionKnot>& knots, const Pose& T_imu_lidar, std::vector<MotionStep>& steps)
{
  steps.clear();
  for (std::size_t i = 0; i + 1 < knots.size(); ++i)
  {
    const std::int64_t length_ns = knots[i + 1].stamp_ns - knots[i].stamp_ns;
    const double angle = knots[i].w.norm() * toSeconds(length_ns);
    const auto parts = static_cast<std::int64_t>(std::clamp(angle / kMaxStepAngle, 0.0, 1e3)) + 1;
    for (std::int64_t k = 0; k < parts; ++k)
    {
      const std::int64_t begin_ns = knots[i].stamp_ns + k * length_ns / parts;
      steps.push_back(stepAt(knots[i], begin_ns, begin_ns + length_ns / (2 * parts), T_imu_lidar));
    }
  }
}

/** The last step that has begun at a stamp, whatever \a from; cheap when the stamps come nearly in
 * order. */
std::size_t walkToStep(
    const std::vector<MotionStep>& steps, std::size_t from, std::int64_t stamp_ns)
{
  while (from + 1 < steps.size() && steps[from + 1].begin_ns <= stamp_ns)
    ++from;
  while (from > 0 && steps[from].begin_ns > stamp_ns)
    --from;
  return from;
}

void store(BodyPoints& body, std::size_t i, const Vec3f& p, const Vec3f& beam)
{
  const float inverse_range = 1.0F / beam.norm();
  body.x[i] = p.x();
  body.y[i] = p.y();
  body.z[i] = p.z();
  body.ux[i] = beam.x() * inverse_range;
  body.uy[i] = beam.y() * inverse_range;
  body.uz[i] = beam.z() * inverse_range;
}

Vec3f pointOf(const PointColumns& points, std::uint32_t i)
{
  return {points.x[i], points.y[i], points.z[i]};
}

/** Without the offsets of its beam, whose elevation as measured is stored. */
Vec3f correctedPoint(
    const PointColumns& points, std::uint32_t i, const BeamCorrections& beams, std::uint16_t& bin)
{
  Vec3f p = pointOf(points, i);
  bin = static_cast<std::uint16_t>(beams.apply(p.x(), p.y(), p.z()));
  return p;
}
}  // namespace

void BodyPoints::resize(std::size_t n)
{
  for (auto* column : {&x, &y, &z, &ux, &uy, &uz})
    column->resize(n);
  beam_bin.resize(n);
}

Deskewer::Deskewer(std::shared_ptr<const Workers> workers) : workers_(std::move(workers)) {}

void Deskewer::deskew(
    const LidarScan& scan, const std::vector<std::uint32_t>& indices,
    const std::vector<MotionKnot>& knots, BodyPoints& body, const BeamCorrections& beams)
{
  splitMotion(knots, scan.T_imu_lidar, steps_);
  if (steps_.empty()) return transformToBody(scan, indices, body, beams);
  body.resize(indices.size());
  const auto chunk = [&](std::size_t, std::size_t first, std::size_t last)
  {
    std::size_t at = 0;
    for (std::size_t i = first; i < last; ++i)
    {
      const std::int64_t stamp_ns = scan.stamp_ns + scan.points.time_offset_ns[indices[i]];
      at = walkToStep(steps_, at, stamp_ns);
      const MotionStep& step = steps_[at];
      const float dt = static_cast<float>(stamp_ns - step.middle_ns) * 1e-9F;
      const Vec3f p = correctedPoint(scan.points, indices[i], beams, body.beam_bin[i]);
      const Vec3f beam = step.M * p + dt * (step.N * p);
      store(body, i, beam + step.b + dt * step.c, beam);
    }
  };
  workers_->forEachChunk(indices.size(), chunk);
}

void Deskewer::transformToBody(
    const LidarScan& scan, const std::vector<std::uint32_t>& indices, BodyPoints& body,
    const BeamCorrections& beams) const
{
  body.resize(indices.size());
  const Mat3f R = scan.T_imu_lidar.R.cast<float>();
  const Vec3f t = scan.T_imu_lidar.p.cast<float>();
  const auto chunk = [&](std::size_t, std::size_t first, std::size_t last)
  {
    for (std::size_t i = first; i < last; ++i)
    {
      const Vec3f beam = R * correctedPoint(scan.points, indices[i], beams, body.beam_bin[i]);
      store(body, i, beam + t, beam);
    }
  };
  workers_->forEachChunk(indices.size(), chunk);
}

}  // namespace fastlio
