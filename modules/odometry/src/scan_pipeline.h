// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_pipeline.h The per-scan algorithm: propagate, deskew, downsample, iterate, insert. */
#pragma once

#include "carried_pose.h"
#include "edge_stage.h"
#include "pose_search.h"
#include "scan_update.h"
#include "young_map.h"
#include <fastlio/filter/backward_propagation.h>
#include <fastlio/filter/propagation.h>
#include <fastlio/imu/imu_buffer.h>
#include <fastlio/imu/rest_detector.h>
#include <fastlio/lidar/downsampling.h>
#include <fastlio/lidar/point_selector.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/odometry/imu_rate.h>
#include <fastlio/odometry/map_error.h>
#include <fastlio/odometry/parameters.h>
#include <fastlio/odometry/saved_map.h>
#include <fastlio/odometry/scan_result.h>
#include <fastlio/parallel/workers.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace fastlio
{
// So many scans of a map do not match much yet.
constexpr std::uint32_t kYoungMapInsertions = 20;

/** Filter, map and the storage that scans share. */
class ScanPipeline
{
 public:
  explicit ScanPipeline(const Parameters& parameters);

  void start(const FilterState& state, std::int64_t stamp_ns, const YoungMap& young_map = {});
  /** Matches with a map that is there already, from the first scan on; before start(). */
  void useSavedMap(const SavedMap& saved);
  /** The pose was carried over and the map has not been found since. */
  [[nodiscard]] bool recovering() const { return recovering_; }
  [[nodiscard]] bool started() const { return state_ns_ != 0; }
  /** The latest state, also of a pipeline that was suspended. */
  [[nodiscard]] const FilterState& state() const { return filter_; }

  /** No scans until the next start. */
  void suspend();
  /** Goes on from a start of its own, with the pose carried over: looks for the old map, and begins
   * a new one when it is not found. */
  void restart(
      const FilterState& start, std::int64_t stamp_ns, const YoungMap& young_map,
      const CarriedPose& carried);
  /** Instant of the state [ns]. */
  [[nodiscard]] std::int64_t stamp() const { return state_ns_; }
  [[nodiscard]] const SurfaceMap& map() const { return *map_; }

  /** The estimated time offset, to be added to the stamps of scans [ns]. */
  [[nodiscard]] std::int64_t timeShift() const;
  /** Moves stamps and extrinsic of a scan by the calibration as it is estimated now. */
  void applyCalibration(LidarScan& scan, ScanSpan& span) const;

  /** What the last scan added to the map; empty when nothing. */
  [[nodiscard]] const WorldPoints& registeredPoints() const { return world_; }

  /** Intensity and time of those points. */
  [[nodiscard]] const RegisteredFields& registeredFields() const { return fields_; }

  /** The prediction of the last scan at each inertial sample on the way (output.imu_rate). */
  [[nodiscard]] const std::vector<ImuRateState>& imuRateStates() const { return imu_rate_; }

  /** The state at the newest inertial sample, from the latest scan; nothing before the start, while
   * the pose is not trusted, and when the latest scan is newer. */
  [[nodiscard]] std::optional<ImuRateState> stateAtNewestSample(const ImuBuffer& imu);

  /** A scan was given up: the last one left nothing behind. */
  void skipScan();

  /** One scan, from prediction to map growth (section III of the paper). */
  [[nodiscard]] ScanResult process(
      const LidarScan& scan, const ScanSpan& span, const ImuBuffer& imu);

 private:
  [[nodiscard]] FilterState propagateTo(std::int64_t end_ns, const ImuBuffer& imu);
  void compensate(const LidarScan& scan, const ScanSpan& span, const FilterState& predicted);
  [[nodiscard]] UpdateResult updateWithScan(const FilterState& predicted);
  [[nodiscard]] UpdateResult findInMap(const FilterState& predicted);
  [[nodiscard]] UpdateResult approach(const FilterState& predicted, const Pose& candidate);
  void tellNotFound(ScanResult& result);
  void constrainGravity();
  void downsample(const LidarScan& scan, std::int64_t end_ns);
  void judge(const UpdateResult& update, ScanResult& result);
  void learnUsualShare(const ScanStatistics& statistics);
  [[nodiscard]] CompensatedWith compensationWith(
      const NavState& predicted, std::int64_t end_ns) const;
  void releaseTimeOffset(const ScanResult& result);
  void considerRest(ScanResult& result);
  [[nodiscard]] UpdateResult matchOrSearch(const FilterState& predicted);
  [[nodiscard]] UpdateResult searchInPrediction(const FilterState& predicted);
  [[nodiscard]] bool isConvincing(const UpdateResult& update) const;
  void reportSearch(ScanResult& result) const;
  [[nodiscard]] UpdateResult findMap(const FilterState& predicted);
  void judgeRecovery(ScanResult& result);
  void beginNewMap();
  void lookForMap(bool looking);
  [[nodiscard]] bool mayGrowMap(const ScanResult& result) const;
  void describeScan(const LidarScan& scan, ScanStatistics& statistics) const;
  void growMap(const LidarScan& scan, const FilterState& total);
  void keepFields(const LidarScan& scan);
  void forgetPoints();
  [[nodiscard]] FilterState considerMapError(const ScanGain& gain);

  Parameters parameters_;
  std::shared_ptr<const Workers> workers_;
  std::unique_ptr<SurfaceMap> map_;
  EdgeStage edges_;
  ScanUpdate update_;
  FilterState filter_;
  YoungMap young_map_;
  RestDetector rest_;
  std::int64_t state_ns_ = 0;
  std::int64_t last_update_ns_ = 0;
  bool time_offset_released_ = false;  // part of the state from now on
  bool prediction_finite_ = true;
  bool pose_trusted_ = true;
  double imu_gap_s_ = 0.0;
  std::optional<Pose> start_in_map_;  //!< about where; nothing once the map has been found
  double share_in_map_ = 0.0;         //!< of the points, when it was looked for last
  bool map_is_given_ = false;
  bool evidence_good_ = true;  // the last scan matched as a map matches that is the right one
  bool searching_ = false;     // the prediction is too uncertain for matching without a search
  PoseSearchResult search_;    // of the last scan, if there was one
  bool recovering_ = false;    // looking for the old map
  std::pair<int, int> ordinary_iterations_{0, 0};  // of matching and update, when it is not
  std::int64_t recovery_end_ns_ = 0;
  PlaneGrouping planes_;
  MapErrorModel map_error_;
  std::uint32_t insertions_ = 0;
  double usual_share_ = 0.0;  // of the points that match this map, of late
  int shares_ = 0;            // that it is the mean of

  // Reused between scans.
  PointSelector selector_;
  Deskewer deskewer_;
  ScanSelection selection_;
  std::vector<std::uint32_t> edge_indices_;
  std::vector<ImuSample> inputs_;
  std::vector<MotionKnot> knots_;
  std::vector<ImuRateState> imu_rate_;
  CompensatedScan compensated_;
  WorldPoints world_;
  RegisteredFields fields_;
  StageTimings timings_;
};

}  // namespace fastlio
