// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/innovation_watch.h>

#include <algorithm>
#include <numeric>

namespace fastlio
{
namespace
{
// So many scans count as recent. Of healthy sensors, on walks, flights and rides, their mean is up
// to 2.1 times that of the run.
constexpr int kRecentScans = 30;
constexpr double kUnevenness = 2.5;
// The mean of the last scans. Of healthy sensors it was 33 at most, of a car that vibrates; a step
// of 0.5 m/s^2 of an accelerometer makes it 100. One scan that went wrong is none, so each of them
// has to show it.
constexpr double kStep = 45.0, kLeastOfEach = kStep / 3.0;
// The mean of the last two scans that a third one is expected to continue. After a step of an
// accelerometer by 0.5 m/s^2 they are 10 and 26; from 60 on the ground is beyond the gate. Of
// healthy sensors, 9 is rare.
constexpr double kStandsOut = 9.0, kEachStandsOut = kStandsOut / 3.0;
// A second of most LiDARs: a view along a wall opens piece by piece.
constexpr int kScansAfterDegeneracy = 10;
}  // namespace

void InnovationWatch::add(double square, double residuals, double beyond_map)
{
  ++scans_;
  recent_ += (square - recent_) / std::min(scans_, kRecentScans);
  residuals_ += (residuals - residuals_) / std::min(scans_, kRecentScans);
  const double misfit = std::max(residuals_, 1.0);
  squares_ = {square / misfit, squares_[0]};
  if (scans_ >= kRecentScans) worst_ = std::max(worst_, recent_ / kUnevenness);
  if (pause_ > 0)
    --pause_;
  else
    beyond_map_ = {beyond_map / misfit, beyond_map_[0], beyond_map_[1]};
}

void InnovationWatch::interrupt()
{
  pause_ = kScansAfterDegeneracy;
  beyond_map_ = {};
}

bool InnovationWatch::takeStep()
{
  const double sum = std::accumulate(beyond_map_.begin(), beyond_map_.end(), 0.0);
  if (sum < kStep * static_cast<double>(beyond_map_.size())) return false;
  if (*std::min_element(beyond_map_.begin(), beyond_map_.end()) < kLeastOfEach) return false;
  beyond_map_ = {};
  squares_ = {};  // from now on the covariance contains it
  return true;
}

double InnovationWatch::expected() const
{
  const double mean = 0.5 * (squares_[0] + squares_[1]);
  const bool both = std::min(squares_[0], squares_[1]) > kEachStandsOut;
  return both && mean > kStandsOut ? mean : 1.0;
}

}  // namespace fastlio
