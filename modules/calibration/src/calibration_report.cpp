// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/calibration/calibration_report.h>
#include <fastlio/config/config_document.h>
#include <fastlio/math/angles.h>

#include <mrpt/core/format.h>

#include <array>
#include <cmath>
#include <sstream>

namespace fastlio
{
namespace
{
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
constexpr double kDetermined = 0.5;  // of what was known before
constexpr double kMillimetres = 1e3, kPercent = 100.0;

using Combination = Eigen::Matrix<double, 1, kCalibrationErrorDim>;

/** The rotation of the LiDAR about an axis, less that of the gyro's axes. */
Combination rotationAgainstGyro(int axis)
{
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  Combination c = Combination::Zero();
  c[kExtrinsicError + axis] = 1.0;
  c[kGyroMatrixError + 3 * a + b] = -0.5;
  c[kGyroMatrixError + 3 * b + a] = 0.5;
  return c;
}

double stdOf(const Combination& c, const CalibrationErrorMatrix& covariance)
{
  return std::sqrt(std::max(0.0, (c * covariance * c.transpose()).value()));
}

double stdOf(const Combination& c, const CalibrationErrorVector& std)
{
  return std::sqrt((c.transpose().array() * std.array()).square().sum());
}

/** Makes a row of a combination of theta; found less given is minus what was taken off. */
class RowMaker
{
 public:
  explicit RowMaker(const RigEstimate& estimate) : estimate_(estimate) {}

  [[nodiscard]] CalibrationRow row(
      std::string name, std::string unit, double per_unit, double given, const Combination& c,
      double sign, const std::string& advice) const
  {
    CalibrationRow row;
    row.name = std::move(name);
    row.unit = std::move(unit);
    row.given = per_unit * given;
    row.found = row.given + sign * per_unit * (c * estimate_.correction).value();
    row.std = per_unit * stdOf(c, estimate_.covariance);
    row.prior_std = per_unit * stdOf(c, estimate_.prior_std);
    if (!row.determined()) row.advice = advice;
    return row;
  }

 private:
  const RigEstimate& estimate_;
};

std::string ofAxis(const char* text, int axis)
{
  return mrpt::format(text, kAxes[static_cast<std::size_t>(axis)]);
}

Combination element(int index)
{
  Combination c = Combination::Zero();
  c[index] = 1.0;
  return c;
}

/** Which motion, or which place, would tell the position of the LiDAR along an axis. */
std::string positionAdvice(const RigEstimate& estimate, int axis)
{
  const int i = kExtrinsicError + 3 + axis;
  const double hidden = estimate.hidden_by_elevations[axis];
  const double seen = std::sqrt(std::max(0.0, estimate.covariance(i, i) - hidden * hidden));
  if (seen < kDetermined * estimate.prior_std[i])
    return "calibrate in a room: far walls do not tell it from elevations that are all off";
  return ofAxis(
      "turn about an axis across the IMU's %s axis, back and forth for ten seconds", axis);
}

CalibrationRow incidenceRow(const RigEstimate& estimate)
{
  CalibrationRow row;
  row.name = "range at 80 deg of incidence";
  row.unit = "mm";
  row.found = kMillimetres * estimate.incidence.value;
  row.std = kMillimetres * estimate.incidence.std;
  row.prior_std = kMillimetres * estimate.incidence.prior_std;
  if (!row.determined()) row.advice = "pass walls and ground, so that each is seen at many angles";
  return row;
}

CalibrationRow timeRow(const Rig& given, const RigEstimate& estimate)
{
  CalibrationRow row;
  row.name = "time offset (lidar.time_offset)";
  row.unit = "ms";
  row.given = kMillimetres * given.time_offset;
  row.found = kMillimetres * estimate.rig.time_offset;
  row.std = kMillimetres * estimate.time_offset_std;
  row.prior_std = kMillimetres * kTimeOffsetPriorStd;
  row.advice = estimate.clocks;
  if (!row.determined() && row.advice.empty())
    row.advice = "turn back and forth, with changing speed, for ten seconds";
  return row;
}

/** A noise density, in thousandths of its unit. */
CalibrationRow noiseRow(
    const char* name, const char* unit, double given, const MeasuredDensity& found,
    const std::string& advice)
{
  constexpr double kThousandths = 1e3;
  CalibrationRow row;
  row.name = name;
  row.unit = unit;
  row.given = kThousandths * given;
  row.found = kThousandths * (found.determined ? found.value : given);
  row.std = found.determined ? kThousandths * found.std : 0.0;
  if (!found.determined) row.advice = advice;
  return row;
}

void addNoiseRows(const RigEstimate& estimate, std::vector<CalibrationRow>& rows)
{
  constexpr double kRestForWhite = 5.0;  // [s]
  const InertialNoise& found = estimate.noise;
  const ImuNoise& given = estimate.given_noise;
  const auto advice = [](const SensorNoise& noise, double seconds)
  {
    const bool moved = noise.white.value > 0.0 && !noise.still;
    return mrpt::format(
        moved ? "the rig was not still: lay it down for %.0f s" : "lay the rig down for %.0f s",
        seconds);
  };
  const auto add = [&](const SensorNoise& noise, double white, double walk, const char* white_name,
                       const char* white_unit, const char* walk_name, const char* walk_unit)
  {
    rows.push_back(
        noiseRow(white_name, white_unit, white, noise.white, advice(noise, kRestForWhite)));
    const double density = noise.white.determined ? noise.white.value : white;
    rows.push_back(noiseRow(
        walk_name, walk_unit, walk, noise.walk, advice(noise, restForWalk(density, walk))));
  };
  add(found.gyro, given.gyro_noise_density, given.gyro_bias_walk, "imu.gyro_noise_density",
      "1e-3 rad/s/sqrt(Hz)", "imu.gyro_bias_walk", "1e-3 rad/s^2/sqrt(Hz)");
  add(found.accel, given.accel_noise_density, given.accel_bias_walk, "imu.accel_noise_density",
      "1e-3 m/s^2/sqrt(Hz)", "imu.accel_bias_walk", "1e-3 m/s^3/sqrt(Hz)");
}

/** In a column of nine; zero: unknown. */
std::string stdText(double std)
{
  return std > 0.0 ? mrpt::format("%9.3f", std) : "        -";
}

/** Text as lines of a YAML comment. */
std::string commented(const std::string& text)
{
  std::istringstream lines(text);
  std::string comment;
  for (std::string line; std::getline(lines, line);)
    comment += line.empty() ? "#\n" : "# " + line + "\n";
  return comment;
}
}  // namespace

bool CalibrationRow::determined() const
{
  return advice.empty() && (prior_std == 0.0 || std < kDetermined * prior_std);
}

std::vector<CalibrationRow> calibrationRows(const Rig& given, const RigEstimate& estimate)
{
  const RowMaker make(estimate);
  std::vector<CalibrationRow> rows;
  rows.reserve(4 * kAxes.size() + 2);
  for (int axis = 0; axis < 3; ++axis)
    rows.push_back(make.row(
        ofAxis("LiDAR against gyro, turn about %s", axis), "deg", 1.0 / kRadPerDeg, 0.0,
        rotationAgainstGyro(axis), -1.0,
        ofAxis(
            "turn about an axis across the IMU's %s axis, back and forth for ten seconds", axis)));
  for (int axis = 0; axis < 3; ++axis)
    rows.push_back(make.row(
        ofAxis("LiDAR in the IMU frame, %s", axis), "mm", kMillimetres, given.T_imu_lidar.p[axis],
        element(kExtrinsicError + 3 + axis), -1.0, positionAdvice(estimate, axis)));
  for (int axis = 0; axis < 3; ++axis)
    rows.push_back(make.row(
        ofAxis("gyro scale %s", axis), "%", kPercent, given.gyro_matrix(axis, axis) - 1.0,
        element(kGyroMatrixError + 4 * axis), 1.0,
        ofAxis("turn about the IMU's %s axis, by 90 deg and more, back and forth", axis)));
  for (int axis = 0; axis < 3; ++axis)
    rows.push_back(make.row(
        ofAxis("accelerometer scale %s", axis), "%", kPercent, given.accel_matrix(axis, axis) - 1.0,
        element(kAccelMatrixError + 4 * axis), 1.0,
        ofAxis("hold the IMU's %s axis up for some seconds, then down", axis)));
  rows.push_back(timeRow(given, estimate));
  rows.push_back(incidenceRow(estimate));
  addNoiseRows(estimate, rows);
  return rows;
}

std::string calibrationTable(const Rig& given, const RigEstimate& estimate)
{
  std::string text = describeStart(estimate);
  if (!text.empty()) text += "\n\n";
  text += mrpt::format(
      "%-36s %10s %10s %9s %9s  unit\n", "value", "given", "found", "std", "prior std");
  for (const CalibrationRow& row : calibrationRows(given, estimate))
    text += mrpt::format(
        "%-36s %10.3f %10.3f %s %s  %s%s\n", row.name.c_str(), row.given, row.found,
        stdText(row.std).c_str(), stdText(row.prior_std).c_str(), row.unit.c_str(),
        row.determined() ? "" : ("  not determined: " + row.advice).c_str());
  text += mrpt::format("\nnoise densities: %.1f s at rest\n", estimate.noise.rest_seconds);
  text += mrpt::format(
      "\n%-36s %10s %10s %10s %10s\n", "beams by elevation [deg]", "range [mm]", "std",
      "elev. [deg]", "std");
  for (std::size_t i = 0; i < estimate.rig.beams.size() && i < estimate.beam_stds.size(); ++i)
  {
    const BeamRow& beam = estimate.rig.beams[i];
    text += mrpt::format(
        "%-36.1f %10.1f %10.1f %10.3f %10.3f\n", beam.elevation / kRadPerDeg,
        kMillimetres * beam.range, kMillimetres * estimate.beam_stds[i].range,
        beam.elevation_offset / kRadPerDeg, estimate.beam_stds[i].elevation / kRadPerDeg);
  }
  return text;
}

std::string describeStart(const RigEstimate& estimate)
{
  if (estimate.rotation_contradiction == 0.0) return {};
  return mrpt::format(
      "The given poses turn the LiDAR by %.0f deg from what the motions of LiDAR and IMU show. The "
      "calibration began with the rotation that they show.",
      estimate.rotation_contradiction / kRadPerDeg);
}

std::string describe(const CalibrationTrial& trial)
{
  const std::string verdict =
      trial.worthUsing() ? "use it."
      : trial.better()
          ? "it cannot be trusted, because scans err more than they say. Calibrate where there are "
            "walls rather than leaves, and where little moves."
          : "it is not better than what was given.";
  return mrpt::format(
             "On %.0f s of data that it was not fitted to, the normalised innovations go from %.2f "
             "to %.2f and the map's thickness goes from %.1f to %.1f mm: ",
             trial.seconds, trial.before.innovation(), trial.after.innovation(),
             kMillimetres * trial.before.mapThickness(),
             kMillimetres * trial.after.mapThickness()) +
         verdict;
}

std::string calibrationYaml(
    const Config& calibrated, const Rig& given, const RigEstimate& estimate,
    const std::optional<CalibrationTrial>& trial)
{
  std::string header = std::string(kCalibrationMark) + "; see docs/calibration.md.\n";
  if (trial) header += commented(describe(*trial));
  header += "#\n" + commented(calibrationTable(given, estimate));
  return toYaml(calibrated, header);
}

}  // namespace fastlio
