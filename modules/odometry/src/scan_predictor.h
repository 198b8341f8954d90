// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_predictor.h The prediction for a scan's end, and the states on the way to it. */
#pragma once

#include "prediction.h"
#include "rate_in_gap.h"
#include <fastlio/imu/imu_buffer.h>
#include <fastlio/imu/noise_measurement.h>
#include <fastlio/interface/imu_rate.h>
#include <fastlio/interface/odometry_options.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace fastlio
{
/** The state at a scan's end before the scan is looked at. */
struct ScanPrediction
{
  double blind_s = 0.0;   //!< since the scan before [s]
  double unseen_s = 0.0;  //!< since a scan before that had points enough to be matched [s]
  FilterState state;
  ErrorTransition transition;
  bool finite = true;      //!< else the state is the one before: the inertial data overflowed it
  double imu_gap_s = 0.0;  //!< longest one on the way
  /** Both sensors were silent at once: their data are lost, or their clock was set ahead. The data
   * look the same. */
  std::int64_t silent_ns = 0;
  bool clock_stepped = false;     //!< the state is that of a clock that was set ahead
  double gap_rotation_std = 0.0;  //!< of the rotation in the scan, by missing samples [rad]
  double end_rotation_std = 0.0;  //!< of the scan's end by the scan's match, likewise [rad]
};

/** A state and its instant. */
struct StampedState
{
  FilterState filter;
  std::int64_t stamp_ns = 0;
};

/** What systematic errors add to the covariance after a prediction. */
using SystematicCovariance = std::function<StateMatrix(const Prediction&)>;

/** Propagates a state through inertial samples (eq. 4-8); keeps the storage between scans. */
class ScanPredictor
{
 public:
  explicit ScanPredictor(const OdometryOptions& options)
      : imu_(options.imu),
        clock_walk_(options.calibration.time_offset_walk),
        imu_rate_wanted_(options.imu_rate)
  {
  }

  /** To a scan's end. \param begin_ns of the scan \param systematic is added to the covariance at
   * inertial rate
   * \param trusted states at inertial rate are to be believed */
  [[nodiscard]] ScanPrediction predict(
      const StampedState& from, std::int64_t begin_ns, std::int64_t end_ns, const ImuBuffer& imu,
      const SystematicCovariance& systematic, bool trusted);

  /** The same if no time has passed in the silence. \param with_silence what predict() gave */
  [[nodiscard]] ScanPrediction afterClockStep(
      const StampedState& from, std::int64_t end_ns, const ImuBuffer& imu,
      const ScanPrediction& with_silence);

  /** The same with other angular rates where samples are missing, in this prediction and in those
   * after it until samples come again. \param rate_error is added to them [rad/s]
   * \param with_gap what predict() gave; it goes on saying how uncertain the state is */
  [[nodiscard]] ScanPrediction withRateInGap(
      const StampedState& from, std::int64_t end_ns, const ImuBuffer& imu, const Vec3& rate_error,
      const ScanPrediction& with_gap);

  /** What the scans of a gap have shown; empty where no sample is missing. */
  [[nodiscard]] RateInGap& rateInGap() { return rate_in_gap_; }

  /** To the newest inertial sample; nothing when the state is newer. */
  [[nodiscard]] std::optional<ImuRateState> predictNewest(
      const StampedState& from, const ImuBuffer& imu, const SystematicCovariance& systematic);

  /** The inertial samples of the last prediction, each holding from its stamp on. */
  [[nodiscard]] const std::vector<ImuSample>& inputs() const { return inputs_; }
  /** The last predict() at each inertial sample on the way (output.imu_rate). */
  [[nodiscard]] const std::vector<ImuRateState>& imuRateStates() const { return imu_rate_; }
  void clearImuRateStates() { imu_rate_.clear(); }

 private:
  [[nodiscard]] Prediction fromTo(
      const FilterState& from, std::int64_t begin_ns, std::int64_t end_ns, const ImuBuffer& imu);
  void addToRatesInGap(std::int64_t end_ns, const ImuBuffer& imu, const Vec3& rate);
  [[nodiscard]] FilterState admitClockStep(
      const StampedState& from, std::int64_t silent_ns, const ImuBuffer& imu);

  ImuOptions imu_;
  double clock_walk_;  // CalibrationOptions::time_offset_walk
  bool imu_rate_wanted_;
  NoiseMeasurement noise_;
  std::vector<ImuSample> inputs_;
  RateInGap rate_in_gap_;
  std::vector<ImuSample> aside_;  // of fromTo()
  std::vector<ImuRateState> imu_rate_;
};

}  // namespace fastlio
