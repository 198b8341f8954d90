// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mrpt_bridge/mrpt_compat.h What differs between MRPT versions for observations and their
 * maps.
 */
#pragma once

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/math/TTwist3D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/version.h>

namespace fastlio
{
/** A key frame of a map. */
struct KeyFrameView
{
  mrpt::poses::CPose3DPDF::ConstPtr pose;
  mrpt::obs::CSensoryFrame::ConstPtr frame;
};

/** \exception std::exception index out of range */
[[nodiscard]] inline KeyFrameView keyFrame(const mrpt::maps::CSimpleMap& map, std::size_t index)
{
#if MRPT_VERSION >= 0x20b05
  const auto& keyframe = map.get(index);
  return {keyframe.pose, keyframe.sf};
#else
  const auto [pose, frame] = map.get(index);
  return {pose, frame};
#endif
}

/** Appends a key frame. Older versions of MRPT (before 2.11.5) have no place for the twist.
 * \param twist of the vehicle, its own frame */
inline void insertKeyFrame(
    mrpt::maps::CSimpleMap& map, const mrpt::poses::CPose3DPDFGaussian& pose,
    const mrpt::obs::CSensoryFrame::Ptr& frame, [[maybe_unused]] const mrpt::math::TTwist3D& twist)
{
  const auto pdf = mrpt::poses::CPose3DPDFGaussian::Create(pose);
#if MRPT_VERSION >= 0x20b05
  mrpt::maps::CSimpleMap::Keyframe keyframe;
  keyframe.pose = pdf;
  keyframe.sf = frame;
  keyframe.localTwist = twist;
  map.insert(keyframe);
#else
  map.insert(pdf, frame);
#endif
}

}  // namespace fastlio
