// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_conditioner.h From raw inertial samples to samples that the filter can trust, and
 * spans of time in which it should not. */
#pragma once

#include <fastlio/imu/imu_clipping.h>
#include <fastlio/imu/imu_options.h>
#include <fastlio/imu/imu_report.h>
#include <fastlio/imu/imu_spike_gate.h>
#include <fastlio/imu/imu_time_gate.h>
#include <fastlio/imu/noise_inflation.h>
#include <fastlio/imu/recent_motion.h>
#include <fastlio/imu/repeated_readings.h>
#include <fastlio/imu/sampling_period.h>
#include <fastlio/math/time.h>

#include <optional>
#include <vector>

namespace fastlio
{
/** A sample in SI units, and what happened between it and the one before. */
struct ConditionedSample
{
  ImuSample sample;
  std::optional<NoiseInflation> inflation;
  bool after_break = false;   //!< more than imu.max_gap after the one before
  double rescale_gyro = 1.0;  //!< factor for the rates of all samples before: their unit was wrong
};

/** The stages: unit, stamps, spikes, gaps, clipping and the sensors' matrices. Clean samples come
 * out as they came in. */
class ImuConditioner
{
 public:
  /** \param gravity its magnitude [m/s^2] */
  ImuConditioner(const ImuOptions& parameters, double gravity);

  /** Takes a raw sample of finite numbers.
   * \return the samples that are ready now; valid until the next call */
  const std::vector<ConditionedSample>& add(const ImuSample& raw);
  /** Nothing more will come: what waits for a successor or for the unit is ready. */
  const std::vector<ConditionedSample>& finish();

  [[nodiscard]] ImuReport report() const;
  /** Added to the stamps, since the clock was set back [ns]. */
  [[nodiscard]] std::int64_t clockOffset() const { return time_gate_.clockOffset(); }
  /** The diagnostics since the last call. */
  [[nodiscard]] std::vector<Diagnostic> takeDiagnostics();

 private:
  /** The factor on readings. */
  struct Units
  {
    double accel_scale = 1.0, gyro_scale = 1.0;
    bool accel_known = false;
    Mat3 gyro_inverse = Mat3::Identity(), accel_inverse = Mat3::Identity();  // of the matrices
    bool matrices = false;
  };

  /** Looks for clipped readings of both sensors. */
  struct Clipping
  {
    ClippingDetector gyro, accel;
    RepeatedReadings repeated;  // a held one is no end of the range
    int rates_in_a_row = 0;     // that are clipped: a turn beyond the range is off to one side
  };

  void decideAccelUnit();
  void scaled(ImuSample sample);
  void emit(TimedSample timed);
  void emitAll();
  void reportClockStep();
  void reportClipping(std::int64_t stamp_ns);
  [[nodiscard]] double considerGyroUnit(ConditionedSample& next);
  [[nodiscard]] std::optional<NoiseInflation> inflationBefore(const TimedSample& timed);
  [[nodiscard]] InterpolationError interpolationError(const TimedSample& timed) const;
  [[nodiscard]] std::optional<NoiseInflation> clippingInflation(const ImuSample& sample);

  ImuOptions parameters_;
  double gravity_;
  Units units_;
  ImuReport report_;
  std::vector<ImuSample> without_unit_;
  ImuTimeGate time_gate_;
  ImuSpikeGate spike_gate_;
  SamplingPeriod period_;
  Clipping clipping_;
  GyroUnitTest gyro_unit_test_;
  RecentMotion recent_;
  std::vector<Diagnostic> diagnostics_;
  std::vector<TimedSample> timed_, gated_;
  std::vector<ConditionedSample> ready_;
};

}  // namespace fastlio
