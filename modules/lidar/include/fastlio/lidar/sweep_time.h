// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sweep_time.h Times for the points of a spinning LiDAR that recorded none: from their
 * azimuth. */
#pragma once

#include <fastlio/lidar/point_time.h>
#include <fastlio/lidar/scan.h>

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

/** Where a revolution begins whose points are in the order of their measurement [rad]; sense as in
 * SweepShape. Zero for an empty scan. */
[[nodiscard]] double startAzimuthOf(const PointColumns& points, int sense);

/** For people: "turns clockwise (97 % of the steps), starts at 179 deg, covers 100 %". */
[[nodiscard]] std::string describe(const SweepShape& shape);

/** Replaces the time of every point by its fraction of a revolution.
 * \param sense +1 counter-clockwise, -1 clockwise
 * \param start_azimuth where the revolution begins [rad]
 * \param period of a revolution [s]
 * \param reference what the scan's stamp is: Start (also Stamp and Auto), Middle or End */
void assignSweepTimes(
    PointColumns& points, int sense, double start_azimuth, double period,
    PointTimeReference reference);

}  // namespace fastlio
