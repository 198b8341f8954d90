// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/health/paired_vectors.h>

namespace fastlio
{
namespace
{
constexpr double kFewestPairs = 90.0;
// Of the sums, per pair: the pose of the LiDAR in use may be estimated along the way, so that what
// was seen a minute ago counts less.
constexpr double kForgetting = 0.998;
}  // namespace

void PairedVectors::Sums::add(const Vec3& vector)
{
  sum = kForgetting * sum + vector;
  squares = kForgetting * squares + vector.squaredNorm();
}

double PairedVectors::Sums::centred(double count) const
{
  return squares - sum.squaredNorm() / count;
}

void PairedVectors::add(const Vec3& scans, const Vec3& inertial)
{
  scans_.add(scans);
  inertial_.add(inertial);
  products_ = kForgetting * products_ + scans * inertial.transpose();
  lag_product_ = kForgetting * lag_product_ + inertial.dot(inertial - last_inertial_);
  last_inertial_ = inertial;
  count_ = kForgetting * count_ + 1.0;
}

bool PairedVectors::enough() const
{
  return count_ >= kFewestPairs;
}

Mat3 PairedVectors::products() const
{
  return products_ - scans_.sum * inertial_.sum.transpose() / count_;
}

}  // namespace fastlio
