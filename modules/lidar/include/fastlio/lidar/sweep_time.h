// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sweep_time.h Times for the points of a spinning LiDAR that recorded none: from their
 * azimuth. */
#pragma once

#include <fastlio/lidar/point_time.h>
#include <fastlio/lidar/scan.h>

#include <optional>
#include <string>

namespace fastlio
{
/** The treatment of clouds that have no time per point. */
enum class MissingPointTimes
{
  Auto,             //!< from the azimuth where the order of the points shows a revolution
  None,             //!< all points at the stamp, no motion compensation
  Clockwise,        //!< from the azimuth of a LiDAR that turns clockwise seen from above
  CounterClockwise  //!< ... counter-clockwise
};

/** How the points of a scan follow each other around the z axis. */
struct SweepShape
{
  bool spinning = false;     //!< the order shows in which sense the sensor turns
  int sense = 0;             //!< +1: counter-clockwise seen from above; -1: clockwise
  double start_azimuth = 0;  //!< of the first points [rad]
  double coverage = 0;       //!< fraction of the directions that have points, 0..1
  double agreement = 0;      //!< fraction of the steps that go the way of most, 0.5..1
};

/** Looks at the order of the points: column by column, or line by line. */
[[nodiscard]] SweepShape shapeOf(const PointColumns& points);

/** For people: "turns clockwise (97 % of the steps), starts at 179 deg, covers 100 %". */
[[nodiscard]] std::string describe(const SweepShape& shape);

/** A revolution, for points whose azimuth gives their time. */
struct SweepTiming
{
  int sense = 1;                        //!< as SweepShape
  std::optional<double> start_azimuth;  //!< [rad]; nothing: that of each scan's first points
  double period = 0.1;                  //!< of a revolution [s]
  /** What the stamps are: Start (also Stamp and Auto), Middle or End. */
  PointTimeReference reference = PointTimeReference::Start;
};

/** Replaces the time of every point by its fraction of the revolution. */
void assignSweepTimes(PointColumns& points, const SweepTiming& sweep);

}  // namespace fastlio
