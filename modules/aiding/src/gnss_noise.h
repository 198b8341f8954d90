// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gnss_noise.h The noise of positions of GNSS, by what a map leaves over of them (internal). */
#pragma once

#include <fastlio/aiding/gnss.h>
#include <fastlio/posegraph/pose_graph.h>

#include <cstddef>
#include <string>
#include <vector>

namespace fastlio
{
inline constexpr std::size_t kLeastFixes = 10;
// A fix whose receiver states little noise counts as so much of a typical one at least: a wrong one
// must not outweigh all others.
inline constexpr double kLeastRelative = 0.1;

/** A graph with fixes as its positions. */
struct FixesInGraph
{
  PoseGraph graph;
  GraphEstimate estimate;
  /** Of each position, by axis: its noise over that of a typical one, by the receiver's account. */
  std::vector<Vec3> relative;
};

/** Whether a position of this weight agrees with the others. */
[[nodiscard]] bool agrees(double weight);

/** Why fixes of which so many agree are not used; empty: they are. */
[[nodiscard]] std::string shortageOf(std::size_t agreeing, std::size_t fixes);

/** Measures the noise of the fixes in a graph that agree, and leaves out those that it does not
 * explain. */
void settleOnNoise(FixesInGraph& fixes, const std::vector<Submap>& submaps, GnssOutcome& outcome);

/** Gives the fixes the noise that was measured, and counts that errors last. */
void setNoise(FixesInGraph& fixes, const std::vector<Submap>& submaps, const GnssOutcome& outcome);

}  // namespace fastlio
