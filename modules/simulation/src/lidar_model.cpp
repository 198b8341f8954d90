// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/simulation/lidar_model.h>
#include <fastlio/simulation/vlp16.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace fastlio
{
namespace
{
/** Sine and cosine of an angle. */
struct Angle
{
  explicit Angle(double radians) : cos(std::cos(radians)), sin(std::sin(radians)) {}

  double cos, sin;
};

/** Direction of a spinning sensor's laser; the azimuth grows clockwise seen from above. */
Vec3 spinningDirection(const Angle& azimuth, const Angle& elevation)
{
  return {elevation.cos * azimuth.cos, -elevation.cos * azimuth.sin, elevation.sin};
}

/** Packets follow each other without a pause; a sweep is the packets that begin in one revolution.
 */
class Vlp16Model : public LidarModel
{
 public:
  Vlp16Model(const LidarSettings& settings, std::int64_t first_shot_ns)
      : rate_(settings.rate), zero_ns_(first_shot_ns)
  {
    for (const double elevation : vlp16::kElevationDeg)
      elevations_.emplace_back(elevation * kRadPerDeg);
  }

  [[nodiscard]] std::int64_t stampOf(std::size_t index) const override
  {
    return zero_ns_ + static_cast<std::int64_t>(firstPacket(index)) * vlp16::kPacketNs;
  }

  [[nodiscard]] Sweep sweep(std::size_t index) const override
  {
    Sweep sweep;
    sweep.stamp_ns = stampOf(index);
    const std::size_t packets = firstPacket(index + 1) - firstPacket(index);
    sweep.shots.reserve(packets * vlp16::kShotsPerPacket);
    for (std::size_t k = 0; k < packets * vlp16::kShotsPerPacket; ++k)
      sweep.shots.push_back(shot(sweep.stamp_ns, k));
    return sweep;
  }

 private:
  [[nodiscard]] std::size_t firstPacket(std::size_t index) const
  {
    const double packets_per_turn = kNsPerSecond / (rate_ * static_cast<double>(vlp16::kPacketNs));
    return static_cast<std::size_t>(std::ceil(static_cast<double>(index) * packets_per_turn));
  }

  [[nodiscard]] Shot shot(std::int64_t stamp_ns, std::size_t k) const
  {
    const std::size_t firing = k / vlp16::kLasers;
    const std::size_t laser = k % vlp16::kLasers;
    const std::int64_t offset_ns = static_cast<std::int64_t>(firing) * vlp16::kFiringNs +
                                   static_cast<std::int64_t>(laser) * vlp16::kLaserNs;
    const double azimuth = vlp16::azimuthAt(stamp_ns + offset_ns - zero_ns_, rate_);
    return {
        spinningDirection(Angle(azimuth), elevations_[laser]), static_cast<std::int32_t>(offset_ns),
        static_cast<std::uint32_t>(firing), vlp16::ringOf(laser)};
  }

  double rate_;
  std::int64_t zero_ns_;
  std::vector<Angle> elevations_;  // of the lasers, in the order of firing
};

/** All lines of a column fire at once, columns are equally spaced in angle and time. */
class SpinningModel : public LidarModel
{
 public:
  /** \param elevations of the lines, the lowest first \param columns of a revolution */
  SpinningModel(std::vector<Angle> elevations, int columns, double rate, std::int64_t first_shot_ns)
      : elevations_(std::move(elevations)), columns_(columns), rate_(rate), zero_ns_(first_shot_ns)
  {
  }

  [[nodiscard]] std::int64_t stampOf(std::size_t index) const override
  {
    return zero_ns_ + toNanoseconds(static_cast<double>(index) / rate_);
  }

  [[nodiscard]] Sweep sweep(std::size_t index) const override
  {
    Sweep sweep;
    sweep.stamp_ns = stampOf(index);
    sweep.shots.reserve(static_cast<std::size_t>(columns_) * elevations_.size());
    for (int column = 0; column < columns_; ++column)
    {
      const double turn = static_cast<double>(column) / columns_;
      const auto offset_ns = static_cast<std::int32_t>(toNanoseconds(turn / rate_));
      const Angle azimuth(kTwoPi * turn);
      for (std::size_t line = 0; line < elevations_.size(); ++line)
        sweep.shots.push_back(
            {spinningDirection(azimuth, elevations_[line]), offset_ns,
             static_cast<std::uint32_t>(column), static_cast<std::uint16_t>(line)});
    }
    return sweep;
  }

 private:
  std::vector<Angle> elevations_;
  int columns_;
  double rate_;
  std::int64_t zero_ns_;
};

/** Lines at equal distances. */
std::vector<Angle> evenLines(const LidarSettings& settings)
{
  std::vector<Angle> elevations;
  for (int line = 0; line < settings.lines; ++line)
  {
    const double fraction =
        settings.lines == 1 ? 0.5 : static_cast<double>(line) / (settings.lines - 1);
    elevations.emplace_back(settings.elevation + settings.vertical_fov * (fraction - 0.5));
  }
  return elevations;
}

// VLP-32C user manual 63-9325, section 9.3.
constexpr std::array<double, 32> kVlp32cElevationDeg{
    -25.0, -15.639, -11.31, -8.843, -7.254, -6.148, -5.333, -4.667, -4.0,   -3.667, -3.333,
    -3.0,  -2.667,  -2.333, -2.0,   -1.667, -1.333, -1.0,   -0.667, -0.333, 0.0,    0.333,
    0.667, 1.0,     1.333,  1.667,  2.333,  3.333,  4.667,  7.0,    10.333, 15.0};
constexpr double kVlp32cFiring = 55.296e-6;  // [s]

std::unique_ptr<const LidarModel> vlp32cModel(
    const LidarSettings& settings, std::int64_t first_shot_ns)
{
  std::vector<Angle> elevations;
  elevations.reserve(kVlp32cElevationDeg.size());
  for (const double elevation : kVlp32cElevationDeg)
    elevations.emplace_back(elevation * kRadPerDeg);
  const auto columns = static_cast<int>(std::lround(1.0 / (settings.rate * kVlp32cFiring)));
  return std::make_unique<SpinningModel>(
      std::move(elevations), columns, settings.rate, first_shot_ns);
}

/** Two prisms that turn in opposite directions at incommensurable speeds bend the beam along a
 * rosette which never repeats; six lasers side by side take turns. */
class RosetteModel : public LidarModel
{
 public:
  static constexpr std::size_t kLasers = 6;

  RosetteModel(const LidarSettings& settings, std::int64_t first_shot_ns)
      : settings_(settings), zero_ns_(first_shot_ns)
  {
  }

  [[nodiscard]] std::int64_t stampOf(std::size_t index) const override
  {
    return zero_ns_ + toNanoseconds(static_cast<double>(firstShot(index)) / settings_.point_rate);
  }

  [[nodiscard]] Sweep sweep(std::size_t index) const override
  {
    Sweep sweep;
    sweep.stamp_ns = stampOf(index);
    sweep.shots.reserve(firstShot(index + 1) - firstShot(index));
    for (std::size_t k = firstShot(index); k < firstShot(index + 1); ++k)
      sweep.shots.push_back(shot(k, sweep.stamp_ns, k - firstShot(index)));
    return sweep;
  }

 private:
  static constexpr double kLaserSpacing = 0.2 * kRadPerDeg;
  static constexpr double kDeflection = 17.5 * kRadPerDeg;  // of each prism
  static constexpr double kFirstPrism = 77.313 * kTwoPi;    // [rad/s]
  static constexpr double kSecondPrism = -46.171 * kTwoPi;

  [[nodiscard]] std::size_t firstShot(std::size_t index) const
  {
    const double shots_per_sweep = settings_.point_rate / settings_.rate;
    return static_cast<std::size_t>(std::llround(static_cast<double>(index) * shots_per_sweep));
  }

  [[nodiscard]] Shot shot(std::size_t k, std::int64_t sweep_ns, std::size_t in_sweep) const
  {
    const double t = static_cast<double>(k) / settings_.point_rate;
    const std::size_t laser = k % kLasers;
    const double left = kDeflection * (std::cos(kFirstPrism * t) + std::cos(kSecondPrism * t));
    const double up = kDeflection * (std::sin(kFirstPrism * t) + std::sin(kSecondPrism * t)) +
                      kLaserSpacing * (static_cast<double>(laser) - 0.5 * (kLasers - 1));
    return {
        spinningDirection(Angle(-left), Angle(up)),
        static_cast<std::int32_t>(zero_ns_ + toNanoseconds(t) - sweep_ns),
        static_cast<std::uint32_t>(in_sweep / kLasers), static_cast<std::uint16_t>(laser)};
  }

  LidarSettings settings_;
  std::int64_t zero_ns_;
};

void requireUsable(const LidarSettings& s)
{
  const double packets_per_sweep = kNsPerSecond / (s.rate * static_cast<double>(vlp16::kPacketNs));
  const bool usable = s.rate > 0.0 && s.lines > 0 && s.columns > 0 && s.stride > 0 &&
                      (s.kind != LidarKind::Vlp16 || packets_per_sweep >= 1.0) &&
                      (s.kind != LidarKind::Livox || s.point_rate >= s.rate);
  if (usable) return;
  throw std::invalid_argument(
      "LiDAR model: " + std::to_string(s.rate) + " sweeps/s with " + std::to_string(s.lines) +
      " lines, " + std::to_string(s.columns) + " columns, " + std::to_string(s.point_rate) +
      " shots/s, stride " + std::to_string(s.stride) +
      "; all must be positive, and a sweep must hold at least one packet or shot.");
}
}  // namespace

double vlp16::azimuthAt(std::int64_t elapsed_ns, double rate)
{
  const double turns = static_cast<double>(elapsed_ns) / kNsPerSecond * rate;
  return kTwoPi * (turns - std::floor(turns));
}

std::uint16_t vlp16::ringOf(std::size_t laser)
{
  // Lasers alternate between the lower and the upper half, both from below.
  return static_cast<std::uint16_t>(laser % 2 == 0 ? laser / 2 : kLasers / 2 + laser / 2);
}

std::size_t lineCount(const LidarSettings& settings)
{
  switch (settings.kind)
  {
    case LidarKind::Vlp16:
      return vlp16::kLasers;
    case LidarKind::Os64:
      return static_cast<std::size_t>(settings.lines);
    case LidarKind::Vlp32c:
      return kVlp32cElevationDeg.size();
    case LidarKind::Livox:
      return RosetteModel::kLasers;
  }
  throw std::invalid_argument("LiDAR model: unknown kind.");
}

std::size_t shotsPerPacket(const LidarSettings& settings)
{
  constexpr std::size_t kColumnsPerPacket = 16, kRosetteShots = 96;
  switch (settings.kind)
  {
    case LidarKind::Vlp16:
      return vlp16::kShotsPerPacket;
    case LidarKind::Os64:
    case LidarKind::Vlp32c:
      return kColumnsPerPacket * lineCount(settings);
    case LidarKind::Livox:
      return kRosetteShots;
  }
  throw std::invalid_argument("LiDAR model: unknown kind.");
}

std::unique_ptr<const LidarModel> makeLidarModel(
    const LidarSettings& settings, std::int64_t first_shot_ns)
{
  requireUsable(settings);
  switch (settings.kind)
  {
    case LidarKind::Vlp16:
      return std::make_unique<Vlp16Model>(settings, first_shot_ns);
    case LidarKind::Os64:
      return std::make_unique<SpinningModel>(
          evenLines(settings), settings.columns, settings.rate, first_shot_ns);
    case LidarKind::Vlp32c:
      return vlp32cModel(settings, first_shot_ns);
    case LidarKind::Livox:
      return std::make_unique<RosetteModel>(settings, first_shot_ns);
  }
  throw std::invalid_argument("LiDAR model: unknown kind.");
}

}  // namespace fastlio
