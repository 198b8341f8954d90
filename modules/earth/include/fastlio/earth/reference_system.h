// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file reference_system.h Coordinates of surveyors: eastings, northings and heights, by PROJ. */
#pragma once

#include <fastlio/earth/local_frame.h>

#include <memory>
#include <string>

namespace fastlio
{
/** "EPSG:32632" for latitude 48, longitude 11: the zone of the Universal Transverse Mercator grid,
 * with the exceptions of Norway and Svalbard.
 * \exception std::invalid_argument no place on the earth, or beyond the grid (80 S to 84 N) */
[[nodiscard]] std::string utmCodeAt(const GeodeticPoint& point);

/** A projected coordinate reference system in metres, with axes East and North.
 *
 * Heights: a system of plane coordinates (EPSG:32632) leaves the height above the WGS84 ellipsoid
 * as it is. A compound system (EPSG:25832+7837) has heights of its own, above a geoid; PROJ needs
 * the grid of that geoid on the disk, and what it lacks is refused instead of approximated.
 *
 * An object serves one thread at a time (PROJ's context is inside); further threads make their own.
 * PROJ reads no network. */
class ReferenceSystem
{
 public:
  /** \param definition a code of an authority ("EPSG:32632", utmCodeAt()), a name that PROJ's
   * database knows, WKT, or a PROJ string ("+proj=tmerc ...")
   * \exception std::invalid_argument it is unknown, is not projected, or its axes are not metres
   * East, North and Up; the message says what to give instead
   * \exception std::runtime_error PROJ's database is missing, or a grid that the system needs */
  explicit ReferenceSystem(const std::string& definition);
  ~ReferenceSystem();
  ReferenceSystem(ReferenceSystem&& other) noexcept;
  ReferenceSystem& operator=(ReferenceSystem&& other) noexcept;
  ReferenceSystem(const ReferenceSystem&) = delete;
  ReferenceSystem& operator=(const ReferenceSystem&) = delete;

  /** Easting, northing, height [m].
   * \exception std::runtime_error the projection has no coordinates for this place */
  [[nodiscard]] Vec3 projectedOf(const GeodeticPoint& point) const;
  /** Of a point of a tangent frame: by the ellipsoid, thus with the curvature of the earth. */
  [[nodiscard]] Vec3 projectedOf(const LocalFrame& frame, const Vec3& enu) const;
  /** \exception std::runtime_error no place on the earth has these coordinates */
  [[nodiscard]] GeodeticPoint geodeticOf(const Vec3& projected) const;

  /** "Well-known text" in one line, which defines the meaning of coordinates for other programs:
   * OGC 01-009 as GDAL writes it, what LAS 1.4 asks for.
   * \exception std::runtime_error it cannot express the system */
  [[nodiscard]] std::string wkt() const;

 private:
  struct Proj;
  std::string definition_;
  std::unique_ptr<Proj> proj_;
};

}  // namespace fastlio
