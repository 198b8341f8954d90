// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file CMetricMapBuilderLoops.h The odometry with loop closures where a SLAM stack holds a
 * mrpt::slam::CMetricMapBuilder. */
#pragma once

#include <fastlio/loops/corrected_trajectory.h>
#include <fastlio/loops/mapper.h>
#include <fastlio/slam/CMetricMapBuilderLIO.h>
#include <fastlio/submaps/submap.h>

#include <cstddef>
#include <optional>
#include <string>

namespace fastlio
{
/** CMetricMapBuilderLIO that closes loops while the observations come in: after an accepted
 * closure, pose, views and metric map are the corrected ones. Without one they are those of the
 * odometry, to the bit.
 *
 * The maps are made anew when they are asked for after a change; this takes a second or so for a
 * hundred key frames. What getCurrentlyBuiltMetricMap() handed over before is then the new map. As
 * in every builder, public methods may be called from several threads. */
class CMetricMapBuilderLoops : public CMetricMapBuilderLIO
{
 public:
  /** \exception std::invalid_argument a parameter is out of its range */
  explicit CMetricMapBuilderLoops(
      const Config& config = {}, const mrpt::maps::TSetOfMetricMapInitializers& maps = {},
      const ClosureLimits& limits = {});
  ~CMetricMapBuilderLoops() override;

  /** As CMetricMapBuilderLIO::initialize(); closures are forgotten. Loops are closed within what
   * follows; views of \a initialMap stay where they are. */
  void initialize(
      const mrpt::maps::CSimpleMap& initialMap = mrpt::maps::CSimpleMap(),
      const mrpt::poses::CPosePDF* x0 = nullptr) override;

  [[nodiscard]] mrpt::poses::CPose3DPDF::Ptr getCurrentPoseEstimation() const override;
  void getCurrentlyBuiltMap(mrpt::maps::CSimpleMap& out_map) const override;
  [[nodiscard]] MetricMapOfBuilder getCurrentlyBuiltMetricMap() const override;
  void saveCurrentEstimationToImage(const std::string& file, bool formatEMF_BMP = true) override;

  /** Submaps, every closure with its verdict, and the optimum of all measurements up to now. */
  [[nodiscard]] MappingResult mapping() const;
  /** Accepted closures so far; the optimum may still contradict one. */
  [[nodiscard]] std::size_t closures() const;

 private:
  /** What closures make of the run. */
  struct Corrected
  {
    std::optional<CorrectedTrajectory> trajectory;  //!< none: no closure, nothing to correct
    std::size_t submaps = 0;                        //!< when it was made
    std::size_t scans = 0;                          //!< key frames in the maps below
    mrpt::maps::CSimpleMap views;
    mrpt::maps::CMultiMetricMap metric_map;
  };

  void takeScan(const OdometryEstimate& estimate);
  [[nodiscard]] const CorrectedTrajectory* updatedTrajectory() const;
  [[nodiscard]] TrackedPose correctedPose(
      const CorrectedTrajectory& trajectory, const TrackedPose& vehicle) const;
  [[nodiscard]] bool updateMaps() const;

  ClosureLimits limits_;
  std::optional<SubmapBuilder> submaps_;
  std::optional<Mapper> mapper_;
  mutable Corrected corrected_;  //!< made when somebody asks for it
};

}  // namespace fastlio
