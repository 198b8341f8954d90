// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "faults.h"

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <limits>
#include <utility>

namespace fastlio::testing
{
bool chance(Random& random, double probability)
{
  return std::uniform_real_distribution<double>(0.0, 1.0)(random) < probability;
}

Injection emptyScans(double probability)
{
  return [=](Observations& all, Random& random)
  {
    for (const auto& o : all)
    {
      if (!chance(random, probability)) continue;
      if (auto* scan = dynamic_cast<mrpt::obs::CObservationVelodyneScan*>(o.get()))
        scan->scan_packets.clear();
      if (auto* cloud = dynamic_cast<mrpt::obs::CObservationPointCloud*>(o.get()))
        cloud->pointcloud->clear();
    }
  };
}

namespace
{
Injection badPoints(double probability, std::vector<float> values)
{
  return [=](Observations& all, Random& random)
  {
    for (const auto& o : all)
    {
      auto* cloud = dynamic_cast<mrpt::obs::CObservationPointCloud*>(o.get());
      if (cloud == nullptr) continue;
      for (std::size_t i = 0; i < cloud->pointcloud->size(); ++i)
        if (chance(random, probability))
          cloud->pointcloud->setPointFast(
              i, values[random() % values.size()], values[random() % values.size()],
              values[random() % values.size()]);
    }
  };
}

constexpr float kNaNf = std::numeric_limits<float>::quiet_NaN();
constexpr float kInff = std::numeric_limits<float>::infinity();
}  // namespace

std::vector<ObservationFault> pointFaults()
{
  return {
      {"NaN and infinity in points, 20 %", badPoints(0.2, {kNaNf, kInff, -kInff, 0.0F}), 1.5, 1.0,
       "points_invalid"},
      {"huge points, 10 %", badPoints(0.1, {1e30F, -1e38F, 1e10F, 3e7F}), 1.5, 1.0,
       "points_too_far"},
      {"false points, 5 %", badPoints(0.05, {-5.0F, -1.0F, 2.0F, 7.0F, 20.0F}), 5.0, 0.9},
      {"scans of NaN only, all", badPoints(1.0, {kNaNf}), 0.0, 0.0, "scans_empty"},
      {"scans without points, 20 %", emptyScans(0.2), 2.0, 0.7, "scans_empty"},
  };
}

}  // namespace fastlio::testing
