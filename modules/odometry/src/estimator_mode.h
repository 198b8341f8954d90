// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file estimator_mode.h What the estimator does with the next scan. */
#pragma once

#include <fastlio/initialization/motion_window.h>
#include <fastlio/localmap/outage_search.h>
#include <fastlio/matching/pose_search.h>
#include <fastlio/math/pose.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

namespace fastlio
{
/** The filter has no state yet, or none any more. */
struct Initializing
{
  std::optional<Pose> T_map_imu;  //!< about where the run begins in a given map
};

/** A search of the map that found nothing: the next one waits. */
struct SearchPause
{
  std::int64_t until_ns = 0;
  std::optional<PoseSearchResult> last;  //!< what it said
};

/** What every mode of a running filter knows. */
struct FilterRun
{
  std::int64_t last_update_ns = 0;            //!< a scan last corrected the state convincingly
  std::int64_t last_seen_ns = 0;              //!< a scan last had points enough to be matched
  bool consistent = true;                     //!< the latest match was as usual with this map
  bool trusted = true;                        //!< the latest scan left a pose to be believed
  std::optional<MotionWindow> motion_window;  //!< after a start in motion
  SearchPause search_pause;

  /** Is this a pass that computes a start? */
  [[nodiscard]] bool isTrial() const { return motion_window && motion_window->trial; }

  /** Is a scan that ends then one of those from which a start in motion was computed? */
  [[nodiscard]] bool startingAt(std::int64_t end_ns) const
  {
    return motion_window && end_ns <= motion_window->end_ns;
  }

  /** Does a scan that ends then correct what a start in motion did not know yet? */
  [[nodiscard]] bool settlingAt(std::int64_t end_ns) const
  {
    return motion_window && end_ns <= motion_window->settled_ns;
  }
};

/** The filter runs, and searches for its pose in a given map. */
struct EnteringMap
{
  FilterRun run;
  Pose T_map_imu;
};

/** Each scan is matched with the map where the prediction puts it. */
struct Tracking
{
  FilterRun run;
  bool searching = false;  //!< the pose is searched within the prediction's uncertainty
  std::unique_ptr<OutageSearch> outage;  //!< of the LiDAR, that the search follows
  bool lost = false;                     //!< nothing was found, and a new map would be tilted
};

/** The filter was re-initialised with a carried pose and searches for the map of before. */
struct Relocalizing
{
  FilterRun run;
  std::int64_t give_up_ns = 0;  //!< a scan that ends later begins a new map
};

using Mode = std::variant<Initializing, EnteringMap, Tracking, Relocalizing>;

}  // namespace fastlio
