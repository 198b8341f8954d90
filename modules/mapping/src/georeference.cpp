// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/earth/las_writer.h>
#include <fastlio/mapping/georeference.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
/** The projection around a point of the map, to first order: exact to a millimetre within a tile.
 */
class LocalProjection
{
 public:
  LocalProjection(
      const ReferenceSystem& system, const LocalFrame& frame, const Pose& T_enu_map,
      const Vec3& center)
      : center_(center)
  {
    constexpr double kStep = 25.0;  // [m]
    const auto projected = [&](const Vec3& p) { return system.projectedOf(frame, T_enu_map * p); };
    at_center_ = projected(center);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vec3 step = kStep * Vec3::Unit(axis);
      J_.col(axis) = (projected(center + step) - projected(center - step)) / (2.0 * kStep);
    }
  }

  [[nodiscard]] Vec3 operator()(const Vec3& map) const { return at_center_ + J_ * (map - center_); }

 private:
  Vec3 center_, at_center_;
  Mat3 J_;
};

Vec3 pointOf(const OutputPoints& points, std::size_t i, const Vec3& origin)
{
  return origin + Vec3(
                      static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
                      static_cast<double>(points.z[i]));
}

Vec3 middleOf(const OutputPoints& points, const Vec3& origin)
{
  Vec3 low = Vec3::Constant(1e12), high = Vec3::Constant(-1e12);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p = pointOf(points, i, origin);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return 0.5 * (low + high);
}

/** To sixteen bits: sensors give 0 to 1 or 0 to 255 or more. */
double intensityScale(const OutputMap& map)
{
  float greatest = 0.0F;
  map.forEachTile(
      [&greatest](const OutputPoints& points)
      {
        for (const float intensity : points.intensity)
          if (std::isfinite(intensity)) greatest = std::max(greatest, intensity);
      });
  constexpr double kMost16 = 65535.0;
  return greatest > 0.0F ? (greatest <= 1.0F ? kMost16 : greatest <= 255.0F ? 256.0 : 1.0) : 1.0;
}
}  // namespace

std::optional<Georeference> georeference(
    const GnssOutcome& gnss, const std::string& control_points, const std::string& crs)
{
  std::optional<ReferenceSystem> system;
  if (!crs.empty()) system.emplace(crs);
  Georeference place;
  if (!control_points.empty())
  {
    const std::vector<ControlPoint> points =
        readControlPoints(control_points, system ? &*system : nullptr);
    if (points.empty()) throw std::runtime_error("'" + control_points + "' has no control point");
    place.source = "control points";
    place.datum = points.front().place;
    const EarthFit fit = fitToEarth(correspondencesIn(LocalFrame(place.datum), points));
    place.T_enu_map = fit.T_enu_map;
    place.residuals = fit.residuals;
    place.rms_m = fit.rms_m;
  }
  else if (gnss.used)
  {
    place.source = "GNSS";
    place.datum = gnss.datum;
    place.T_enu_map = gnss.T_enu_world;
  }
  else
    return std::nullopt;
  place.crs = crs.empty() ? utmCodeAt(place.datum) : crs;
  return place;
}

OutputFile writeLasMap(
    const std::string& path, const OutputMap& map, const std::optional<Georeference>& place)
{
  LasOptions options;
  options.intensity_scale = intensityScale(map);
  std::optional<ReferenceSystem> system;
  std::optional<LocalFrame> frame;
  if (place)
  {
    system.emplace(place->crs);
    frame.emplace(place->datum);
    options.wkt = system->wkt(WktDialect::Wkt1);
  }
  LasWriter file(path, options);
  map.forEachTile(
      [&](const OutputPoints& points)
      {
        std::optional<LocalProjection> projection;
        if (place)
          projection.emplace(*system, *frame, place->T_enu_map, middleOf(points, map.origin()));
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          const Vec3 p = pointOf(points, i, map.origin());
          file.add({projection ? (*projection)(p) : p, points.intensity[i], points.stamp_ns[i]});
        }
      });
  return file.commit();
}

}  // namespace fastlio
