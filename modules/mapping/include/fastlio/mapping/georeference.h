// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file georeference.h Where a map is on the earth, by GNSS or by control points, and its points in
 * the coordinates of surveyors. */
#pragma once

#include <fastlio/aiding/gnss.h>
#include <fastlio/earth/control_points.h>
#include <fastlio/earth/reference_system.h>
#include <fastlio/files/atomic_file.h>
#include <fastlio/run/output_map.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** The place of a map. */
struct Georeference
{
  std::string source;  //!< "GNSS" or "control points"
  GeodeticPoint datum;
  Pose T_enu_map;
  std::string crs;                       //!< of projected coordinates: as given, or the UTM zone
  std::vector<EarthResidual> residuals;  //!< of control points
  double rms_m = 0.0;                    //!< of them
};

/** By control points, or else by GNSS; nothing when neither gives the place, and where
 * unplacedReason() says so.
 * \param crs of projected coordinates; empty or "utm": the UTM zone of the place
 * \exception std::runtime_error the control points cannot be used
 * \exception std::invalid_argument the reference system is unknown, or the control points lie
 * beyond the UTM zones */
[[nodiscard]] std::optional<Georeference> georeference(
    const GnssOutcome& gnss, const std::string& control_points, const std::string& crs);

/** Why a map without control points has no place: its GNSS lies beyond the UTM zones, and \a crs
 * names nothing else; or there is none, although \a crs asks for it. In a sentence; empty: it has
 * one, or nobody asked. */
[[nodiscard]] std::string unplacedReason(const GnssOutcome& gnss, const std::string& crs);

/** How well the control points fit, and which were left out, in a sentence. Empty without any. */
[[nodiscard]] std::string controlPointSentence(const Georeference& place);

/** Writes the points of a map as LAS 1.4: in projected coordinates, or in those of the map where
 * its place is not known. \exception std::runtime_error the file cannot be written */
OutputFile writeLasMap(
    const std::string& path, const OutputMap& map, const std::optional<Georeference>& place);

}  // namespace fastlio
