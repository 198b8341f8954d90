// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file beam_errors.h Errors that all points of a laser share: its range is off by a constant, or
 * its elevation. Thousands of points do not average them out, and nor do hundreds of planes. */
#pragma once

#include <fastlio/errormodel/beam_pulls.h>
#include <fastlio/errormodel/calibration_sums.h>
#include <fastlio/errormodel/creating_views.h>
#include <fastlio/errormodel/incidence_bias.h>
#include <fastlio/errormodel/side_errors.h>
#include <fastlio/lidar/beam_corrections.h>
#include <fastlio/matching/match_result.h>
#include <fastlio/matching/measured_scan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** Learns how large such errors are from the residuals that the beams of one elevation leave on
 * average, and says what they do to a scan. Points do not name their laser, but its elevation does.
 */
class BeamErrors
{
 public:
  /** A scan was matched. \param T_world_scan the scan pose
   * \param measured its measurements \param matches their planes, by point of the scan */
  void add(
      const Pose& T_world_scan, const DeskewedScan& scan, const MeasuredScan& measured,
      const std::vector<PlaneMatch>& matches);
  /** A scan joined the map. \param insertion its number, greater than that before */
  void recordInsertion(std::uint32_t insertion, const Pose& T_world_lidar)
  {
    views_.record(insertion, T_world_lidar);
  }
  /** There is no map any more. */
  void forgetMap();

  /** What offsets of range and elevation, of lasers and of sides, do to a scan. The beams that
   * created a plane had such offsets, too: where the same beam meets it again, nothing is wrong.
   * The points are those of the last sampled scan, which every fourth one is: what the beams meet
   * stays nearly the same, seen from the sensor. Dense LiDARs have several lasers in a column.
   * \param R_world_scan attitude of the scan pose */
  [[nodiscard]] BeamPulls pulls(const Mat3& R_world_scan) const;
  /** Root mean square of the offsets; 0 while none is known. */
  [[nodiscard]] double rangeOffset() const;                                      //!< [m]
  [[nodiscard]] double elevationOffset() const;                                  //!< [rad]
  [[nodiscard]] double sideRangeOffset() const { return sides_.rangeOffset(); }  //!< [m]
  /** Adds what the beams tell about their calibration. */
  void addTo(CalibrationFindings& findings) const;

 private:
  /** An offset of the beams of one elevation. */
  struct Offset
  {
    double information = 0.0, weighted = 0.0;  // of all scans
    Vector6 in_sampled = Vector6::Zero();      // sum of w h times its derivative, sampled scan

    void add(const PointMeasurement& point, double derivative);
  };
  using Offsets = std::array<Offset, kBeamBins>;
  struct SensorFrame;
  struct BeamLanes;

  [[nodiscard]] static BeamLanes beamsOf(
      const MeasurementBlock& block, const BodyPoints& body, const SensorFrame& frame);
  void add(const BeamLanes& beams, std::size_t lane, const PointMeasurement& point);
  void beginSample();
  void finishSample(const Mat3& R_world_scan);
  void chooseColumns(const BodyPoints& body, const SensorFrame& frame);
  void sample(
      const BeamLanes& beams, std::size_t lane, const PointMeasurement& point, std::uint32_t plane);
  void sampleCreation(
      const Pose& T_lidar_world, const Vec3& point, const Vec3& normal, const Vector6& weighted_h);

  /** Those of the sampled scan, in the first columns of \a result. */
  void pullsOf(
      const Offsets& offsets, double variance,
      Eigen::Ref<Eigen::Matrix<double, 6, -1>> result) const;
  [[nodiscard]] double meanSquare(
      const Offsets& offsets, const Offsets& others, double least_information) const;

  Offsets range_, elevation_;
  std::array<double, kBeamBins> cross_{};  // information between range and elevation of a bin
  IncidenceBias incidence_;
  SideErrors sides_;
  CreatingViews views_;
  std::size_t scans_ = 0;
  BeamPulls pulls_ = BeamPulls::Zero();  // of the sampled scan, in the axes of the body
  double range_variance_ = 0.0, elevation_variance_ = 0.0;  // [m^2], [rad^2]
  std::size_t first_bin_ = 0, bins_per_column_ = 0;
  double upright_weight_ = 0.0, upright_range_ = 0.0;
};

}  // namespace fastlio
