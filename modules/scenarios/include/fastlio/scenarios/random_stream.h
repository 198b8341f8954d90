// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file random_stream.h Independent random numbers per purpose, so that switching one source of
 * noise on leaves all others as they were. */
#pragma once

#include <fastlio/math/so3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace fastlio
{
/** The uses of random numbers. */
enum class NoiseSource : std::uint32_t
{
  GyroBias = 1,
  AccelBias,
  GyroWhite,
  AccelWhite,
  GyroWalk,
  AccelWalk,
  StampJitter,
  ImuDropout,
  Vibration,
  Range,
  RangeDropout,
  ImuErrors,
  LaserRange,
  LaserElevation,
  Mounting,
  CarrierVibration,
  FalseReturn,
  PacketLoss,
  Outage,
  GnssWhite,
  GnssDrift,
  GnssOutage,
  GnssMultipath,
  Wheels,
  Session,
  LaserAzimuth
};

/** A sequence that depends on seed, source and index only. */
class RandomStream
{
 public:
  RandomStream(std::uint64_t seed, NoiseSource source, std::uint64_t index = 0)
  {
    std::seed_seq sequence{
        static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
        static_cast<std::uint32_t>(source), static_cast<std::uint32_t>(index),
        static_cast<std::uint32_t>(index >> 32U)};
    engine_.seed(sequence);
  }

  /** Standard normal. */
  [[nodiscard]] double normal() { return normal_(engine_); }
  /** In [0, 1). */
  [[nodiscard]] double uniform() { return uniform_(engine_); }
  [[nodiscard]] Vec3 normal3()
  {
    const double x = normal(), y = normal(), z = normal();
    return {x, y, z};
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

/** Outages: there is one in each interval, at a random time of it. */
class Outages
{
 public:
  /** \param interval, length [s]; interval 0: there are none */
  Outages(double interval, double length, std::uint64_t seed, NoiseSource source)
      : interval_(interval), length_(length), seed_(seed), source_(source)
  {
  }

  /** Whether one is on at t [s]. */
  [[nodiscard]] bool at(double t)
  {
    if (interval_ == 0.0) return false;
    const double turn = std::max(0.0, std::floor(t / interval_));
    // A stream takes longer to start than to ask, and most questions are about the same interval.
    if (turn != turn_)
    {
      RandomStream random(seed_, source_, static_cast<std::uint64_t>(turn));
      turn_ = turn;
      place_ = random.uniform();
    }
    const double room = std::max(0.0, interval_ - length_);
    const double past = t - turn * interval_ - room * place_;
    return past >= 0.0 && past < length_;
  }

 private:
  double interval_, length_;  // [s]
  std::uint64_t seed_;
  NoiseSource source_;
  double turn_ = -1.0;  // number of the interval that was asked for last
  double place_ = 0.0;  // of its outage, in [0, 1)
};

}  // namespace fastlio
