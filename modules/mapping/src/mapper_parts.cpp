// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mapper_parts.h"

namespace fastlio
{
Matrix6 carried(const Pose& a, const Matrix6& covariance, const RelativePose& motion)
{
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = motion.T_a_b.R.transpose();
  J.bottomLeftCorner<3, 3>() = -a.R * skew(motion.T_a_b.p);
  J.bottomRightCorner<3, 3>() = Mat3::Identity();
  Matrix6 K = Matrix6::Identity();
  K.bottomRightCorner<3, 3>() = a.R;
  return J * covariance * J.transpose() + K * motion.covariance * K.transpose();
}

void moved(const WorldPoints& points, const Vec3& origin, const Pose& motion, WorldPoints& result)
{
  result.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p =
        motion * (origin + Vec3(
                               static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
                               static_cast<double>(points.z[i])));
    result.x[i] = static_cast<float>(p.x());
    result.y[i] = static_cast<float>(p.y());
    result.z[i] = static_cast<float>(p.z());
  }
}

}  // namespace fastlio
