// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file surface_map.h The map as the filter uses it: planes for points (eq. 12-14), growth (eq.
 * 21) and bounded memory. */
#pragma once

#include <fastlio/math/pose.h>
#include <fastlio/math/so3.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace mrpt::maps
{
class CSimplePointsMap;
}  // namespace mrpt::maps

namespace fastlio
{
/** Points in the world frame as columns of equal length [m]. */
struct WorldPoints
{
  std::vector<float> x, y, z;

  [[nodiscard]] std::size_t size() const { return x.size(); }
  void resize(std::size_t n);
  void add(float px, float py, float pz)
  {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
  }
  void add(const Vec3& p)
  {
    add(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  }
};

/** A plane of the map near a point: the residual of eq. 12 is z = n . p + d. */
struct PlaneMatch
{
  float nx = 0, ny = 0, nz = 0;  //!< unit normal u, world frame
  float d = 0;                   //!< -u . q [m]
  float variance = -1;           //!< of the plane's offset at the point [m^2]; negative: no match
  float shared_variance = 0;     //!< part of variance that all points on the plane share [m^2]
  std::uint32_t plane = 0;       //!< which plane: points with the same number share its error
  /** Insertion (1, 2, ...) that created the plane, in the middle of those that gave it its first
   * points; 0: not known. */
  std::uint32_t created_insertion = 0;
  float normal_variance = 0;  //!< of the normal, summed over its two free directions [rad^2]

  [[nodiscard]] bool valid() const { return variance >= 0.0F; }
};

/** A map of surfaces. match() is const and may be called from several threads on disjoint ranges.
 */
class SurfaceMap
{
 public:
  virtual ~SurfaceMap() = default;

  /** Finds the plane for each of the points [first, last); writes matches[first..last). The beams
   * come from \a sensor_origin (world frame): planes that were seen from the other side only are
   * other surfaces, where the map knows it. */
  virtual void match(
      const WorldPoints& points, const Vec3& sensor_origin, std::size_t first, std::size_t last,
      std::vector<PlaneMatch>& matches) const = 0;

  /** The same for points that have moved a little since their matches were found. Where the map
   * would look at the same planes again, the match may stay. \param before where they were */
  virtual void rematch(
      const WorldPoints& before, const WorldPoints& points, const Vec3& sensor_origin,
      std::size_t first, std::size_t last, std::vector<PlaneMatch>& matches) const;

  /** Adds the points of a scan (eq. 21), measured from \a sensor_origin (world frame). */
  virtual void insert(const WorldPoints& points, const Vec3& sensor_origin) = 0;

  /** The same where the attitude of the sensor is known, too. A map may take less from scans of a
   * sensor that does not move: each beam meets the surfaces where it met them before. */
  virtual void insertFrom(const WorldPoints& points, const Pose& T_world_sensor)
  {
    insert(points, T_world_sensor.p);
  }

  /** Drops what lies farther than \a radius [m] from \a center; may keep a margin beyond. */
  virtual void removeOutside(const Vec3& center, double radius) = 0;

  /** Insertions so far, which PlaneMatch::created_insertion counts; 0 for maps that do not count.
   */
  [[nodiscard]] virtual std::uint32_t insertionCount() const { return 0; }

  /** Its created_insertion shows which matches share a plane's error. Where it does not, the
   * filter takes their errors for independent and is too sure of directions that only the map's
   * planes constrain.
   */
  [[nodiscard]] virtual bool knowsSharedErrors() const { return false; }

  /** Number of points held. */
  [[nodiscard]] virtual std::size_t pointCount() const = 0;

  /** The points as an MRPT map: a copy, safe to keep. */
  [[nodiscard]] virtual std::shared_ptr<mrpt::maps::CSimplePointsMap> toPointsMap() const = 0;
};

}  // namespace fastlio
