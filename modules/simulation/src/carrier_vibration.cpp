// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "carrier_vibration.h"

#include <fastlio/math/angles.h>
#include <fastlio/scenarios/random_stream.h>

#include <cmath>

namespace fastlio
{
void addVibration(CarrierPath& path, const SimulationSettings& settings)
{
  constexpr int kTones = 8;
  constexpr double kLowest = 20.0, kDecades = 1.0;  // [Hz]
  RandomStream random(settings.seed, NoiseSource::CarrierVibration);
  const double share = std::sqrt(2.0 / kTones);  // amplitude of a tone over the sum's rms
  for (std::size_t c = 0; c < path.channels.size(); ++c)
    for (int tone = 0; tone < kTones; ++tone)
    {
      const double place = (tone + random.uniform()) / kTones;
      const double w = kTwoPi * kLowest * std::pow(10.0, kDecades * place);
      const double amplitude = c < CarrierPath::kYaw ? settings.carrier.vibration_accel / (w * w)
                                                     : settings.carrier.vibration_gyro / w;
      if (amplitude == 0.0) continue;
      // In motion time, which runs at the rate settings.speed.
      path.channels[c].oscillations.push_back({share * amplitude, w / settings.speed});
    }
}

}  // namespace fastlio
