// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/number_text.h>
#include <fastlio/tuning/map_thickness.h>
#include <fastlio/tuning/run_measures.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace fastlio
{
namespace
{
using Row = std::vector<std::string>;

Row split(const std::string& line)
{
  Row row(1);
  for (const char c : line)
    if (c == ',')
      row.emplace_back();
    else
      row.back() += c;
  return row;
}

/** A table of a run by the names of its columns. */
class Table
{
 public:
  explicit Table(const std::string& path) : path_(path)
  {
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);)
      if (line.empty() || line[0] == '#')
        continue;
      else if (names_.empty())
        names_ = split(line);
      else
        rows_.push_back(split(line));
    if (names_.empty()) throw std::runtime_error("'" + path + "' is no table");
  }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const std::string& text(std::size_t row, const std::string& name) const
  {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) throw std::runtime_error("'" + path_ + "' has no column " + name);
    return rows_.at(row).at(static_cast<std::size_t>(found - names_.begin()));
  }
  [[nodiscard]] double number(std::size_t row, const std::string& name) const
  {
    return parsed<double>(text(row, name)).value_or(NAN);
  }
  [[nodiscard]] Vec3 vector(
      std::size_t row, const std::string& x, const std::string& y, const std::string& z) const
  {
    return {number(row, x), number(row, y), number(row, z)};
  }

 private:
  std::string path_;
  Row names_;
  std::vector<Row> rows_;
};

void addTiming(const Table& t, Measures& m)
{
  double residual = 0, effective = 0, points = 0, nis = 0, n = 0, iterations = 0, info = 0,
         loglik = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
  {
    if (t.text(i, "status") != "tracking") continue;
    n += 1;
    const double r = t.number(i, "residual_rms");
    const double z = t.number(i, "normalized_innovation");
    residual += r * r;
    nis += z;
    loglik += std::log(std::max(1e-12, r * r / std::max(1e-12, z))) + z;
    effective += t.number(i, "points_effective");
    points += t.number(i, "points_downsampled");
    iterations += t.number(i, "iterations");
    info += std::log(std::max(1e-9, t.number(i, "information_min")));
  }
  if (n < 1) return;
  m["residual"] = std::sqrt(residual / n);
  m["nis"] = nis / n;
  m["nis_off"] = std::abs(std::log(std::max(1e-9, nis / n)));
  m["likelihood"] = loglik / n;
  m["outliers"] = 1 - effective / points;
  m["iterations"] = iterations / n;
  m["uninformed"] = -info / n;
}

void addStates(const Table& t, Measures& m)
{
  double correction = 0, n = 0, gyro = 0, accel = 0, jerk = 0, acc = 0;
  Vec3 last_mismatch = Vec3::Zero();
  double white = 0;
  for (std::size_t i = 1; i < t.size(); ++i)
  {
    const double dt = 1e-9 * (t.number(i, "stamp_ns") - t.number(i - 1, "stamp_ns"));
    if (!(dt > 0) || dt > 0.5) continue;
    const Vec3 p0 = t.vector(i - 1, "x", "y", "z"), p1 = t.vector(i, "x", "y", "z");
    const Vec3 v0 = t.vector(i - 1, "vx", "vy", "vz"), v1 = t.vector(i, "vx", "vy", "vz");
    const Vec3 mismatch = (p1 - p0) / dt - 0.5 * (v0 + v1);
    correction += mismatch.squaredNorm();
    white += mismatch.dot(last_mismatch);
    jerk += (mismatch - last_mismatch).squaredNorm();
    last_mismatch = mismatch;
    gyro += (t.vector(i, "bgx", "bgy", "bgz") - t.vector(i - 1, "bgx", "bgy", "bgz")).squaredNorm();
    accel +=
        (t.vector(i, "bax", "bay", "baz") - t.vector(i - 1, "bax", "bay", "baz")).squaredNorm();
    acc += ((v1 - v0) / dt).squaredNorm();
    n += 1;
  }
  if (n < 1) return;
  m["correction"] = std::sqrt(correction / n);
  m["jerk"] = std::sqrt(jerk / n);
  m["white"] = white / correction;
  m["gyro_bias"] = std::sqrt(gyro / n);
  m["accel_bias"] = std::sqrt(accel / n);
  m["acc"] = std::sqrt(acc / n);
}

/** Displacement over a span minus the integral of the velocity. */
void addSpan(const Table& t, double span, const std::string& name, Measures& m)
{
  std::vector<double> time;
  std::vector<Vec3> mismatch(1, Vec3::Zero());
  for (std::size_t i = 0; i < t.size(); ++i)
  {
    time.push_back(1e-9 * (t.number(i, "stamp_ns") - t.number(0, "stamp_ns")));
    if (i == 0) continue;
    const double dt = time[i] - time[i - 1];
    const Vec3 step = t.vector(i, "x", "y", "z") - t.vector(i - 1, "x", "y", "z") -
                      0.5 * dt * (t.vector(i, "vx", "vy", "vz") + t.vector(i - 1, "vx", "vy", "vz"));
    mismatch.push_back(mismatch.back() + step);
  }
  double sum = 0, n = 0;
  std::size_t j = 0;
  for (std::size_t i = 0; i < time.size(); ++i)
  {
    while (j < time.size() && time[j] < time[i] + span) ++j;
    if (j == time.size()) break;
    sum += ((mismatch[j] - mismatch[i]) / (time[j] - time[i])).squaredNorm();
    n += 1;
  }
  if (n > 0) m[name] = std::sqrt(sum / n);
}
}  // namespace

Measures measuresOfRun(const std::string& folder)
{
  Measures m;
  addTiming(Table(folder + "/timing.csv"), m);
  const Table states(folder + "/states.csv");
  addStates(states, m);
  addSpan(states, 0.45, "span05", m);
  addSpan(states, 0.95, "span1", m);
  addSpan(states, 1.95, "span2", m);
  addSpan(states, 4.95, "span5", m);
  const auto points = readRunMap(folder + "/map.ply");
  const MapSharpness map = mapSharpness(points);
  for (const double size : {0.4, 0.6, 1.2})
  {
    const MapSharpness other = mapSharpness(points, size);
    const std::string n = std::to_string(static_cast<int>(10 * size + 0.5));
    m["thickness" + n] = other.thickness;
    m["entropy" + n] = other.entropy;
    m["revisit" + n] = other.revisit;
  }
  m["thickness"] = map.thickness;
  m["revisit"] = map.revisit;
  m["entropy"] = map.entropy;
  m["volume"] = map.cells;
  m["surfaces"] = map.surfaces;
  m["per_point"] = map.surfaces > 0 ? map.cells / map.surfaces : 0;
  return m;
}

}  // namespace fastlio
