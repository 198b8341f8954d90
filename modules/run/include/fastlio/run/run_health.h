// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_health.h When and why a run was in trouble, and which stretches cannot be trusted. */
#pragma once

#include <fastlio/interface/scan_result.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** A scan is in trouble below this health value. */
constexpr double kTroubledHealth = 0.5;

/** Scans in trouble one after the other: nobody should rely on their poses. */
struct UntrustedStretch
{
  std::int64_t begin_ns = 0, end_ns = 0;  //!< ends of its first and last scan
  double begin_s = 0.0, end_s = 0.0;      //!< the same, since the first scan's begin [s]
  std::size_t scans = 0;                  //!< in trouble, or without a result
  HealthCause cause = HealthCause::None;  //!< of most of them
  std::string reason;                     //!< in words, of the scan that fared worst by it
};

/** Digest of the scans' health, from the first pose on. */
class RunHealth
{
 public:
  /** A scan in trouble. */
  struct Trouble
  {
    std::size_t scan = 0;       //!< counted from 0 over the scans that were processed
    std::int64_t stamp_ns = 0;  //!< the scan's end
    double second = 0.0;        //!< since the first scan's begin [s]
    ScanHealth health;
  };

  void add(const ScanResult& result);
  /** The recording has scans after the last result, but they could not be processed.
   * \param until_ns to where it goes on */
  void addLostEnd(std::int64_t until_ns, std::size_t scans, const std::string& reason);

  /** Scans since the first pose. */
  [[nodiscard]] std::size_t scans() const { return scans_; }
  [[nodiscard]] std::size_t troubled() const { return troubled_; }
  [[nodiscard]] double mean() const;
  [[nodiscard]] double worst() const { return worst_; }
  [[nodiscard]] const std::optional<Trouble>& firstTrouble() const { return first_; }
  /** How many scans in trouble had each cause. */
  [[nodiscard]] const std::map<HealthCause, std::size_t>& causes() const { return causes_; }
  /** One scan after the other was the first one of the map: none of their points joined it. */
  [[nodiscard]] bool hasNoMap() const { return tracked_ == 0 && first_scans_ > 1; }
  /** In order of time. Without a pose or a map it is the whole run. A scan or two by themselves are
   * none: the scans around them vouch for the poses. A scan that was found by a search of the map,
   * or contradicts the inertial data by far, is one by itself. */
  [[nodiscard]] std::vector<UntrustedStretch> untrusted() const;

 private:
  /** The scans of a stretch that have one cause. */
  struct OfCause
  {
    std::size_t scans = 0;
    double worst = 1.0;
    std::string reason;
  };
  /** A stretch that may go on. */
  struct Growing
  {
    UntrustedStretch stretch;
    std::size_t last_scan = 0;  // of all scans
    std::map<HealthCause, OfCause> causes;
    //! One scan is enough: it was found in the map from far off, or contradicts the inertial data.
    bool grave = false;
  };

  void extendStretch(const ScanResult& result);
  Growing& stretchAt(std::int64_t stamp_ns);

  std::size_t seen_ = 0, scans_ = 0, troubled_ = 0, tracked_ = 0, first_scans_ = 0;
  std::int64_t begin_ns_ = 0, end_ns_ = 0;
  double sum_ = 0.0, worst_ = 1.0;
  std::optional<Trouble> first_;
  std::map<HealthCause, std::size_t> causes_;
  std::vector<Growing> stretches_;
};

}  // namespace fastlio
