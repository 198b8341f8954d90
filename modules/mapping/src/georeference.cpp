// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/earth/las_writer.h>
#include <fastlio/mapping/georeference.h>
#include <fastlio/math/columns.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace fastlio
{
namespace
{
/** The projection around a point of the map, to first order. */
class LocalProjection
{
 public:
  /** \param reach of the points that are meant, along each axis [m] */
  LocalProjection(
      const ReferenceSystem& system, const LocalFrame& frame, const Pose& T_enu_map,
      const Vec3& center, double reach)
      : center_(center)
  {
    const auto projected = [&](const Vec3& p) { return system.projectedOf(frame, T_enu_map * p); };
    at_center_ = projected(center);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vec3 step = reach * Vec3::Unit(axis);
      J_.col(axis) = (projected(center + step) - projected(center - step)) / (2.0 * reach);
    }
  }

  [[nodiscard]] Vec3 operator()(const Vec3& map) const { return at_center_ + J_ * (map - center_); }

 private:
  Vec3 center_, at_center_;
  Mat3 J_;
};

/** The projection of a map: a linear one in each cube of 50 m, where it is exact to a fraction of a
 * millimetre. The earth curves away by 0.04 m in 700 m, so that a large tile needs several. */
class MapProjection
{
 public:
  explicit MapProjection(const Georeference& place)
      : system_(place.crs), frame_(place.datum), T_enu_map_(place.T_enu_map)
  {
  }

  [[nodiscard]] std::string wkt() const { return system_.wkt(); }

  [[nodiscard]] Vec3 operator()(const Vec3& map)
  {
    constexpr double kHalf = 25.0;  // [m]
    const auto number = [](double x) { return static_cast<int>(std::floor(0.5 * x / kHalf)); };
    const Cube cube = {number(map.x()), number(map.y()), number(map.z())};
    auto found = cubes_.find(cube);
    if (found == cubes_.end())
    {
      const Vec3 corner = 2.0 * kHalf * Vec3(cube[0], cube[1], cube[2]);
      const LocalProjection around(
          system_, frame_, T_enu_map_, corner + Vec3::Constant(kHalf), kHalf);
      found = cubes_.emplace(cube, around).first;
    }
    return found->second(map);
  }

  /** Of cubes that nothing more is asked of. */
  void forget() { cubes_.clear(); }

 private:
  using Cube = std::array<int, 3>;

  ReferenceSystem system_;
  LocalFrame frame_;
  Pose T_enu_map_;
  std::map<Cube, LocalProjection> cubes_;
};

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

/** UTM has the zone of the place. */
bool isZoneOfPlace(const std::string& crs)
{
  return crs.empty() || crs == "utm" || crs == "UTM";
}
}  // namespace

std::string unplacedReason(const GnssOutcome& gnss, const std::string& crs)
{
  if (!gnss.used)
    return crs.empty() ? ""
                       : "the map stays in its own frame and --crs has no effect, as neither GNSS "
                         "nor control points give its place on the earth: give --control-points";
  if (!isZoneOfPlace(crs)) return {};
  try
  {
    (void)utmCodeAt(gnss.datum);
    return {};
  }
  catch (const std::invalid_argument& e)
  {
    return "the map stays in its own frame, although GNSS gives its place: " +
           std::string(e.what()) + " (--crs)";
  }
}

std::optional<Georeference> georeference(
    const GnssOutcome& gnss, const std::string& control_points, const std::string& crs)
{
  std::optional<ReferenceSystem> system;
  if (!isZoneOfPlace(crs)) system.emplace(crs);
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
  else if (gnss.used && unplacedReason(gnss, crs).empty())
  {
    place.source = "GNSS";
    place.datum = gnss.datum;
    place.T_enu_map = gnss.T_enu_world;
  }
  else
    return std::nullopt;
  place.crs = isZoneOfPlace(crs) ? utmCodeAt(place.datum) : crs;
  return place;
}

std::string controlPointSentence(const Georeference& place)
{
  if (place.residuals.empty()) return {};
  std::string left_out;
  std::size_t used = 0;
  for (const EarthResidual& residual : place.residuals)
    if (residual.is_used)
      ++used;
    else
      left_out += (left_out.empty() ? "; left out: " : ", ") + printable(residual.name) + " (" +
                  fixedText(residual.residual_m.norm(), 2) + " m off)";
  return "control points: " + std::to_string(used) + " of " +
         std::to_string(place.residuals.size()) + " agree, to " + fixedText(place.rms_m, 3) +
         " m (rms)" + left_out;
}

OutputFile writeLasMap(
    const std::string& path, const OutputMap& map, const std::optional<Georeference>& place)
{
  LasOptions options;
  options.intensity_scale = intensityScale(map);
  std::optional<MapProjection> projection;
  if (place)
  {
    projection.emplace(*place);
    options.wkt = projection->wkt();
  }
  LasWriter file(path, options);
  map.forEachTile(
      [&](const OutputPoints& points)
      {
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          const Vec3 p = map.origin() + pointAt(points, i);
          file.add({projection ? (*projection)(p) : p, points.intensity[i], points.stamp_ns[i]});
        }
        if (projection) projection->forget();
      });
  return file.commit();
}

}  // namespace fastlio
