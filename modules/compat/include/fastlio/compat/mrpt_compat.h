// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mrpt_compat.h All that differs between the supported versions of MRPT: the one place that
 * asks for the version. Elsewhere the features that are named here are asked for. */
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/math/TTwist3D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/version.h>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

// MRPT_VERSION has two hexadecimal digits per part since 2.10.2 (0x20a02) and one before (0x258 is
// 2.5.8), so that older versions compare as smaller.

/** CPointsMap implements mrpt::maps::NearestNeighborsCapable: the nn_*() methods are virtual. */
#define FASTLIO_MRPT_HAS_NN_INTERFACE (MRPT_VERSION >= 0x20b03)
/** mrpt::maps::CPointsMapXYZIRT. */
#define FASTLIO_MRPT_HAS_XYZIRT (MRPT_VERSION >= 0x20b04)
/** CObservationRotatingScan has points and knows where it is stored, in streams too. */
#define FASTLIO_MRPT_HAS_ROTATING_POINTS (MRPT_VERSION >= 0x20b04)
/** CSimpleMap consists of keyframes that have a twist. */
#define FASTLIO_MRPT_HAS_KEYFRAMES (MRPT_VERSION >= 0x20b05)
/** CPointsMap::impl_copyFrom() is final and knows MRPT's own fields only. */
#define FASTLIO_MRPT_COPIES_POINTS_ITSELF (MRPT_VERSION >= 0x20d02)
/** mrpt::maps::CGenericPointsMap. */
#define FASTLIO_MRPT_HAS_GENERIC_MAP (MRPT_VERSION >= 0x20f00)
/** Reads CSimplePointsMap and CPointsMapXYZI as 2.15.3 writes them. */
#define FASTLIO_MRPT_READS_NEWER_POINTS (MRPT_VERSION >= 0x20f03)

#if FASTLIO_MRPT_HAS_NN_INTERFACE
#define FASTLIO_NN_OVERRIDE override
#include <mrpt/maps/NearestNeighborsCapable.h>
#else
#define FASTLIO_NN_OVERRIDE
#endif

namespace fastlio
{
#if FASTLIO_MRPT_HAS_NN_INTERFACE
/** Base of maps that are searched by MRPT's names. */
using NearestNeighborsInterface = mrpt::maps::NearestNeighborsCapable;
/** The result of a map definition's factory. */
using CreatedMap = std::shared_ptr<mrpt::maps::CMetricMap>;
#else
/** Base of maps that are searched by MRPT's names: nothing is virtual yet. */
struct NearestNeighborsInterface
{
};
/** The result of a map definition's factory; the caller owns it. */
using CreatedMap = mrpt::maps::CMetricMap*;
#endif

/** A keyframe of a map. */
struct KeyFrameView
{
  mrpt::poses::CPose3DPDF::ConstPtr pose;
  mrpt::obs::CSensoryFrame::ConstPtr frame;
};

/** \exception std::exception index out of range */
[[nodiscard]] inline KeyFrameView keyFrame(const mrpt::maps::CSimpleMap& map, std::size_t index)
{
#if FASTLIO_MRPT_HAS_KEYFRAMES
  const auto& keyframe = map.get(index);
  return {keyframe.pose, keyframe.sf};
#else
  const auto [pose, frame] = map.get(index);
  return {pose, frame};
#endif
}

/** Appends a keyframe. Older versions of MRPT have no place for the twist.
 * \param twist of the vehicle, its own frame */
inline void insertKeyFrame(
    mrpt::maps::CSimpleMap& map, const mrpt::poses::CPose3DPDFGaussian& pose,
    const mrpt::obs::CSensoryFrame::Ptr& frame, [[maybe_unused]] const mrpt::math::TTwist3D& twist)
{
  const auto pdf = mrpt::poses::CPose3DPDFGaussian::Create(pose);
#if FASTLIO_MRPT_HAS_KEYFRAMES
  mrpt::maps::CSimpleMap::Keyframe keyframe;
  keyframe.pose = pdf;
  keyframe.sf = frame;
  keyframe.localTwist = twist;
  map.insert(keyframe);
#else
  map.insert(pdf, frame);
#endif
}

/** How a CMetricMapBuilder hands over its metric map: a pointer, since 2.9.2 a reference. */
template <typename Builder>
using BuiltMapOf = decltype(std::declval<const Builder&>().getCurrentlyBuiltMetricMap());

/** \a map in the way of \a Built, a BuiltMapOf. */
template <typename Built, typename Map>
[[nodiscard]] Built asBuiltMap(const Map& map)
{
  if constexpr (std::is_pointer_v<Built>)
    return &map;
  else
    return map;
}

}  // namespace fastlio
