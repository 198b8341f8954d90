// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "proj_objects.h"
#include <fastlio/earth/reference_system.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
constexpr std::size_t kLongestDefinition = 65536;  // WKT of the largest systems has some kilobytes

/** PROJ would write to the standard error; the last message explains a failure. */
void keepMessage(void* text, int /*level*/, const char* message)
{
  *static_cast<std::string*>(text) = message;
}

std::string placeText(const GeodeticPoint& point)
{
  return "latitude " + shortestText(point.latitude_deg) + ", longitude " +
         shortestText(point.longitude_deg) + ", height " + shortestText(point.height_m);
}

bool isFinite(const PJ_COORD& coordinates)
{
  return std::isfinite(coordinates.xyz.x) && std::isfinite(coordinates.xyz.y) &&
         std::isfinite(coordinates.xyz.z);
}

/** A PROJ string is a projection; with "+type=crs" it is a reference system. */
std::string asSystem(const std::string& definition)
{
  const bool is_proj_string = definition.find("+proj=") != std::string::npos;
  const bool has_type = definition.find("+type=crs") != std::string::npos;
  return is_proj_string && !has_type ? definition + " +type=crs" : definition;
}

/** Is there a transformation whose grids are all here? PROJ 9.6 makes one without its grid, too,
 * which fails at every place. */
bool isReachable(PJ_CONTEXT* context, const PJ* from, const PJ* to)
{
  const ProjOperations how(proj_create_operation_factory_context(context, nullptr));
  if (!how) return false;
  proj_operation_factory_context_set_allow_ballpark_transformations(context, how.get(), 0);
  proj_operation_factory_context_set_spatial_criterion(
      context, how.get(), PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
  proj_operation_factory_context_set_grid_availability_use(
      context, how.get(), PROJ_GRID_AVAILABILITY_DISCARD_OPERATION_IF_MISSING_GRID);
  const ProjList found(proj_create_operations(context, from, to, how.get()));
  return found && proj_list_get_count(found.get()) > 0;
}
}  // namespace

struct ReferenceSystem::Proj
{
  std::string message;  //!< PROJ's last one; outlives the context, which knows its address
  ProjContext context;
  ProjObject system;
  ProjObject plane;       //!< the projected part of the system
  ProjObject heights;     //!< the vertical part of a compound system
  ProjObject from_wgs84;  //!< longitude, latitude [deg], height to easting, northing, height
  bool has_heights = false;

  Proj();
  void open(const std::string& definition);
  void requireMetresEastNorthUp(const PJ* part, const std::string& definition);
  void connect(const std::string& definition);
  ProjObject projectedPartOf(const PJ* object);
  [[nodiscard]] std::string reason() const
  {
    return message.empty() ? "" : " (PROJ says: " + printable(message) + ")";
  }
};

ReferenceSystem::Proj::Proj() : context(proj_context_create())
{
  if (!context) throw std::runtime_error("PROJ cannot start: no memory");
  proj_log_func(context.get(), &message, &keepMessage);
  proj_log_level(context.get(), PJ_LOG_ERROR);
  proj_context_set_enable_network(context.get(), 0);
  if (proj_context_get_database_path(context.get()) == nullptr)
    throw std::runtime_error(
        "PROJ does not find its database proj.db" + reason() +
        "; install Debian's package proj-data, or let the environment variable PROJ_LIB (from "
        "PROJ 9.1 on also PROJ_DATA) name the folder that holds it");
}

void ReferenceSystem::Proj::open(const std::string& definition)
{
  system.reset(proj_create(context.get(), asSystem(definition).c_str()));
  if (!system || proj_is_crs(system.get()) == 0)
    throw std::invalid_argument(
        "unknown coordinate reference system '" + printable(definition) + "'" + reason() +
        "; give a code like EPSG:32632 (https://epsg.org has them), utm, WKT or a PROJ string");
  plane = projectedPartOf(system.get());
  if (!plane)
    throw std::invalid_argument(
        "the coordinate reference system '" + printable(definition) + "' (" +
        proj_get_name(system.get()) +
        ") is not projected: it has no eastings and northings in metres; give a projected one, "
        "like utm");
}

ProjObject ReferenceSystem::Proj::projectedPartOf(const PJ* object)
{
  ProjObject part;
  switch (proj_get_type(object))
  {
    case PJ_TYPE_PROJECTED_CRS:
      return ProjObject(proj_clone(context.get(), object));
    case PJ_TYPE_BOUND_CRS:
      part.reset(proj_get_source_crs(context.get(), object));
      break;
    case PJ_TYPE_COMPOUND_CRS:
      has_heights = true;
      heights.reset(proj_crs_get_sub_crs(context.get(), object, 1));
      if (heights && proj_get_type(heights.get()) == PJ_TYPE_BOUND_CRS)
        heights.reset(proj_get_source_crs(context.get(), heights.get()));
      part.reset(proj_crs_get_sub_crs(context.get(), object, 0));
      break;
    default:
      return nullptr;
  }
  return part ? projectedPartOf(part.get()) : nullptr;
}

void ReferenceSystem::Proj::requireMetresEastNorthUp(const PJ* part, const std::string& definition)
{
  const ProjObject axes(proj_crs_get_coordinate_system(context.get(), part));
  const int count = axes ? proj_cs_get_axis_count(context.get(), axes.get()) : 0;
  for (int i = 0; i < count; ++i)
  {
    const char *name = "", *direction = "", *unit = "";
    double metres = 0;
    proj_cs_get_axis_info(
        context.get(), axes.get(), i, &name, nullptr, &direction, &metres, &unit, nullptr, nullptr);
    const std::string axis = "the axis '" + std::string(name) + "' of '" + printable(definition) +
                             "' (" + proj_get_name(system.get()) + ")";
    if (metres != 1.0)
      throw std::invalid_argument(
          axis + " counts in '" + unit + "'; give a system in metres, like utm");
    const std::string_view to = direction;
    if (to == "west" || to == "down")
      throw std::invalid_argument(
          axis + " points " + direction + "; give a system with axes East, North and Up, like utm");
  }
  if (count == 3) has_heights = true;
}

void ReferenceSystem::Proj::connect(const std::string& definition)
{
  // WGS84 with or without height. Plane systems get none: their height stays that of WGS84.
  const ProjObject wgs84(proj_create(context.get(), has_heights ? "EPSG:4979" : "EPSG:4326"));
  // A transformation that leaves out a datum or a geoid whose grid is missing is off by metres.
  const std::array<const char*, 2> options = {"ALLOW_BALLPARK=NO", nullptr};
  ProjObject raw(
      wgs84 && isReachable(context.get(), wgs84.get(), system.get())
          ? proj_create_crs_to_crs_from_pj(
                context.get(), wgs84.get(), system.get(), nullptr, options.data())
          : nullptr);
  if (raw) from_wgs84.reset(proj_normalize_for_visualization(context.get(), raw.get()));
  if (!from_wgs84)
    throw std::runtime_error(
        "PROJ knows no way from WGS84 to '" + printable(definition) + "' (" +
        proj_get_name(system.get()) + ")" + reason() +
        (has_heights
             ? "; a system with heights needs the grid of its geoid: install it (projsync, "
               "https://cdn.proj.org), or give the plane system alone"
             : "; install its grid (projsync, https://cdn.proj.org); where its datum may be "
               "taken as WGS84, give its projection as a PROJ string, like +proj=tmerc "
               "+lon_0=114 +x_0=500000 +datum=WGS84"));
}

ReferenceSystem::ReferenceSystem(const std::string& definition) : definition_(definition)
{
  if (definition.empty() || definition.size() > kLongestDefinition)
    throw std::invalid_argument(
        "a coordinate reference system of " + std::to_string(definition.size()) +
        " characters; give 1 to " + std::to_string(kLongestDefinition) + ", like EPSG:32632");
  proj_ = std::make_unique<Proj>();
  proj_->open(definition_);
  proj_->requireMetresEastNorthUp(proj_->plane.get(), definition_);
  if (proj_->heights) proj_->requireMetresEastNorthUp(proj_->heights.get(), definition_);
  proj_->connect(definition_);
}

ReferenceSystem::~ReferenceSystem() = default;
ReferenceSystem::ReferenceSystem(ReferenceSystem&& other) noexcept = default;
ReferenceSystem& ReferenceSystem::operator=(ReferenceSystem&& other) noexcept = default;

Vec3 ReferenceSystem::projectedOf(const GeodeticPoint& point) const
{
  proj_->message.clear();
  const double height = proj_->has_heights ? point.height_m : 0.0;
  const PJ_COORD there = proj_trans(
      proj_->from_wgs84.get(), PJ_FWD,
      proj_coord(point.longitude_deg, point.latitude_deg, height, HUGE_VAL));
  if (!isFinite(there))
    throw std::runtime_error(
        "'" + printable(definition_) + "' has no coordinates for " + placeText(point) +
        proj_->reason() + "; give a system that covers the place, like utm");
  return {there.xyz.x, there.xyz.y, proj_->has_heights ? there.xyz.z : point.height_m};
}

Vec3 ReferenceSystem::projectedOf(const LocalFrame& frame, const Vec3& enu) const
{
  return projectedOf(frame.geodeticOf(enu));
}

GeodeticPoint ReferenceSystem::geodeticOf(const Vec3& projected) const
{
  proj_->message.clear();
  const double height = proj_->has_heights ? projected.z() : 0.0;
  const PJ_COORD there = proj_trans(
      proj_->from_wgs84.get(), PJ_INV, proj_coord(projected.x(), projected.y(), height, HUGE_VAL));
  const GeodeticPoint point{
      there.xyz.y, there.xyz.x, proj_->has_heights ? there.xyz.z : projected.z()};
  if (!isFinite(there) || problemOf(point) != nullptr)
    throw std::runtime_error(
        "no place on the earth has easting " + shortestText(projected.x()) + ", northing " +
        shortestText(projected.y()) + ", height " + shortestText(projected.z()) + " in '" +
        printable(definition_) + "'" + proj_->reason() +
        "; check the order of the coordinates and the system");
  return point;
}

std::string ReferenceSystem::wkt() const
{
  proj_->message.clear();
  const std::array<const char*, 2> options = {"MULTILINE=NO", nullptr};
  const char* text =
      proj_as_wkt(proj_->context.get(), proj_->system.get(), PJ_WKT1_GDAL, options.data());
  if (text == nullptr)
    throw std::runtime_error(
        "'" + printable(definition_) + "' cannot be written as WKT" + proj_->reason() +
        "; give a plane system, like utm");
  return text;
}

}  // namespace fastlio
