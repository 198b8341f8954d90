// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/initialization/motion_fit.h>
#include <fastlio/math/time.h>

#include <Eigen/Cholesky>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::size_t kMinPoses = 4;
constexpr int kUnknowns = 9;  // position, velocity, gravity
using Square9 = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using Vector9 = Eigen::Matrix<double, kUnknowns, 1>;

/** The specific force since the first pose, integrated once and twice. */
class ForceIntegral
{
 public:
  ForceIntegral(const std::vector<ImuSample>& inputs, const MotionFitPrior& prior)
      : inputs_(inputs), prior_(prior)
  {
  }

  /** Goes on from one pose to the next; the attitude starts anew from each. */
  void advance(const StampedPose& from, std::int64_t to_ns)
  {
    Mat3 R = from.T_world_body.R;
    std::int64_t now_ns = from.stamp_ns;
    while (now_ns < to_ns && next_ < inputs_.size())
    {
      const ImuSample& u = inputs_[next_];
      const bool last = next_ + 1 == inputs_.size() || inputs_[next_ + 1].stamp_ns > to_ns;
      const std::int64_t stop_ns = last ? to_ns : inputs_[next_ + 1].stamp_ns;
      step(u, R, toSeconds(stop_ns - now_ns));
      now_ns = stop_ns;
      next_ += last ? 0 : 1;
    }
  }

  [[nodiscard]] const Vec3& position() const { return position_; }

 private:
  void step(const ImuSample& u, Mat3& R, double dt)
  {
    const Vec3 rotation = dt * (u.gyro - prior_.gyro_bias);
    const Vec3 force = R * expSO3(0.5 * rotation) * (u.accel - prior_.accel_bias);
    position_ += dt * velocity_ + 0.5 * dt * dt * force;
    velocity_ += dt * force;
    R = R * expSO3(rotation);
  }

  const std::vector<ImuSample>& inputs_;
  const MotionFitPrior& prior_;
  std::size_t next_ = 0;
  Vec3 velocity_ = Vec3::Zero(), position_ = Vec3::Zero();
};

/** Normal equations of weighted rows. */
struct Normal
{
  Square9 N = Square9::Zero();
  Vector9 n = Vector9::Zero();

  void addPosition(double t, const Vec3& seen, double weight)
  {
    Eigen::Matrix<double, 3, kUnknowns> H;
    H << Mat3::Identity(), t * Mat3::Identity(), 0.5 * t * t * Mat3::Identity();
    N.noalias() += weight * H.transpose() * H;
    n.noalias() += weight * H.transpose() * seen;
  }

  /** The magnitude of gravity, linear about its direction. */
  void addMagnitude(const Vec3& direction, double magnitude, double weight)
  {
    N.bottomRightCorner<3, 3>() += weight * direction * direction.transpose();
    n.tail<3>() += weight * magnitude * direction;
  }
};
}  // namespace

MotionFit fitMotion(
    const std::vector<StampedPose>& poses, const std::vector<ImuSample>& inputs,
    const MotionFitPrior& prior)
{
  constexpr int kIterations = 5;  // of the magnitude's linearisation
  MotionFit fit;
  if (poses.size() < kMinPoses) return fit;
  ForceIntegral force(inputs, prior);
  Normal positions;
  for (std::size_t k = 1; k < poses.size(); ++k)
  {
    force.advance(poses[k - 1], poses[k].stamp_ns);
    const double t = toSeconds(poses[k].stamp_ns - poses[0].stamp_ns);
    positions.addPosition(
        t, poses[k].T_world_body.p - force.position(), std::pow(prior.position_std, -2));
  }
  fit.g = prior.g;
  for (int i = 0; i < kIterations; ++i)
  {
    Normal normal = positions;
    normal.addMagnitude(
        fit.g.normalized(), prior.g.norm(), std::pow(std::max(prior.gravity_std, 1e-3), -2));
    const Vector9 solution = normal.N.ldlt().solve(normal.n);
    fit.velocity = solution.segment<3>(3);
    fit.g = solution.tail<3>();
  }
  fit.solved = fit.velocity.allFinite() && fit.g.allFinite();
  return fit;
}

}  // namespace fastlio
