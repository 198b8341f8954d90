// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_conditioner.h>
#include <fastlio/math/time.h>

#include <Eigen/LU>
#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
// The first samples determine the unit.
constexpr std::int64_t kUnitTimeNs = 200'000'000;
constexpr std::size_t kUnitFewest = 10, kUnitMost = 200;
// Below these, a value that repeats is no end of a range.
constexpr double kGyroFloor = 1.7;    // [rad/s]
constexpr double kAccelFloor = 17.0;  // [m/s^2]
// A clipped axis exceeds the full scale by an unknown amount: half of it covers knocks and jolts.
constexpr double kSaturationStd = 0.5;  // fraction of the full scale
// Three lost samples in a row are still bridged as jitter.
constexpr double kGapPeriods = 4.0;  // of the sampling period
// Jitter does not double an interval.
constexpr double kMissingPeriods = 1.8;
// How far the motion in a gap of imu.max_gap departs from the samples around it, where the samples
// before it do not show that.
constexpr InterpolationError kUnknownMotion{0.5235987755982988, 2.0};  // 30 deg/s
// The samples before a gap know nothing of a jolt in it: at least this part of the above.
constexpr double kLeastOfUnknown = 0.1;
// No platform changes its motion by so much for the time of one sample.
constexpr double kSpikeGyro = 10.471975511965978;  // [rad/s]; 600 deg/s
constexpr double kSpikeAccel = 100.0;              // [m/s^2]
}  // namespace

Mat3 sensorMatrix(const std::vector<double>& rows)
{
  if (rows.size() != 9) return Mat3::Identity();
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
}

ImuConditioner::ImuConditioner(const ImuOptions& parameters, double gravity)
    : parameters_(parameters),
      gravity_(gravity),
      units_{
          siPerUnit(parameters.accel_unit),
          siPerUnit(parameters.gyro_unit),
          parameters.accel_unit != AccelUnit::Auto,
          sensorMatrix(parameters.gyro_matrix).inverse(),
          sensorMatrix(parameters.accel_matrix).inverse(),
          !parameters.gyro_matrix.empty() || !parameters.accel_matrix.empty()},
      time_gate_(parameters.max_gap),
      spike_gate_(kSpikeGyro / siPerUnit(parameters.gyro_unit), kSpikeAccel),
      clipping_{
          ClippingDetector(parameters.gyro_range, kGyroFloor),
          ClippingDetector(parameters.accel_range, kAccelFloor),
          {},
          0}
{
  report_.accel_unit = parameters.accel_unit;
  report_.gyro_unit =
      parameters.gyro_unit == GyroUnit::Auto ? GyroUnit::Radians : parameters.gyro_unit;
}

const std::vector<ConditionedSample>& ImuConditioner::add(const ImuSample& raw)
{
  ready_.clear();
  if (!isTime(raw.stamp_ns))
  {
    ++report_.bad_stamps;
    return ready_;
  }
  if (units_.accel_known)
  {
    scaled(raw);
    return ready_;
  }
  without_unit_.push_back(raw);
  const bool long_enough = raw.stamp_ns - without_unit_.front().stamp_ns >= kUnitTimeNs;
  if ((long_enough && without_unit_.size() >= kUnitFewest) || without_unit_.size() >= kUnitMost)
    decideAccelUnit();
  return ready_;
}

const std::vector<ConditionedSample>& ImuConditioner::finish()
{
  ready_.clear();
  if (!without_unit_.empty()) decideAccelUnit();
  timed_.clear();
  time_gate_.finish(timed_);
  emitAll();
  gated_.clear();
  spike_gate_.finish(gated_);
  for (const TimedSample& timed : gated_)
    emit(timed);
  return ready_;
}

void ImuConditioner::decideAccelUnit()
{
  const AccelUnitVerdict verdict = findAccelUnit(without_unit_, gravity_);
  units_.accel_known = true;
  units_.accel_scale = siPerUnit(verdict.unit);
  report_.accel_unit = verdict.unit;
  const std::int64_t stamp_ns = without_unit_.front().stamp_ns;
  if (!verdict.clear)
    diagnostics_.push_back(
        {stamp_ns,
         mrpt::format(
             "the specific force has a magnitude of %.4g at the start: gravity in no known unit; "
             "taken as m/s^2 (imu.accel_unit)",
             verdict.norm)});
  else if (verdict.unit != AccelUnit::Si)
    diagnostics_.push_back(
        {stamp_ns, mrpt::format(
                       "the specific force is in units of %s (magnitude %.4g at the start): "
                       "converted to m/s^2; imu.accel_unit: %s says so beforehand",
                       toString(verdict.unit), verdict.norm, toString(verdict.unit))});
  std::vector<ImuSample> samples;
  samples.swap(without_unit_);
  for (const ImuSample& sample : samples)
    scaled(sample);
}

void ImuConditioner::scaled(ImuSample sample)
{
  // Not multiplied by 1: clean samples stay as they are, minus zeros included.
  if (units_.accel_scale != 1.0) sample.accel *= units_.accel_scale;
  if (parameters_.invert_acceleration) sample.accel = -sample.accel;
  const std::size_t steps = time_gate_.clockSteps();
  timed_.clear();
  time_gate_.push(sample, timed_);
  if (time_gate_.clockSteps() != steps) reportClockStep();
  emitAll();
}

void ImuConditioner::reportClockStep()
{
  const std::int64_t at_ns = timed_.empty() ? 0 : timed_.front().sample.stamp_ns;
  diagnostics_.push_back(
      {at_ns, mrpt::format(
                  "the clock was set back: %.3f s are added to the stamps from here on, as if it "
                  "had not been",
                  toSeconds(time_gate_.clockOffset()))});
}

void ImuConditioner::emitAll()
{
  gated_.clear();
  for (const TimedSample& timed : timed_)
    spike_gate_.push(timed, gated_);
  for (const TimedSample& timed : gated_)
    emit(timed);
}

/** The unit of the rates comes last: what waits in the gates is in that unit, too. */
void ImuConditioner::emit(TimedSample timed)
{
  if (units_.gyro_scale != 1.0) timed.sample.gyro *= units_.gyro_scale;
  ConditionedSample next;
  next.sample = timed.sample;
  next.after_break = timed.after_break;
  const auto last_ns = recent_.newestStamp();
  if (!last_ns || timed.sample.stamp_ns > *last_ns)
  {
    next.inflation = inflationBefore(timed);
    next.rescale_gyro = considerGyroUnit(next);
    if (next.rescale_gyro != 1.0) recent_ = RecentMotion();
    recent_.add(next.sample, next.inflation && next.inflation->fault == InertialFault::Gap);
  }
  if (units_.matrices)  // last: clipping shows in the axes of the sensor
  {
    next.sample.gyro = (units_.gyro_inverse * next.sample.gyro).eval();
    next.sample.accel = (units_.accel_inverse * next.sample.accel).eval();
  }
  ready_.push_back(next);
}

double ImuConditioner::considerGyroUnit(ConditionedSample& next)
{
  if (parameters_.gyro_unit != GyroUnit::Auto || report_.gyro_unit == GyroUnit::Degrees) return 1.0;
  gyro_unit_test_.add(next.sample, gravity_);
  if (!gyro_unit_test_.degrees()) return 1.0;
  report_.gyro_unit = GyroUnit::Degrees;
  units_.gyro_scale = siPerUnit(GyroUnit::Degrees);
  next.sample.gyro *= units_.gyro_scale;
  spike_gate_.setMaxGyro(kSpikeGyro / units_.gyro_scale);
  clipping_.gyro = ClippingDetector(parameters_.gyro_range, kGyroFloor);
  diagnostics_.push_back(
      {next.sample.stamp_ns,
       "the angular rate is in deg/s, not in rad/s (" + gyro_unit_test_.evidence() +
           "): converted, and the run starts anew here; imu.gyro_unit: deg/s avoids that"});
  return units_.gyro_scale;
}

std::optional<NoiseInflation> ImuConditioner::inflationBefore(const TimedSample& timed)
{
  const ImuSample& sample = timed.sample;
  auto inflation = clippingInflation(sample);
  const auto last_ns = recent_.newestStamp();
  if (!last_ns) return std::nullopt;
  const double interval = toSeconds(sample.stamp_ns - *last_ns);
  const double period = period_.median();
  if (!timed.after_break) period_.add(interval, kGapPeriods);
  const bool gap = timed.after_break || (period > 0.0 && interval > kGapPeriods * period);
  const bool spike = spike_gate_.latestSpike() > *last_ns;
  if (!timed.after_break && period > 0.0 && interval > kMissingPeriods * period)
    report_.missing += static_cast<std::size_t>(std::lround(interval / period)) - 1;
  if (gap)
  {
    ++report_.gaps;
    report_.longest_gap = std::max(report_.longest_gap, interval);
  }
  if (!gap && !spike) return inflation;
  const InterpolationError error = interpolationError(timed);
  return NoiseInflation{
      *last_ns, sample.stamp_ns, error.gyro_std, error.accel_std,
      gap ? InertialFault::Gap : InertialFault::Spike};
}

InterpolationError ImuConditioner::interpolationError(const TimedSample& timed) const
{
  // The effect of the motion in between grows with the time.
  const double interval = toSeconds(timed.sample.stamp_ns - *recent_.newestStamp());
  const double fraction = std::min(1.0, interval / parameters_.max_gap);
  const InterpolationError unknown{
      fraction * kUnknownMotion.gyro_std, fraction * kUnknownMotion.accel_std};
  const auto measured = recent_.errorUntil(timed.sample);
  if (!measured) return unknown;
  const double least = timed.after_break ? 1.0 : kLeastOfUnknown;
  return {
      std::max(measured->gyro_std, least * unknown.gyro_std),
      std::max(measured->accel_std, least * unknown.accel_std)};
}

/** The noise of an input between two samples is inflated when that of one of them is. */
std::optional<NoiseInflation> ImuConditioner::clippingInflation(const ImuSample& sample)
{
  Clipping& c = clipping_;
  const bool held = c.repeated.add(sample, diagnostics_);
  const double gyro = c.gyro.add(sample.gyro, held), accel = c.accel.add(sample.accel, held);
  reportClipping(sample.stamp_ns);
  const double gyro_between = std::max(gyro, c.gyro.before());
  const double accel_between = std::max(accel, c.accel.before());
  if (gyro > 0.0 || accel > 0.0) ++report_.saturated;
  const auto last_ns = recent_.newestStamp();
  c.rates_in_a_row = gyro_between > 0.0 ? c.rates_in_a_row + 1 : 0;
  if (!last_ns || (gyro_between == 0.0 && accel_between == 0.0)) return std::nullopt;
  return NoiseInflation{
      *last_ns,
      sample.stamp_ns,
      kSaturationStd * gyro_between,
      kSaturationStd * accel_between,
      InertialFault::Saturation,
      std::max(1, c.rates_in_a_row)};
}

void ImuConditioner::reportClipping(std::int64_t stamp_ns)
{
  const auto report = [&](ClippingDetector& detector, const char* what, const char* unit)
  {
    const std::optional<RangeEnd> end = detector.takeFound();
    if (!end) return;
    const char axis = "xyz"[static_cast<std::size_t>(end->axis)];
    diagnostics_.push_back(
        {stamp_ns,
         mrpt::format(
             "%s %.4g %s: readings of its axis %c stay at %.4g and never go beyond. "
             "Clipped samples are trusted less; give the sensor, or the driver, a larger range",
             what, std::abs(end->value), unit, axis, end->value)});
  };
  report(clipping_.gyro, "the gyro clips at", "rad/s");
  report(clipping_.accel, "the accelerometer clips at", "m/s^2");
}

ImuReport ImuConditioner::report() const
{
  ImuReport report = report_;
  report.rate = period_.median() > 0.0 ? 1.0 / period_.median() : 0.0;
  report.jitter = period_.jitter();
  report.spikes = spike_gate_.spikes();
  report.bad_stamps += time_gate_.badStamps();
  report.late = time_gate_.late();
  report.clock_steps = time_gate_.clockSteps();
  return report;
}

std::vector<Diagnostic> ImuConditioner::takeDiagnostics()
{
  return std::exchange(diagnostics_, {});
}

}  // namespace fastlio
