// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file look_ahead.h What is known of a recording's sensors before its first observation. */
#pragma once

#include "ros_message_source.h"
#include <fastlio/messages/ouster_topics.h>
#include <fastlio/messages/transform_tree.h>

#include <map>
#include <string>
#include <vector>

namespace fastlio
{
/** Looks through the beginning of a recording for the transforms between the frames of its sensors,
 * and for metadata. It ends where more would change nothing: when every sensor is fixed to the
 * vehicle. */
class LookAhead
{
 public:
  /** They take what is found. */
  LookAhead(TransformTree& transforms, OusterTopics& ouster)
      : transforms_(transforms), ouster_(ouster)
  {
  }

  void lookThrough(RosMessageSource& messages);

  /** The frame that poses refer to, which LiDARs and IMUs decide; empty: none is known. */
  [[nodiscard]] std::string vehicleFrame() const;

 private:
  void lookAt(const RosMessage& message);
  void noteFrame(const RosTopic& topic, const std::string& frame);
  [[nodiscard]] bool isWanted(const RosTopic& topic) const;
  [[nodiscard]] bool knowsEverySensor(const RosMessageSource& messages) const;

  TransformTree& transforms_;
  OusterTopics& ouster_;
  std::map<std::string, std::string> frames_;  // of sensors, by topic
  std::vector<std::string> carried_;  // frames of LiDARs and IMUs, in the order of the recording
  bool news_ = false;                 // the latest message was worth looking at
};

}  // namespace fastlio
