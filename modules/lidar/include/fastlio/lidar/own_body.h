// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file own_body.h Returns of what moves with the LiDAR: the person who carries it, a mast, a roof
 * rack. In the map they leave a trail. */
#pragma once

#include <fastlio/lidar/scan.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace fastlio
{
/** Directions from the LiDAR in cells: the faces of a cube, 32 by 32 cells each, so that no cell
 * needs an angle. A cell is 2.8 deg wide in the middle of a face. */
class DirectionCells
{
 public:
  static constexpr int kPerEdge = 32;
  static constexpr std::size_t kCount = std::size_t{6} * kPerEdge * kPerEdge;

  /** \param x, y, z not all zero */
  [[nodiscard]] static std::size_t of(float x, float y, float z);
  /** Unit vector to the middle of a cell. */
  [[nodiscard]] static Vec3 middle(std::size_t cell);
  /** The cells around the direction of \a cell, itself first; some may be the same. */
  [[nodiscard]] static std::array<std::size_t, 9> around(std::size_t cell);
};

/** Where a body is, LiDAR frame. */
struct OwnBodyPlace
{
  double nearest = 0.0, farthest = 0.0;  //!< ranges [m]
  double azimuth = 0.0;                  //!< of its middle, from x towards y [rad]
};

/** Finds and masks such returns.
 *
 * Two things have to come together. A near return stays at the same place in the LiDAR frame while
 * the LiDAR moves; so do a wall along which it moves, and the ground. And the place in the world
 * where that return was is empty later: beams pass through it, as they do through no wall. A LiDAR
 * that stands still, or never turns, shows neither. */
class OwnBody
{
 public:
  /** Looks at a scan, when the LiDAR has moved enough since the last one that was looked at; before
   * mask(). \param points LiDAR frame */
  void look(const PointColumns& points);
  /** Removes the points on the body. \return how many */
  std::size_t mask(PointColumns& points) const;
  /** The scan that look() saw last has a pose. \param tracked it was matched with the map */
  void judge(const Pose& T_world_lidar, bool tracked);

  [[nodiscard]] bool found() const { return !body_.empty(); }
  /** Where it is: once, when no more of it has been found for a while, else nothing. */
  [[nodiscard]] std::optional<OwnBodyPlace> takeReport();

 private:
  /** What the near returns in a cell have shown. */
  struct Cell
  {
    float range = 0.0F;         // mean [m]
    int same = 0, other = 0;    // scans with a return there, and with one elsewhere
    int empty = 0, filled = 0;  // places where it has been, as seen later
    bool waits = false;         // for `place` to be seen from elsewhere
    bool body = false;
    Vec3 place = Vec3::Zero(), seen_from = Vec3::Zero();  // world [m]
  };
  /** Of an earlier place of a return. */
  enum class Sight
  {
    Hidden,
    Empty,
    Filled
  };

  void judgeCells(const Pose& T_world_lidar);
  [[nodiscard]] static bool stays(const Cell& cell);
  [[nodiscard]] bool wasSeenEmpty(std::size_t index) const;
  void judgeRange(Cell& cell, float range) const;
  void judgePlace(Cell& cell, const Vec3& middle, const Pose& T_world_lidar) const;
  [[nodiscard]] Sight sightOf(const Vec3& in_lidar) const;
  void addToBody(std::size_t cell);

  bool due_ = true, looked_ = false;
  int scans_since_look_ = 0, looks_since_found_ = 0;
  bool reported_ = false;
  Pose looked_from_, before_;   // of the scan that was looked at, and of the last one
  std::vector<float> nearest_;  // range by cell; 0: no return
  std::vector<Cell> cells_;
  std::vector<float> body_range_;  // by cell, with the cells around; 0: none
  std::vector<std::size_t> body_;
};

}  // namespace fastlio
