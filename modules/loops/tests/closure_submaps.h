// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file closure_submaps.h A submap that is seen again, and the closure that a mapper makes of it. */
#pragma once

#include "simulated_submaps.h"
#include <fastlio/loops/mapper.h>
#include <fastlio/math/time.h>
#include <fastlio/scenarios/settings_table.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <utility>

namespace fastlio::testing
{
/** What is seen in a few seconds. */
inline Submap surroundings(const char* scenario)
{
  SimulationSettings settings = defaultSettings(scenario);
  settings.duration = 5.0;
  settings.lidar.stride = 4;
  constexpr double kLong = 100.0;  // [m]: one submap holds all
  return submapsOf(Simulation(settings), {kLong}).at(0);
}

/** A submap with those planes only that are parallel to a direction. */
inline Submap planesAlong(const Vec3& direction, Submap submap)
{
  const auto seen = submap.surfaces.get();
  SubmapSurfaces parallel;
  for (std::size_t i = 0; i < seen->planes.size(); ++i)
  {
    if (std::abs(seen->planes[i].normal().dot(direction)) > 0.1) continue;
    parallel.planes.push_back(seen->planes[i]);
    parallel.spreads.push_back(seen->spreads[i]);
  }
  submap.surfaces = StoredSurfaces(std::make_shared<SubmapStore>(), std::move(parallel));
  return submap;
}

/** A street whose fronts tell the place across, not along. */
inline Submap streetWithoutCorners()
{
  return planesAlong(Vec3::UnitX(), surroundings("town"));
}

/** The same submap after so much travel.
 * \param height by the odometry [m] \param height_std how well it knows, by its map [m] */
inline Submap submapAt(Submap submap, double height, double height_std, double travel)
{
  submap.reference.T_world_body.p.z() += height;
  submap.reference.stamp_ns += toNanoseconds(travel);  // at 1 m/s
  submap.reference.map_covariance.setZero();
  submap.reference.map_covariance(5, 5) = height_std * height_std;
  submap.reference.covariance = submap.reference.map_covariance + 1e-8 * Matrix6::Identity();
  submap.travel += travel;
  submap.gravity = std::nullopt;  // the accelerometer does not tell heights
  return submap;
}

/** The one closure of these submaps. */
inline Closure closureOf(std::initializer_list<Submap> submaps)
{
  Mapper mapper;
  for (const Submap& submap : submaps)
    mapper.add(submap);
  EXPECT_EQ(mapper.closures().size(), 1U);
  return mapper.closures().empty() ? Closure{} : mapper.closures().front();
}

/** A place that an odometry passes again.
 * \param std how well it knows where it is [m] */
inline Submap secondPass(const Submap& place, double std)
{
  Submap later = submapAt(place, 0.0, 0.0, 60.0);
  later.reference.T_world_body.p += Vec3(0.3, 0.2, 0.1);
  later.reference.map_covariance.diagonal().tail<3>().setConstant(std * std);
  later.reference.covariance = later.reference.map_covariance + 1e-8 * Matrix6::Identity();
  return later;
}

/** The closure of such a place. */
inline Closure closureOfSecondPass(const Submap& place, double std)
{
  return closureOf({submapAt(place, 0.0, 0.0, 0.0), secondPass(place, std)});
}
}  // namespace fastlio::testing
