// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file place_recognition.h Which submaps may show the place of another one, without any prediction:
 * upright surfaces from above are compared at all headings and places. */
#pragma once

#include <fastlio/map/plane_voxel.h>
#include <fastlio/math/pose.h>

#include <complex>
#include <cstddef>
#include <vector>

namespace fastlio
{
/** A place that looks like another one. */
struct PlaceMatch
{
  std::size_t place = 0;    //!< number, in the order of PlaceIndex::add()
  Pose T_place_query;       //!< of the leveled frames: a heading and a way on the ground
  double similarity = 0.0;  //!< normalised correlation, 1: the same
};

/** What upright surfaces look like from above: how many there are in each cell of a square grid
 * around the origin of a leveled frame. */
class BirdsEyeView
{
 public:
  static constexpr int kCells = 64;  //!< along an edge

  /** \param planes in the frame of the submap \param R_level_submap turns its z axis upwards
   * \param cell edge of a cell [m] \param heading turns the view [rad] */
  BirdsEyeView(
      const std::vector<VoxelPlane>& planes, const Mat3& R_level_submap, double cell,
      double heading = 0.0);

  using Spectrum = std::vector<std::complex<float>>;
  /** Of the view, scaled to the energy 1. */
  [[nodiscard]] Spectrum spectrum() const;

 private:
  std::vector<float> cells_;
};

/** Finds places. Memory: 32 kB a place. */
class PlaceIndex
{
 public:
  /** \param cell of the views [m]: a sixth of a submap's length or so */
  explicit PlaceIndex(double cell) : cell_(cell) {}

  void add(const std::vector<VoxelPlane>& planes, const Mat3& R_level_submap);

  /** The most similar places, the best first; none are nearer to each other than three numbers.
   * \param most of them */
  [[nodiscard]] std::vector<PlaceMatch> find(
      const std::vector<VoxelPlane>& planes, const Mat3& R_level_submap, std::size_t most) const;

  [[nodiscard]] double cell() const { return cell_; }

 private:
  double cell_;
  std::vector<BirdsEyeView::Spectrum> spectra_;
};

/** The rotation that levels a frame: its heading becomes zero. */
[[nodiscard]] Mat3 levelingRotation(const Mat3& R_world_submap);

}  // namespace fastlio
