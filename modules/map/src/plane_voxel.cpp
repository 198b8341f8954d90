// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/plane_voxel.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
// The second largest spread must exceed the noise by this factor (of variances), or a line of
// points would pass as a plane whose normal is that line's noise.
constexpr double kMinSpreadOverNoise = 16.0;
// A plane is fitted anew when its points have grown by this factor.
constexpr float kRefitGrowth = 1.1F;
// Above this many points the sums are halved: old points fade, single precision stays exact enough.
constexpr float kMaxCount = 4096.0F;

double square(double x)
{
  return x * x;
}

struct Spread
{
  Eigen::Vector3d eigenvalues;   // ascending [m^2]
  Eigen::Matrix3d eigenvectors;  // columns
};

Spread spreadOf(const std::array<float, 6>& products, const Eigen::Vector3d& mean, double n)
{
  Eigen::Matrix3d scatter;
  const auto& s = products;
  scatter << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
  scatter = scatter / n - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

std::array<float, 6> leverageOf(const Spread& spread, double n)
{
  const Eigen::Vector3d e1 = spread.eigenvectors.col(1), e2 = spread.eigenvectors.col(2);
  const Eigen::Matrix3f m =
      ((e1 * e1.transpose() / spread.eigenvalues[1] + e2 * e2.transpose() / spread.eigenvalues[2]) /
       n)
          .cast<float>();
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}
}  // namespace

float VoxelPlane::offsetVariance(float x, float y, float z) const
{
  const float dx = x - qx, dy = y - qy, dz = z - qz;
  const auto& m = leverage;
  const float distance = dx * (m[0] * dx + 2 * (m[1] * dy + m[2] * dz)) +
                         dy * (m[3] * dy + 2 * m[4] * dz) + dz * m[5] * dz;
  return variance * (inverse_count + distance);
}

void PlaneVoxel::add(const Eigen::Vector3f& offset, const Eigen::Vector3f& beam)
{
  const float x = offset.x(), y = offset.y(), z = offset.z();
  count_ += 1;
  sum_ = {sum_[0] + x, sum_[1] + y, sum_[2] + z};
  beams_ = {beams_[0] + beam.x(), beams_[1] + beam.y(), beams_[2] + beam.z()};
  products_ = {products_[0] + x * x, products_[1] + x * y, products_[2] + x * z,
               products_[3] + y * y, products_[4] + y * z, products_[5] + z * z};
}

bool PlaneVoxel::claimRefit()
{
  if (refit_pending_ || count_ < kRefitGrowth * fitted_count_ + 1.0F) return false;
  refit_pending_ = true;
  return true;
}

PlaneVoxel::Contents PlaneVoxel::contents() const
{
  return {plane_, count_, fitted_count_, sum_, products_, beams_};
}

void PlaneVoxel::setContents(const Contents& c)
{
  const VoxelPlane& p = c.plane;
  float all = p.nx + p.ny + p.nz + p.roughness + p.qx + p.qy + p.qz + p.variance + p.inverse_count;
  all += c.count + c.fitted_count;
  for (const float number : p.leverage)
    all += number;
  for (const float number : c.products)
    all += number;
  for (std::size_t i = 0; i < c.sum.size(); ++i)
    all += c.sum[i] + c.beams[i];
  // One number that is not finite makes the sum so.
  if (!std::isfinite(all) || c.count < 1 || c.fitted_count < 0)
    throw std::invalid_argument("PlaneVoxel: the sums of a voxel make no sense");
  plane_ = p;
  count_ = c.count;
  fitted_count_ = c.fitted_count;
  sum_ = c.sum;
  products_ = c.products;
  beams_ = c.beams;
  refit_pending_ = false;
}

Eigen::Vector3f PlaneVoxel::meanOffset() const
{
  return Eigen::Vector3f(sum_[0], sum_[1], sum_[2]) / count_;
}

void PlaneVoxel::fit(const Eigen::Vector3f& center, const PlaneRules& rules, std::uint32_t scan)
{
  refit_pending_ = false;
  if (count_ > kMaxCount)
  {
    count_ *= 0.5F;
    for (float* sums : {sum_.data(), beams_.data(), products_.data(), products_.data() + 3})
      for (int i = 0; i < 3; ++i)
        sums[i] *= 0.5F;
  }
  fitted_count_ = count_;
  const bool was_valid = plane_.valid();
  plane_.variance = -1;
  if (count_ < rules.min_points) return;

  const double n = count_;
  const Eigen::Vector3d mean = meanOffset().cast<double>();
  const Spread spread = spreadOf(products_, mean, n);
  const Eigen::Vector3f normal = spread.eigenvectors.col(0).cast<float>();
  const Eigen::Vector3f beams(beams_[0], beams_[1], beams_[2]);
  const auto incidence = static_cast<double>(std::abs(normal.dot(beams)) / count_);
  // One laser line on a bent surface spans a plane of its own, which contains the beams.
  if (incidence < static_cast<double>(rules.min_incidence)) return;
  // Noise lies along the beams: little of it is left across a plane seen at a grazing angle. Three
  // degrees of freedom went into the fit.
  const double noise = square(static_cast<double>(rules.point_noise));
  const double noise_across = noise * square(incidence);
  const double across = std::max(spread.eigenvalues[0] * n / (n - 3.0), noise_across);
  if (across > square(static_cast<double>(rules.max_thickness))) return;
  if (spread.eigenvalues[1] < kMinSpreadOverNoise * std::max(across, noise)) return;

  const Eigen::Vector3f q = center + mean.cast<float>();
  plane_.nx = normal.x();
  plane_.ny = normal.y();
  plane_.nz = normal.z();
  plane_.qx = q.x();
  plane_.qy = q.y();
  plane_.qz = q.z();
  plane_.variance = static_cast<float>(across);
  plane_.roughness = static_cast<float>(across - noise_across);
  plane_.inverse_count = 1.0F / count_;
  plane_.leverage = leverageOf(spread, n);
  if (!was_valid && plane_.created_insertion == 0) plane_.created_insertion = scan;
}

}  // namespace fastlio
