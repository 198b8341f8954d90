// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file public_types.h Size and alignment of the types that cross the libraries' borders, as the
 * compiler of one file sees them. */
#pragma once

#include <fastlio/filter/backward_propagation.h>
#include <fastlio/filter/update.h>
#include <fastlio/lidar/downsampling.h>
#include <fastlio/map/knn_surface_map.h>
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/map/plane_fit.h>
#include <fastlio/map/voxel_plane_map.h>
#include <fastlio/matching/point_to_plane.h>
#include <fastlio/odometry/odometry.h>

#include <cstddef>
#include <string>
#include <vector>

namespace fastlio::testing
{
struct TypeLayout
{
  std::string name;
  std::size_t size = 0, alignment = 0;
};

template <typename Type>
TypeLayout layoutOf(const char* name)
{
  return {name, sizeof(Type), alignof(Type)};
}

/** Of a file compiled for the machine at hand, as the libraries are. */
std::vector<TypeLayout> nativeLayouts();
/** Of a file compiled for the baseline, as a user's program may be. */
std::vector<TypeLayout> baselineLayouts();
}  // namespace fastlio::testing

// Macros, since a function of the same name in two files would be taken from one of them.
// clang-format off
#define FASTLIO_PUBLIC_TYPES(X)                                                                   \
  X(NavState) X(FilterState) X(Pose) X(ImuSample) X(MotionKnot) X(InformationSums)                \
  X(MeasurementEvaluation) X(UpdateResult) X(UpdateStep) X(LidarScan) X(PointColumns)             \
  X(Downsampler) X(ScanSelection) X(PlaneVoxel) X(VoxelPlane) X(PlaneMatch) X(VoxelPlaneMap)      \
  X(KnnSurfaceMap) X(CIncrementalPointsMap) X(CVoxelPlanesMap) X(PlaneFit) X(LineFit)             \
  X(MotionStep) X(Deskewer) X(PlaneMeasurement) X(OdometryOptions) X(ScanStatistics) X(ScanResult)     \
  X(InputStatistics) X(Odometry)
#define FASTLIO_LAYOUT(Type) layoutOf<Type>(#Type),
#define FASTLIO_PUBLIC_LAYOUTS {FASTLIO_PUBLIC_TYPES(FASTLIO_LAYOUT)}
// clang-format on
