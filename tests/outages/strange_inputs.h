// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file strange_inputs.h What a sensor may be like after a fault. */
#pragma once

#include "simulated_run.h"
#include <fastlio/math/angles.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace fastlio::testing
{
inline constexpr double kGravity = 9.80665;

struct StrangeInput
{
  std::string name;
  double length_s;
  std::function<void(ImuSample&)> imu = [](ImuSample&) {};
  std::function<bool(LidarScan&)> scan = [](LidarScan&) { return true; };
};

/** Points of the scan for which a condition holds. */
template <typename Condition>
bool keepIf(LidarScan& scan, const Condition& condition)
{
  const PointColumns all = std::exchange(scan.points, {});
  for (std::size_t i = 0; i < all.size(); ++i)
    if (condition(all.x[i], all.y[i], all.z[i]))
      scan.points.push_back(
          all.x[i], all.y[i], all.z[i], all.intensity[i], all.time_offset_ns[i], all.ring[i]);
  return true;
}

/** Something that moves with the sensor stands around it: a box without a lid. */
inline bool boxAround(LidarScan& scan, double half_width)
{
  PointColumns& points = scan.points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double across = std::max(std::abs(points.x[i]), std::abs(points.y[i]));
    const auto scale = static_cast<float>(half_width / std::max(across, 1e-3));
    points.x[i] *= scale, points.y[i] *= scale, points.z[i] *= scale;
  }
  return true;
}

inline bool reversedTimes(LidarScan& scan)
{
  auto& times = scan.points.time_offset_ns;
  if (times.empty()) return true;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  const auto sum = *first + *last;
  for (auto& time : times)
    time = sum - time;
  return true;
}

inline bool pointsInAPlane(LidarScan& scan)
{
  for (float& z : scan.points.z)
    z = -1.0F;
  return true;
}

inline constexpr double kForever = 1e3;  // [s]

inline std::vector<StrangeInput> strangeImus()
{
  std::vector<StrangeInput> all;
  const auto imu = [&](const char* name, double length, std::function<void(ImuSample&)> change) {
    all.push_back({name, length, std::move(change)});
  };
  imu("gyro in deg/s", kForever, [](ImuSample& s) { s.gyro *= kDegPerRad; });
  imu("rate 10 % too high", kForever, [](ImuSample& s) { s.gyro *= 1.1; });
  imu("rate 5 % too high", kForever, [](ImuSample& s) { s.gyro *= 1.05; });
  imu("rate 20 % too low", kForever, [](ImuSample& s) { s.gyro *= 0.8; });
  imu("accelerometer 5 % too high", kForever, [](ImuSample& s) { s.accel *= 1.05; });
  imu("accelerometer in g", kForever, [](ImuSample& s) { s.accel /= kGravity; });
  imu("axes x and y exchanged", kForever,
      [](ImuSample& s)
      {
        std::swap(s.gyro.x(), s.gyro.y());
        std::swap(s.accel.x(), s.accel.y());
      });
  imu("rate about z inverted", kForever, [](ImuSample& s) { s.gyro.z() *= -1.0; });
  imu("dead gyro about z", kForever, [](ImuSample& s) { s.gyro.z() = 0.0; });
  imu("dead gyro", 3.0, [](ImuSample& s) { s.gyro.setZero(); });
  imu("dead accelerometer", kForever, [](ImuSample& s) { s.accel.setZero(); });
  imu("IMU stuck", kForever,
      [kept = ImuSample{}](ImuSample& s) mutable
      {
        if (kept.stamp_ns == 0) kept = s;
        s.gyro = kept.gyro, s.accel = kept.accel;
      });
  imu("two IMUs in turn, one turned by 90 deg", kForever,
      [n = 0](ImuSample& s) mutable
      {
        if (++n % 2 == 0) return;
        s.gyro = Vec3(-s.gyro.y(), s.gyro.x(), s.gyro.z());
        s.accel = Vec3(-s.accel.y(), s.accel.x(), s.accel.z());
      });
  return all;
}

inline std::vector<StrangeInput> strangeScans()
{
  std::vector<StrangeInput> all;
  const auto scan = [&](const std::string& name, double length,
                        std::function<bool(LidarScan&)> change) {
    all.push_back({name, length, [](ImuSample&) {}, std::move(change)});
  };
  scan("point times reversed", kForever, reversedTimes);
  for (const int late_ms : {100, 50, 20, -100, -50, -20})
    scan(
        "scans late by " + std::to_string(late_ms) + " ms", kForever,
        [late_ms](LidarScan& s)
        {
          s.stamp_ns += late_ms * std::int64_t{1'000'000};
          return true;
        });
  scan("every second scan missing", kForever, [n = 0](LidarScan&) mutable { return ++n % 2 == 0; });
  scan("one scan in ten", 8.0, [n = 0](LidarScan&) mutable { return ++n % 10 == 0; });
  scan(
      "half of the view", kForever,
      [](LidarScan& s) { return keepIf(s, [](float x, float, float) { return x > 0.0F; }); });
  scan(
      "a quarter of the view", 6.0,
      [](LidarScan& s)
      { return keepIf(s, [](float x, float y, float) { return x > std::abs(y); }); });
  scan("a box around the LiDAR", 3.0, [](LidarScan& s) { return boxAround(s, 0.6); });
  scan("a cabin around the LiDAR", 8.0, [](LidarScan& s) { return boxAround(s, 2.0); });
  scan(
      "scans frozen", 8.0,
      [kept = PointColumns{}](LidarScan& s) mutable
      {
        if (kept.size() == 0) kept = s.points;
        s.points = kept;
        return true;
      });
  scan("points in a plane", kForever, pointsInAPlane);
  scan(
      "mirrored points", kForever,
      [](LidarScan& s)
      {
        for (float& y : s.points.y)
          y = -y;
        return true;
      });
  scan(
      "ranges 5 % too long", kForever,
      [](LidarScan& s)
      {
        for (auto* column : {&s.points.x, &s.points.y, &s.points.z})
          for (float& value : *column)
            value *= 1.05F;
        return true;
      });
  return all;
}

}  // namespace fastlio::testing
