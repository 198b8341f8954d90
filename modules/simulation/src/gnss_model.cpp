// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/scenarios/random_stream.h>
#include <fastlio/simulation/gnss_model.h>

#include <cmath>

namespace fastlio
{
namespace
{
/** Noise of fixes at equal intervals. */
class FixNoise
{
 public:
  explicit FixNoise(const SimulationSettings& s)
      : white_(s.seed, NoiseSource::GnssWhite),
        drift_(s.seed, NoiseSource::GnssDrift),
        deviation_(s.gnss.noise * Vec3(1.0, 1.0, 2.0))
  {
    const double tau = s.gnss.correlation_time;
    keeps_ = tau > 0.0 ? std::exp(-1.0 / (s.gnss.rate * tau)) : 0.0;
    lasting_ = drift_.normal3();
  }

  [[nodiscard]] Vec3 next()
  {
    Vec3 error = std::sqrt(0.5) * deviation_.cwiseProduct(white_.normal3() + lasting_);
    lasting_ = keeps_ * lasting_ + std::sqrt(1.0 - keeps_ * keeps_) * drift_.normal3();
    return error;
  }

 private:
  RandomStream white_, drift_;
  Vec3 deviation_;
  Vec3 lasting_ = Vec3::Zero();
  double keeps_ = 0.0;
};

/** Reflections that come and go. */
class Multipath
{
 public:
  explicit Multipath(const SimulationSettings& s)
      : random_(s.seed, NoiseSource::GnssMultipath), share_(s.gnss.multipath)
  {
    if (share_ > 0.0) begin(0.0);
  }

  /** Offset at t [s], which must not fall; zero while there is none. */
  [[nodiscard]] Vec3 at(double t)
  {
    if (share_ <= 0.0) return Vec3::Zero();
    while (t >= ends_)
      begin(ends_);
    return t >= begins_ ? offset_ : Vec3::Zero();
  }

 private:
  void begin(double earliest)
  {
    constexpr double kShortest = 2.0, kLongest = 8.0;   // [s]
    constexpr double kNearest = 5.0, kFarthest = 30.0;  // [m]
    const double mean_gap = 0.5 * (kShortest + kLongest) * (1.0 - share_) / share_;
    begins_ = earliest + 2.0 * mean_gap * random_.uniform();
    ends_ = begins_ + kShortest + (kLongest - kShortest) * random_.uniform();
    const double size = kNearest + (kFarthest - kNearest) * random_.uniform();
    const double way = kTwoPi * random_.uniform();
    const double up = 2.0 * random_.uniform() - 1.0;
    offset_ = size * Vec3(std::cos(way), std::sin(way), up);
  }

  RandomStream random_;
  double share_;
  double begins_ = 0.0, ends_ = 0.0;
  Vec3 offset_ = Vec3::Zero();
};
}  // namespace

std::vector<SimulatedFix> simulateGnss(const Motion& motion, const SimulationSettings& settings)
{
  std::vector<SimulatedFix> fixes;
  if (settings.gnss.rate <= 0.0) return fixes;
  FixNoise noise(settings);
  Multipath multipath(settings);
  Outages outages(
      settings.gnss.outage_interval, settings.gnss.outage_length, settings.seed,
      NoiseSource::GnssOutage);
  for (std::size_t i = 0;; ++i)
  {
    const double t = static_cast<double>(i) / settings.gnss.rate;
    if (t > settings.duration) return fixes;
    // All numbers are drawn for every fix, so that an outage does not change the others.
    const Vec3 reflected = multipath.at(t);
    SimulatedFix fix;
    fix.stamp_ns = settings.start_ns + toNanoseconds(t);
    fix.known = !outages.at(t);
    fix.multipath = reflected != Vec3::Zero();
    fix.error = noise.next() + reflected;
    fix.antenna = motion.pose(t) * settings.gnss.lever_arm + fix.error;
    fixes.push_back(fix);
  }
}

}  // namespace fastlio
