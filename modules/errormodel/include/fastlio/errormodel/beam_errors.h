// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file beam_errors.h Errors that all points of a laser share: its range is off by a constant, or
 * its elevation, or its azimuth. Thousands of points do not average them out, and nor do hundreds
 * of planes. */
#pragma once

#include <fastlio/errormodel/beam_calibration.h>
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
  /** \param corrects CalibrationOptions::estimate_beams */
  explicit BeamErrors(bool corrects = true) : calibration_(corrects) {}

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

  /** What offsets of lasers and of sides do to a scan. The beams that created a plane had such
   * offsets, too: where the same beam meets it again, nothing is wrong. The points are those of the
   * last sampled scan, which every fourth one is: what the beams meet stays nearly the same, seen
   * from the sensor. Dense LiDARs have several lasers in a column.
   * \param R_world_scan attitude of the scan pose */
  [[nodiscard]] BeamPulls pulls(const Mat3& R_world_scan) const;
  /** To be taken off the points of the scans that follow. */
  [[nodiscard]] const BeamCorrections& corrections() const { return calibration_.corrections(); }
  /** Standard deviation of the offsets, before they are taken off; 0 without any scan. */
  [[nodiscard]] double rangeOffset() const { return calibration_.rangeStd(); }          //!< [m]
  [[nodiscard]] double elevationOffset() const { return calibration_.elevationStd(); }  //!< [rad]
  [[nodiscard]] double azimuthOffset() const { return calibration_.azimuthStd(); }      //!< [rad]
  [[nodiscard]] double sideRangeOffset() const { return sides_.rangeOffset(); }         //!< [m]
  /** Adds what the beams tell about their calibration. */
  void addTo(CalibrationFindings& findings) const;

 private:
  // Columns of BeamPulls: those of the sides, then range, elevation and azimuth of each laser.
  static constexpr int kSideErrors = 6, kLaserErrors = kBeamErrors - kSideErrors, kOffsets = 3;
  static constexpr std::size_t kLaserColumns = kLaserErrors / kOffsets;

  /** The beams of one elevation. */
  struct Beam
  {
    // Of all scans: normal equations for the offsets of range and elevation alone.
    Eigen::Matrix<double, 2, 2, Eigen::DontAlign> information =
        Eigen::Matrix<double, 2, 2, Eigen::DontAlign>::Zero();
    Eigen::Matrix<double, 2, 1, Eigen::DontAlign> weighted =
        Eigen::Matrix<double, 2, 1, Eigen::DontAlign>::Zero();
    // Of the sampled scan: what the offsets add to sum w h z.
    Eigen::Matrix<double, 6, kOffsets, Eigen::DontAlign> in_sampled =
        Eigen::Matrix<double, 6, kOffsets, Eigen::DontAlign>::Zero();
  };
  struct SensorFrame;
  struct BeamLanes;

  [[nodiscard]] static BeamLanes beamsOf(
      const MeasurementBlock& block, const BodyPoints& body, const SensorFrame& frame);
  void add(const BeamView& beam, const PointMeasurement& point);
  [[nodiscard]] std::size_t columnOf(std::size_t bin) const;
  void beginSample();
  void finishSample(const Mat3& R_world_scan, const Matrix6& information);
  void chooseColumns(const BodyPoints& body);
  void sample(
      const BeamLanes& beams, std::size_t lane, const PointMeasurement& point,
      const PlaneMatch& match, const Vec3& point_world);
  void useCovariance();

  std::array<Beam, kBeamBins> beams_;
  BeamCalibration calibration_;
  IncidenceBias incidence_;
  SideErrors sides_;
  CreatingViews views_;
  std::size_t scans_ = 0;
  BeamPulls pulls_ = BeamPulls::Zero();  // of the sampled scan, in the axes of the body
  // Root of the covariance of the offsets of each column.
  Eigen::Matrix<double, kLaserErrors, kLaserErrors, Eigen::DontAlign> root_;
  std::size_t first_bin_ = 0, bins_per_column_ = 0;
  double upright_weight_ = 0.0, upright_range_ = 0.0;
};

}  // namespace fastlio
