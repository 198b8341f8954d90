// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file graph_files.h Pose graphs as text, as MRPT and g2o read them. */
#pragma once

#include <fastlio/run/pose_track.h>

#include <cstddef>
#include <string>
#include <vector>

namespace fastlio
{
/** A measured motion between two poses of a graph. */
struct GraphFileEdge
{
  std::size_t from = 0, to = 0;
  RelativePose motion;
};

/** As mrpt::graphs::CNetworkOfPoses reads it: VERTEX3, FIX, EDGE3 with x y z roll pitch yaw and the
 * upper triangle of the information matrix. */
[[nodiscard]] std::string mrptGraphText(
    const std::vector<Pose>& poses, const std::vector<GraphFileEdge>& edges);

/** As g2o reads it: VERTEX_SE3:QUAT, FIX, EDGE_SE3:QUAT. */
[[nodiscard]] std::string g2oGraphText(
    const std::vector<Pose>& poses, const std::vector<GraphFileEdge>& edges);

}  // namespace fastlio
