// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scene_objects.h The objects in the 3D scene of a run. */
#pragma once

#include <fastlio/run/output_map.h>
#include <fastlio/run/pose_output.h>

#include <mrpt/opengl/CSetOfObjects.h>

#include <vector>

namespace fastlio
{
/** At most so many points of the map are shown: others of it are left out evenly. */
constexpr std::size_t kMostScenePoints = 2'000'000;

/** Points coloured by height, named "map". \exception std::runtime_error the map cannot be read */
[[nodiscard]] mrpt::opengl::CRenderizable::Ptr scenePoints(const OutputMap& map);

/** Lines between positions, broken where one is not finite, named "trajectory".
 * \param origin of the scene in the world [m] */
[[nodiscard]] mrpt::opengl::CRenderizable::Ptr sceneTrajectory(
    const std::vector<Vec3>& positions, const Vec3& origin);

/** Ellipsoids of three standard deviations of the position, named "covariances". */
[[nodiscard]] mrpt::opengl::CRenderizable::Ptr sceneCovariances(
    const std::vector<PoseEstimate>& key_frames, const Vec3& origin);

/** Axes at the poses, named "keyframes". */
[[nodiscard]] mrpt::opengl::CRenderizable::Ptr sceneKeyFrames(
    const std::vector<PoseEstimate>& key_frames, const Vec3& origin);

}  // namespace fastlio
