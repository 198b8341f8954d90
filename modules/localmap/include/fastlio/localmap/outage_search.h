// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file outage_search.h After an outage of the LiDAR: the scans measure the velocity first. The
 * same error of the inertial data made the position wrong and the velocity, so the velocity shows
 * the position much better than the prediction did. Then fewer places are left that look alike. */
#pragma once

#include <fastlio/interface/odometry_options.h>
#include <fastlio/localmap/local_map.h>
#include <fastlio/matching/scan_matcher.h>
#include <fastlio/parallel/workers.h>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace fastlio
{
/** How far a prediction has gone from the scans, per second. */
struct VelocityError
{
  Vec3 mean = Vec3::Zero();        //!< true minus predicted velocity [m/s]
  Mat3 covariance = Mat3::Zero();  //!< [m^2/s^2]
};

/** Kalman update of a prediction with a measured error of its velocity. */
[[nodiscard]] FilterState correctedByVelocity(
    const FilterState& predicted, const VelocityError& error);

/** Accompanies the first second and a half after an outage. */
class OutageSearch
{
 public:
  /** Of each scan, if it has so many: few points in motion make no planes for the next scan. */
  static constexpr std::size_t kPoints = 10000;

  /** \param predicted state at the first scan after the outage, which ends at \a begin_ns
   * \param unseen_s time without a scan until then [s] */
  OutageSearch(
      const OdometryOptions& options, std::shared_ptr<const Workers> workers,
      const FilterState& predicted, std::int64_t begin_ns, double unseen_s);

  /** The LiDAR saw nothing for so long that what comes into view next may be missing in the map. */
  [[nodiscard]] bool expectsNewView() const { return unseen_; }

  /** Matches the scan with the scans since the outage, in a map of their own.
   * \return the prediction, corrected by the velocity with the scan that completes it */
  [[nodiscard]] FilterState withVelocity(
      const DeskewedScan& scan, const FilterState& predicted, std::int64_t end_ns,
      ScanMatcher& matcher);

  /** The prediction is too uncertain to be searched for before the velocity is known. */
  [[nodiscard]] bool measuresVelocity(std::int64_t end_ns) const;
  [[nodiscard]] bool knowsVelocity() const { return known_; }
  /** The map has been searched long enough. */
  [[nodiscard]] bool isOver(std::int64_t end_ns) const;

 private:
  void measure(
      const DeskewedScan& scan, const FilterState& predicted, double seconds, ScanMatcher& matcher);
  void insert(const DeskewedScan& scan, const NavState& x);

  const OdometryOptions options_;
  LocalMap scans_;  // since the outage
  WorldPoints points_;
  std::int64_t begin_ns_;
  bool needed_;  // before the map is searched
  bool unseen_;  // there was no scan before
  bool known_ = false;
  int measured_ = 0;  // scans
  VelocityError error_;
};

}  // namespace fastlio
