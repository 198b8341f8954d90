// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file reinitialization.h When the run is re-initialised, and which pose it goes on with. */
#pragma once

#include <fastlio/initialization/carried_pose.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/interface/scan_result.h>

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace fastlio
{
/** The inertial data are interrupted, or were wrong before. */
struct InertialBreak
{
  std::int64_t begin_ns = 0, end_ns = 0;  //!< nothing is known in between
  bool new_map = false;                   //!< nothing before was right

  [[nodiscard]] double seconds() const;
};

/** Watches over the run. A re-initialisation is *pending* from the moment it is decided until
 * takeCarried(). */
class Reinitialization
{
 public:
  explicit Reinitialization(const OdometryOptions& options);

  void addBreak(const InertialBreak& gap) { breaks_.push_back(gap); }
  /** The oldest break, if the data of a scan that ends at \a end_ns reach too far beyond it to be
   * bridged. Forgets those that are over and were bridged, or that scans led through. */
  [[nodiscard]] std::optional<InertialBreak> breakBefore(std::int64_t end_ns);
  void dropBreak() { breaks_.pop_front(); }

  /** A break is to be crossed by re-initialising a run that has started. */
  [[nodiscard]] bool isNeededAt(const InertialBreak& gap) const;
  /** Decides on it. \param state the latest one \return why, in words */
  [[nodiscard]] std::string decideAt(const InertialBreak& gap, const FilterState& state);

  /** Decides on it when a pose stays lost although the scans see enough.
   * \param state after the scan \param relocalizing the map is searched for already
   * \param in_vain the map was searched, and nothing else is left
   * \return why, in words; nothing while the run goes on */
  [[nodiscard]] std::optional<std::string> detectTrackingLoss(
      const ScanResult& result, const FilterState& state, bool relocalizing, bool in_vain);

  /** Whether the run that has lost its pose goes on with its state, in a new map: as long as that
   * is known, it is better than a new start. Not twice in a row: the state may be wrong.
   * \param state_is_known the motion is */
  [[nodiscard]] bool goesOn(bool state_is_known);

  /** The pose of the run is another one now. */
  void forgetPoses()
  {
    last_good_.reset();
    lost_since_ns_ = 0;
  }

  [[nodiscard]] bool pending() const { return last_believed_.has_value(); }
  /** The last state that is believed, while a re-initialisation is pending. */
  [[nodiscard]] const NavState& believed() const { return last_believed_->state.x; }
  /** What the new start goes on with: nothing is known between the last state that is believed and
   * the start, however long that took. */
  [[nodiscard]] CarriedPose takeCarried(std::int64_t start_ns);

  /** The initialisation of a run that is interrupted: in whatever way is possible. */
  [[nodiscard]] static OdometryOptions startingAnyHow(OdometryOptions options);

 private:
  struct BelievedState
  {
    FilterState state;
    std::int64_t stamp_ns = 0;
    bool new_map = false;  //!< the map is not believed
  };

  void decide(const BelievedState& last);
  /** The pose is, in spite of the gap. */
  [[nodiscard]] std::int64_t knownUntil(const InertialBreak& gap) const;

  const OdometryOptions options_;
  std::deque<InertialBreak> breaks_;
  std::optional<BelievedState> last_believed_;  // while a re-initialisation is pending
  std::optional<FilterState> last_good_;        // of the latest scan that was tracked well
  std::int64_t last_good_ns_ = 0;
  bool went_on_ = false;            // since the last scan that was tracked well
  std::int64_t lost_since_ns_ = 0;  // scans see enough, the pose is not trusted; 0: it is
};

}  // namespace fastlio
