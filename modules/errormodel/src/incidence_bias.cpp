// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/incidence_bias.h>

#include <Eigen/Cholesky>

#include <cmath>

namespace fastlio
{
double incidenceShape(double cosine)
{
  constexpr double kCos80 = 0.17364817766693036;
  return (1.0 - cosine) / (1.0 - kCos80);
}

void IncidenceBias::add(std::uint32_t plane, double along, const PointMeasurement& point)
{
  if (plane >= planes_.size()) planes_.resize(plane + plane / 2 + 1);
  Plane& seen = planes_[plane];
  const double cosine = std::abs(along);
  // Away from the sensor, whichever way the normal points.
  const double away = along < 0.0 ? -point.z : point.z;
  const double shift = cosine * incidenceShape(cosine);
  const auto weight = static_cast<float>(point.weight);
  if (seen.weight > 0.0F)
  {
    const double difference = shift - static_cast<double>(seen.mean);
    scan_.information += point.weight * difference * difference;
    scan_.weighted += point.weight * difference * away;
    pull_ += (along < 0.0 ? -difference : difference) * point.weighted_h;
  }
  seen.weight += weight;
  seen.mean += (static_cast<float>(shift) - seen.mean) * weight / seen.weight;
}

void IncidenceBias::finishScan(const Matrix6& information)
{
  // The pose has taken up what looks like a motion.
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> ldlt(information);
  if (ldlt.info() == Eigen::Success && ldlt.vectorD().minCoeff() > 0.0)
  {
    const Eigen::Matrix<double, 6, 1> pull = pull_;
    sums_.information += scan_.information - pull.dot(ldlt.solve(pull));
    sums_.weighted += scan_.weighted;
  }
  scan_ = {};
  pull_.setZero();
}

}  // namespace fastlio
