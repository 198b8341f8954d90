// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/plane_voxel.h>

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
// Above this many points the sums are halved: old points fade, single precision stays exact enough.
constexpr float kMaxCount = 4096.0F;

double square(double x)
{
  return x * x;
}

/** A symmetric matrix. */
struct Symmetric
{
  double xx, xy, xz, yy, yz, zz;
};

/** Determinants of the 2 x 2 parts: the product of a and this is det(a) I. */
Symmetric adjugate(const Symmetric& a)
{
  return {a.yy * a.zz - a.yz * a.yz, a.xz * a.yz - a.xy * a.zz, a.xy * a.yz - a.xz * a.yy,
          a.xx * a.zz - a.xz * a.xz, a.xy * a.xz - a.xx * a.yz, a.xx * a.yy - a.xy * a.xy};
}

/** How points spread. */
struct Spread
{
  Symmetric scatter;           // mean square distances from the mean along the axes [m^2]
  double least, sum, product;  // least eigenvalue; sum and product of the two others
};

/** Newton's steps on the characteristic polynomial approach its least root from below. Where that
 * root is no more than 1/16 of the next one, as in any plane that passes, five steps are exact to
 * the last digits; elsewhere a root that is still too small is near enough to be refused. */
double leastRoot(double trace, double minors, double determinant)
{
  double x = 0.0;
  for (int step = 0; step < 5; ++step)
  {
    const double value = ((x - trace) * x + minors) * x - determinant;
    const double slope = (3.0 * x - 2.0 * trace) * x + minors;
    x -= value / std::max(slope, 1e-300);
  }
  return std::max(x, 0.0);
}

Spread spreadOf(const Symmetric& scatter)
{
  const Symmetric minors = adjugate(scatter);
  const double trace = scatter.xx + scatter.yy + scatter.zz;
  const double sum_of_minors = minors.xx + minors.yy + minors.zz;
  const double determinant =
      scatter.xx * minors.xx + scatter.xy * minors.xy + scatter.xz * minors.xz;
  const double least = leastRoot(trace, sum_of_minors, determinant);
  const double sum = trace - least;
  return {scatter, least, sum, sum_of_minors - least * sum};
}

/** The smaller one of the two large eigenvalues. */
double middleOf(const Spread& s)
{
  const double larger = 0.5 * (s.sum + std::sqrt(std::max(square(s.sum) - 4.0 * s.product, 0.0)));
  return larger > 0.0 ? s.product / larger : 0.0;
}

/** Direction of the least spread. The columns of the adjugate of (scatter - least I) are multiples
 * of it; the longest one is the most exact. */
Eigen::Vector3d normalOf(const Spread& s)
{
  const Symmetric& a = s.scatter;
  const Symmetric m = adjugate({a.xx - s.least, a.xy, a.xz, a.yy - s.least, a.yz, a.zz - s.least});
  Eigen::Vector3d n(m.xx, m.xy, m.xz);
  double longest = m.xx;
  if (m.yy > longest)
  {
    n = {m.xy, m.yy, m.yz};
    longest = m.yy;
  }
  if (m.zz > longest) n = {m.xz, m.yz, m.zz};
  const double length = n.norm();
  return length > 0.0 ? Eigen::Vector3d(n / length) : Eigen::Vector3d(0.0, 0.0, 1.0);
}

/** A normal, or its opposite, on the side that the beams come from. */
Eigen::Vector3d facing(const Eigen::Vector3f& beams, const Eigen::Vector3d& normal)
{
  return normal.dot(beams.cast<double>()) > 0.0 ? Eigen::Vector3d(-normal) : normal;
}

/** (e1 e1^T / l1 + e2 e2^T / l2) / count: the inverse of the scatter within the plane, which by
 * Cayley and Hamilton is (sum - scatter) / product there. */
std::array<float, 6> leverageOf(const Spread& s, const Eigen::Vector3d& n, double count)
{
  const double scale = 1.0 / (s.product * count), across = s.sum - s.least;
  const auto at = [&](double identity, double scatter, double normals)
  { return static_cast<float>(scale * (identity * s.sum - scatter - across * normals)); };
  const Symmetric& a = s.scatter;
  return {at(1.0, a.xx, n.x() * n.x()), at(0.0, a.xy, n.x() * n.y()), at(0.0, a.xz, n.x() * n.z()),
          at(1.0, a.yy, n.y() * n.y()), at(0.0, a.yz, n.y() * n.z()), at(1.0, a.zz, n.z() * n.z())};
}
}  // namespace

PlaneVoxel::Contents PlaneVoxel::contents() const
{
  return {plane_, count_, telling_count_, fitted_count_, sum_, products_, beams_};
}

void PlaneVoxel::setContents(const Contents& c)
{
  const VoxelPlane& p = c.plane;
  float all = p.nx + p.ny + p.nz + p.roughness + p.qx + p.qy + p.qz + p.variance + p.inverse_count;
  all += c.count + c.telling_count + c.fitted_count;
  for (const float number : p.leverage)
    all += number;
  for (const float number : c.products)
    all += number;
  for (std::size_t i = 0; i < c.sum.size(); ++i)
    all += c.sum[i] + c.beams[i];
  // One number that is not finite makes the sum so.
  if (!std::isfinite(all) || c.count < 1 || c.telling_count < 0 || c.fitted_count < 0)
    throw std::invalid_argument("PlaneVoxel: the sums of a voxel make no sense");
  plane_ = p;
  count_ = c.count;
  telling_count_ = c.telling_count;
  fitted_count_ = c.fitted_count;
  sum_ = c.sum;
  products_ = c.products;
  beams_ = c.beams;
  refit_pending_ = false;
  // In archives of version 0.1 a normal points anywhere.
  const Eigen::Vector3d normal = facing({c.beams[0], c.beams[1], c.beams[2]}, p.normal());
  plane_.nx = static_cast<float>(normal.x());
  plane_.ny = static_cast<float>(normal.y());
  plane_.nz = static_cast<float>(normal.z());
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
    telling_count_ *= 0.5F;
    for (float* sums : {sum_.data(), beams_.data(), products_.data(), products_.data() + 3})
      for (int i = 0; i < 3; ++i)
        sums[i] *= 0.5F;
  }
  if (plane_.created_insertion == 0) plane_.created_insertion = scan;
  const bool had_plane = plane_.inverse_count > 0.0F;
  fitted_count_ = count_;
  plane_.variance = -1;
  if (count_ < rules.min_points) return;

  const double n = count_, inverse = 1.0 / n;
  const Eigen::Vector3d mean = meanOffset().cast<double>();
  const auto about = [&](float sum, int i, int k) { return inverse * sum - mean[i] * mean[k]; };
  const auto& s = products_;
  const Spread spread = spreadOf(
      {about(s[0], 0, 0), about(s[1], 0, 1), about(s[2], 0, 2), about(s[3], 1, 1),
       about(s[4], 1, 2), about(s[5], 2, 2)});
  const double noise = square(static_cast<double>(rules.point_noise));
  const double thickest = square(static_cast<double>(rules.max_thickness));
  // Three degrees of freedom went into the fit.
  const double measured = spread.least * n / (n - 3.0);
  if (!(measured <= thickest)) return;
  if (middleOf(spread) < kMinSpreadOverNoise * std::max(measured, noise)) return;
  const Eigen::Vector3f beams(beams_[0], beams_[1], beams_[2]);
  const Eigen::Vector3d direction = facing(beams, normalOf(spread));
  const Eigen::Vector3f normal = direction.cast<float>();
  const auto incidence = static_cast<double>(-normal.dot(beams) / count_);
  // One laser line on a bent surface spans a plane of its own, which contains the beams.
  if (incidence < static_cast<double>(rules.min_incidence)) return;
  // Noise lies along the beams: little of it is left across a plane seen at a grazing angle.
  const double noise_across = noise * square(incidence);
  if (noise_across > thickest) return;
  const double across = std::max(measured, noise_across);

  const Eigen::Vector3f q = center + mean.cast<float>();
  plane_.nx = normal.x();
  plane_.ny = normal.y();
  plane_.nz = normal.z();
  plane_.qx = q.x();
  plane_.qy = q.y();
  plane_.qz = q.z();
  plane_.variance = static_cast<float>(across);
  plane_.roughness = static_cast<float>(across - noise_across);
  // A sensor that stands repeats the same beams. What lies between them, where others will meet the
  // surface later, it does not see.
  const float telling = std::max(telling_count_, 1.0F);
  plane_.inverse_count = 1.0F / telling;
  plane_.leverage = leverageOf(spread, direction, static_cast<double>(telling));
  // The points of the first plane are of the scans from the first one that met the voxel to this.
  if (!had_plane) plane_.created_insertion += (scan - plane_.created_insertion) / 2;
}

}  // namespace fastlio
