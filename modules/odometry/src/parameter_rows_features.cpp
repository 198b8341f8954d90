// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_rows.h"
#include <fastlio/math/angles.h>

namespace fastlio
{
namespace
{
ParameterRows extractionRows()
{
  return {
      {"features.mode", "",
       enumeration([](auto& p) { return &p.features.mode; }, {"none", "planar", "planar_and_edge"}),
       "none: direct, any point that finds a plane; planar: only points where the scan line is "
       "smooth; planar_and_edge: also sharp bends of the scan line, matched with lines, as in the "
       "paper"},
      {"features.scan_lines", "",
       enumeration(
           [](auto& p) { return &p.features.scan_lines; },
           {"automatic", "ring", "elevation", "time"}),
       "which points are neighbours: those of one laser (ring field), of one elevation, or that "
       "follow each other in time; automatic: by what the scan has"},
      {"features.half_width", "m",
       RealValue{[](auto& p) { return &p.features.half_width; }, 0.01, 10.0},
       "neighbours reach so far to each side; larger: less noise, small structures are lost; "
       "should be 10 times the noise of a range or more"},
      {"features.min_neighbors", "",
       IntegerValue{[](auto& p) { return &p.features.min_neighbors; }, 1, 100},
       "so many neighbours on each side at least: far points are spaced more than half_width"},
      {"features.max_planar_smoothness", "",
       RealValue{[](auto& p) { return &p.features.max_planar_smoothness; }, 0.0, 1.0},
       "a point is planar when its distance from its neighbours' chord, over their mean distance, "
       "is below this"},
      {"features.min_edge_smoothness", "",
       RealValue{[](auto& p) { return &p.features.min_edge_smoothness; }, 0.0, 1.0},
       "a point is on an edge when the same figure is above this and the largest around; a right "
       "angle has up to 0.7"},
      {"features.max_beam_turn", "",
       RealValue{[](auto& p) { return &p.features.max_beam_turn; }, 0.0, 1.0},
       "no features where the same figure of the beams themselves is above this: there the laser "
       "turns, not the surface"},
  };
}

ParameterRows neighborRows()
{
  return {
      {"features.min_incidence", "deg",
       RealValue{[](auto& p) { return &p.features.min_incidence; }, 0.1, 80.0, kRadPerDeg},
       "no features on surfaces that the beam meets at a smaller angle; scan lines are cut where "
       "the range jumps more than such a surface would explain"},
      {"features.max_beam_gap", "deg",
       RealValue{[](auto& p) { return &p.features.max_beam_gap; }, 0.001, 90.0, kRadPerDeg},
       "scan lines are cut where beams lie farther apart; must exceed the sensor's step"},
      {"features.max_spacing", "m",
       RealValue{[](auto& p) { return &p.features.max_spacing; }, 0.01, 100.0},
       "scan lines are cut where points lie farther apart"},
      {"features.range_jump", "m",
       RealValue{[](auto& p) { return &p.features.range_jump; }, 0.0, 10.0},
       "a jump of the range that never cuts a scan line: several times the noise"},
  };
}

ParameterRows edgeRows()
{
  return {
      {"features.target_edges", "",
       IntegerValue{[](auto& p) { return &p.features.target_edges; }, 0, 1000000},
       "about so many edge points of a scan are used; 0: all"},
      {"features.edge_spacing", "m",
       RealValue{[](auto& p) { return &p.features.edge_spacing; }, 0.001, 10.0},
       "edge points nearer than this to one in the map of edges are not added"},
      {"features.max_edge_distance", "m",
       RealValue{[](auto& p) { return &p.features.max_edge_distance; }, 0.01, 100.0},
       "the five points that make a line may be this far from the point that is matched"},
      {"features.max_edge_scatter", "m",
       RealValue{[](auto& p) { return &p.features.max_edge_scatter; }, 0.001, 10.0},
       "points farther than this from their line make none"},
  };
}
}  // namespace

ParameterRows featureRows()
{
  ParameterRows all;
  for (const auto& rows : {extractionRows(), neighborRows(), edgeRows()})
    all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

}  // namespace fastlio
