// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file CMetricMapBuilderLIO.h The odometry where a SLAM stack holds a
 * mrpt::slam::CMetricMapBuilder. */
#pragma once

#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/lidar/scan.h>
#include <fastlio/run/pose_track.h>
#include <fastlio/slam/CLidarInertialOdometry.h>

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/slam/CMetricMapBuilder.h>

#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace fastlio
{
/** How a builder hands over its metric map. */
using MetricMapOfBuilder = BuiltMapOf<mrpt::slam::CMetricMapBuilder>;

/** CMetricMapBuilder over CLidarInertialOdometry: sensory frames with scans and inertial samples
 * in, poses and maps out. Actions are not used: the motion is measured.
 *
 * The metric map is whatever map definitions ask for (an occupancy grid, our CVoxelPlanesMap, ...);
 * without any, a points map. Key frames go into it and into the map of views by the rules of
 * output.keyframe_distance and output.keyframe_angle, each with the pose at its own stamp.
 *
 * As in every builder, public methods may be called from several threads. */
class CMetricMapBuilderLIO : public mrpt::slam::CMetricMapBuilder
{
 public:
  /** \exception std::invalid_argument a parameter is out of its range */
  explicit CMetricMapBuilderLIO(
      const Config& config = {}, const mrpt::maps::TSetOfMetricMapInitializers& maps = {});
  ~CMetricMapBuilderLIO() override;

  /** Starts anew. The views of \a initialMap go into both maps as they are; the poses that follow
   * begin at \a x0 (its mean; on the ground), or at the origin. */
  void initialize(
      const mrpt::maps::CSimpleMap& initialMap = mrpt::maps::CSimpleMap(),
      const mrpt::poses::CPosePDF* x0 = nullptr) override;

  /** CPose3DPDFGaussian of the vehicle at the end of the latest scan; before, at the start. */
  [[nodiscard]] mrpt::poses::CPose3DPDF::Ptr getCurrentPoseEstimation() const override;

  void processActionObservation(
      mrpt::obs::CActionCollection& action, mrpt::obs::CSensoryFrame& observations) override;
  /** The same for single observations. */
  void processObservation(const mrpt::obs::CObservation::Ptr& observation);

  void getCurrentlyBuiltMap(mrpt::maps::CSimpleMap& out_map) const override;
  [[nodiscard]] unsigned int getCurrentlyBuiltMapSize() override;
  [[nodiscard]] MetricMapOfBuilder getCurrentlyBuiltMetricMap() const override;
  /** The metric map's own representation in files whose names begin with \a file. */
  void saveCurrentEstimationToImage(const std::string& file, bool formatEMF_BMP = true) override;

  [[nodiscard]] const CLidarInertialOdometry& odometry() const { return odometry_; }

 protected:
  /** Of the vehicle in the odometry's world, by that of the odometry. */
  using Correction = std::function<TrackedPose(const TrackedPose&)>;

  /** Both maps anew, with corrected poses of the key frames. */
  void rebuild(
      const Correction& correction, mrpt::maps::CSimpleMap& views,
      mrpt::maps::CMultiMetricMap& metric_map) const;
  /** A pose of the vehicle in the odometry's world as one in the map. */
  [[nodiscard]] TrackedPose fromStart(const TrackedPose& pose) const;
  [[nodiscard]] CLidarInertialOdometry& driver() { return odometry_; }
  [[nodiscard]] std::recursive_mutex& mutex() const { return mutex_; }
  [[nodiscard]] std::size_t keyFrames() const { return views_.size(); }

 private:
  void placeOrigin();
  void takeKeyFrames();
  struct Waiting
  {
    mrpt::obs::CObservation::Ptr raw;
    LidarScan scan;
  };
  void addKeyFrame(const Waiting& waiting, const TrackedPose& pose);
  void insertScan(
      const LidarScan& scan, const TrackedPose& pose, const Pose& T_map_vehicle,
      mrpt::maps::CMultiMetricMap& metric_map) const;
  void insertView(
      const mrpt::obs::CSensoryFrame::Ptr& frame, const TrackedPose& in_map,
      mrpt::maps::CSimpleMap& views) const;
  void insertInitialViews(mrpt::maps::CMultiMetricMap& metric_map) const;

  mutable std::recursive_mutex mutex_;
  Config config_;
  mrpt::maps::TSetOfMetricMapInitializers definitions_;
  CLidarInertialOdometry odometry_;
  KeyFrameRule rule_;
  Pose T_map_start_;                 //!< where the vehicle begins, on the ground
  std::optional<Pose> T_map_world_;  //!< the odometry's world in the map, known with the first pose
  mrpt::maps::CMultiMetricMap metric_map_;
  mrpt::maps::CSimpleMap views_;
  std::size_t initial_views_ = 0;  //!< of them
  std::deque<Waiting> waiting_;    //!< scans whose pose is not known yet
};

}  // namespace fastlio
