// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/beam_corrections.h>
#include <fastlio/math/angles.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::size_t kColumns = 3;
constexpr float kLeastCosine = 0.05F;  // of the elevation: nearer the axis it has no direction
}  // namespace

double beamElevation(std::size_t bin)
{
  const double sine = (static_cast<double>(bin) + 0.5 - 0.5 * kBeamBins) / kBeamBinsPerUnit;
  return std::asin(std::clamp(sine, -1.0, 1.0));
}

BeamCorrections::BeamCorrections(const std::vector<double>& rows) : any_(!rows.empty())
{
  for (std::size_t i = 0; i + kColumns <= rows.size(); i += kColumns)
    set(beamBin(std::sin(kRadPerDeg * rows[i])), {rows[i + 1], kRadPerDeg * rows[i + 2], 0.0});
}

void BeamCorrections::set(std::size_t bin, const BeamOffset& offset)
{
  any_ = true;
  offsets_[bin] = {
      static_cast<float>(offset.range), static_cast<float>(offset.elevation),
      static_cast<float>(offset.azimuth)};
}

std::size_t BeamCorrections::apply(float& x, float& y, float& z) const
{
  const float level = std::sqrt(x * x + y * y), range = std::sqrt(level * level + z * z);
  if (!(range > 0.0F)) return 0;
  const std::size_t bin = beamBin(static_cast<double>(z / range));
  if (!any_ || !(level > kLeastCosine * range)) return bin;
  const Offset& offset = offsets_[bin];
  // Against the beam, and across it: p - dr d - de r u - da (-y, x, 0) with
  // u = (-z x, -z y, level^2) / (r level).
  const float shrink = 1.0F - offset.range / range + offset.elevation * z / level;
  z = z * (1.0F - offset.range / range) - offset.elevation * level;
  const float turned_x = x * shrink + offset.azimuth * y;
  y = y * shrink - offset.azimuth * x;
  x = turned_x;
  return bin;
}

void BeamCorrections::apply(PointColumns& points) const
{
  if (!any_) return;
  for (std::size_t i = 0; i < points.size(); ++i)
    apply(points.x[i], points.y[i], points.z[i]);
}

}  // namespace fastlio
