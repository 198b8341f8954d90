// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_factory.h The map that the parameters ask for. */
#pragma once

#include <fastlio/interface/odometry_options.h>
#include <fastlio/localmap/saved_map.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/parallel/workers.h>

#include <memory>

namespace fastlio
{
/** \param workers who share the map's insertions \param sparse_lines of voxelSize() */
[[nodiscard]] std::unique_ptr<SurfaceMap> makeSurfaceMap(
    const OdometryOptions& parameters, std::shared_ptr<const Workers> workers, bool sparse_lines);
/** Of the saved map's planes, where the type of map has planes; else of its points. */
[[nodiscard]] std::unique_ptr<SurfaceMap> makeSurfaceMap(
    const OdometryOptions& parameters, std::shared_ptr<const Workers> workers,
    const SavedMap& saved);

}  // namespace fastlio
