// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file transform_tree.h Where the frames of a recording are fixed to each other. */
#pragma once

#include <fastlio/messages/ros_messages.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** Frames more than any vehicle has; further ones are left out. */
inline constexpr std::size_t kMostFrames = 10000;

/** The fixed transforms: all of tf_static; of tf those that never change. */
class TransformTree
{
 public:
  /** \param fixed of tf_static; one of tf is kept as long as it repeats itself */
  void add(const RosTransform& transform, bool fixed);

  /** The frame that poses of sensors refer to: base_link or another usual name that any of the
   * frames hangs under, otherwise the top of the first one that something is known of; nothing
   * where nothing is known of any. */
  [[nodiscard]] std::optional<std::string> vehicleFrameOf(
      const std::vector<std::string>& frames) const;

  /** It is connected by tf_static to base_link, which goes before other names of the vehicle. */
  [[nodiscard]] bool isFixedToVehicle(const std::string& frame) const;

  /** Pose of \a frame in \a vehicle; nothing where they are not connected. */
  [[nodiscard]] std::optional<Pose> poseOf(
      const std::string& frame, const std::string& vehicle) const;

 private:
  struct Edge
  {
    std::string parent;
    Pose T_parent_child;
    bool fixed = false;  // of tf_static
    bool moved = false;  // tf has said two different things
    std::size_t seen = 0;
  };
  struct Top
  {
    std::string frame;
    Pose T_top_frame;
  };

  [[nodiscard]] const Edge* edgeOf(const std::string& child) const;
  [[nodiscard]] std::optional<std::string> topOf(const std::string& frame) const;
  [[nodiscard]] Top climb(const std::string& frame, const std::string& until) const;

  std::map<std::string, Edge> edges_;  // by child
};

}  // namespace fastlio
