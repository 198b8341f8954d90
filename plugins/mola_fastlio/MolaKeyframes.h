// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file MolaKeyframes.h Keyframes for MOLA's mapper, which closes loops and takes GNSS in, where
 * MOLA has it. */
#pragma once

#include <fastlio/slam/CLidarInertialOdometry.h>

#include <deque>
#include <optional>
#include <string>

#if __has_include(<mola_kernel/interfaces/SharedKeyframeMap.h>)
#define FASTLIO_MOLA_HAS_KEYFRAME_MAP 1
#include <mola_kernel/interfaces/SharedKeyframeMap.h>
#else
#define FASTLIO_MOLA_HAS_KEYFRAME_MAP 0
#endif

namespace fastlio
{
/** Keeps the latest observations as they came, and tells when the next keyframe is due. */
class MolaKeyframes
{
 public:
  void keep(const mrpt::obs::CObservation::ConstPtr& observation);

  /** The vehicle has moved on from the keyframe before. */
  [[nodiscard]] bool isDue(const Pose& T_world_vehicle) const;

  /** Poses are in another frame from now on: that of a map that was loaded (1, 2, ...). */
  void beginFrame(std::size_t map)
  {
    latest_.reset();
    frame_ = kFrame + std::string("_") + std::to_string(map);
  }

#if FASTLIO_MOLA_HAS_KEYFRAME_MAP
  /** The keyframe at this estimate, with the scan as it was recorded.
   * \param odometry that the estimate is of; tells which observation the scan is
   * \return nothing: the scan is not known any more */
  [[nodiscard]] std::optional<mola::SharedKeyframeMap::KeyframeInsertRequest> take(
      const OdometryEstimate& estimate, CLidarInertialOdometry& odometry);
#endif

 private:
  static constexpr const char* kFrame = "lidar_inertial_keyframes";

  std::string frame_ = kFrame;
  std::deque<mrpt::obs::CObservation::ConstPtr> recent_;
  std::optional<Pose> latest_;  // of the vehicle, at the keyframe before
};

}  // namespace fastlio
