// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gnss.h Positions of a satellite receiver, and what they say about a map. */
#pragma once

#include <fastlio/earth/earth_fit.h>
#include <fastlio/earth/local_frame.h>
#include <fastlio/loops/mapper.h>
#include <fastlio/run/pose_track.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
struct FixesInGraph;

/** Standard deviations of a position [m]. */
struct GnssStd
{
  double horizontal = 0.0;  //!< to the east and to the north, each
  double vertical = 0.0;
};

/** No receiver knows its place better, whatever it states, and residuals that are smaller by chance
 * do not show that it does. */
inline constexpr GnssStd kLeastGnssStd{0.005, 0.01};

/** A position as a receiver gave it. */
struct GnssFix
{
  std::int64_t stamp_ns = 0;
  GeodeticPoint place;          //!< of the antenna
  double horizontal_std = 0.0;  //!< by the receiver's own account [m]
  double vertical_std = 0.0;    //!< likewise [m]
  Vec3 antenna = Vec3::Zero();  //!< in the IMU frame [m]
  /** Where the receiver states standard deviations of its own: those that fixes of this quality
   * usually have. They count where the stated ones turn out to be too small. */
  std::optional<GnssStd> usual = {};
};

/** What the map and the fixes say about each other. */
struct GnssOutcome
{
  bool used = false;
  std::string reason;                               //!< why not
  GeodeticPoint datum;                              //!< origin of the East-North-Up frame
  Pose T_enu_world;                                 //!< of the map
  std::size_t fixes = 0;                            //!< at poses of the runs
  std::size_t rejected = 0;                         //!< that contradict the others
  double horizontal_std = 0.0, vertical_std = 0.0;  //!< of a typical fix, by what is left over [m]
  double correlation = 0.0;                         //!< of errors that follow each other
};

/** What came of it, for people. */
[[nodiscard]] std::string gnssSentence(const GnssOutcome& outcome);

/** The fixes of all sessions as positions in a graph. */
class GnssFactors
{
 public:
  /** Takes in the fixes of a session. \param track of the IMU by the odometry \param submaps with
   * the session's, for PositionFactor::node */
  void add(
      const std::vector<GnssFix>& fixes, const PoseTrack& track, std::size_t session,
      const Mapper& mapper);

  /** Adds them to the graph of a map and optimises it: first with the receiver's standard
   * deviations, then with those that the first optimum shows, and with the correlation of errors in
   * time. Where receivers state the noise of each fix, its size comes from the first optimum, too,
   * and only the relation of the fixes to each other from them. Where a tenth of the fixes do not
   * agree with what is stated, they count as fixes of their quality usually do. Either leaves fixes
   * out that contradict the others. The result stays as it is where too few of the fixes agree. */
  [[nodiscard]] GnssOutcome applyTo(MappingResult& result) const;

 private:
  struct Sighting
  {
    PositionFactor factor;  //!< its covariance is not set
    std::int64_t stamp_ns = 0;
    Vec3 std = Vec3::Zero();  //!< by the receiver's account [m]
    std::optional<Vec3> usual;
  };
  /** The graph of a map with the sightings as its positions; nothing is estimated yet.
   * \param at_least_usual stated standard deviations are not smaller than usual ones */
  [[nodiscard]] FixesInGraph fixesIn(const MappingResult& result, bool at_least_usual) const;

  std::vector<Sighting> sightings_;
  std::optional<LocalFrame> frame_;
};

}  // namespace fastlio
