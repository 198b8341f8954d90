// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "weighted_yaw_fit.h"
#include <fastlio/earth/earth_fit.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/robust_weight.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostPointsForPairs = 64;
constexpr int kMostSteps = 100;       // of the graduated non-convexity; 40 are usual
constexpr double kStepOfMu = 1.4;     // as in the paper
constexpr int kMostRefinements = 20;  // until the used points stay the same; 3 are usual
// A point contradicts when its residual is longer than so many standard deviations: one good point
// in a thousand is beyond (chi square, 3 degrees of freedom).
constexpr double kGate = 4.03, kSquaredGate = kGate * kGate;

std::string called(const Correspondence& point, std::size_t index)
{
  return point.name.empty() ? "number " + std::to_string(index + 1)
                            : "'" + printable(point.name) + "'";
}

void requireUsable(const std::vector<Correspondence>& points, const EarthFitOptions& options)
{
  if (points.size() < 2)
    throw std::invalid_argument(
        "control points: " + std::to_string(points.size()) +
        "; give at least two, far apart, for the heading of the map");
  if (!(options.map_std_m >= 0) || !(options.most_yaw_std_deg > 0))
    throw std::invalid_argument(
        "control points: the map's standard deviation is at least 0 m, and the largest standard "
        "deviation of the heading above 0 deg");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].map.allFinite() || !points[i].enu.allFinite() || !(points[i].std_m > 0) ||
        !std::isfinite(points[i].std_m))
      throw std::invalid_argument(
          "control point " + called(points[i], i) +
          ": coordinates are not finite, or its standard deviation is not above 0 m");
}

/** The points, and what a robust cost takes for each of them. */
class Problem
{
 public:
  Problem(const std::vector<Correspondence>& points, double map_std_m) : points_(points)
  {
    information_.reserve(points.size());
    for (const Correspondence& point : points)
      information_.push_back(1.0 / (point.std_m * point.std_m + map_std_m * map_std_m));
  }

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  /** Of each point [1/m^2]. */
  [[nodiscard]] std::vector<double> information(const std::vector<double>& weights) const
  {
    std::vector<double> weighted(weights);
    for (std::size_t i = 0; i < size(); ++i)
      weighted[i] *= information_[i];
    return weighted;
  }
  [[nodiscard]] Pose fit(const std::vector<double>& weights) const
  {
    return weightedYawFit(points_, information(weights));
  }
  [[nodiscard]] double squared(const Pose& pose, std::size_t i) const
  {
    return (pose * points_[i].map - points_[i].enu).squaredNorm() * information_[i];
  }
  [[nodiscard]] double truncatedCost(const Pose& pose) const
  {
    double cost = 0;
    for (std::size_t i = 0; i < size(); ++i)
      cost += std::min(squared(pose, i), kSquaredGate);
    return cost;
  }
  [[nodiscard]] std::vector<double> within(const Pose& pose) const
  {
    std::vector<double> weights(size());
    for (std::size_t i = 0; i < size(); ++i)
      weights[i] = squared(pose, i) <= kSquaredGate ? 1.0 : 0.0;
    return weights;
  }

 private:
  const std::vector<Correspondence>& points_;
  std::vector<double> information_;
};

double sum(const std::vector<double>& weights)
{
  double total = 0;
  for (const double weight : weights)
    total += weight;
  return total;
}

/** All points at first; those that fit badly lose their weight step by step. */
Pose graduatedFit(const Problem& problem)
{
  std::vector<double> weights(problem.size(), 1.0);
  Pose pose = problem.fit(weights);
  double worst = 0;
  for (std::size_t i = 0; i < problem.size(); ++i)
    worst = std::max(worst, problem.squared(pose, i));
  if (worst <= kSquaredGate) return pose;
  double mu = kSquaredGate / (2.0 * worst - kSquaredGate);
  for (int step = 0; step < kMostSteps; ++step, mu *= kStepOfMu)
  {
    bool is_decided = true;
    for (std::size_t i = 0; i < problem.size(); ++i)
    {
      weights[i] = truncatedWeight(problem.squared(pose, i), kSquaredGate, mu);
      is_decided = is_decided && (weights[i] == 0.0 || weights[i] == 1.0);
    }
    if (sum(weights) <= 0) break;
    pose = problem.fit(weights);
    if (is_decided) break;
  }
  return pose;
}

/** With the points within the gate, until these stay the same. */
Pose refined(const Problem& problem, Pose pose)
{
  std::vector<double> used = problem.within(pose);
  for (int i = 0; i < kMostRefinements && sum(used) >= 2; ++i)
  {
    pose = problem.fit(used);
    std::vector<double> now = problem.within(pose);
    if (now == used) break;
    used = std::move(now);
  }
  return pose;
}

Pose robustFit(const Problem& problem)
{
  Pose best = refined(problem, graduatedFit(problem));
  double least = problem.truncatedCost(best);
  const auto consider = [&](std::size_t i, std::size_t j)
  {
    std::vector<double> pair(problem.size(), 0.0);
    pair[i] = pair[j] = 1.0;
    const Pose candidate = refined(problem, problem.fit(pair));
    const double cost = problem.truncatedCost(candidate);
    if (cost >= least) return;
    least = cost;
    best = candidate;
  };
  if (problem.size() <= kMostPointsForPairs)
    for (std::size_t i = 0; i < problem.size(); ++i)
      for (std::size_t j = i + 1; j < problem.size(); ++j)
        consider(i, j);
  return best;
}

/** The pair whose distance differs most between map and earth, in words. */
std::string worstDistance(const std::vector<Correspondence>& points)
{
  const std::size_t count = std::min(points.size(), kMostPointsForPairs);
  std::string text;
  double worst = -1;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
    {
      const double map_m = (points[i].map - points[j].map).norm();
      const double earth_m = (points[i].enu - points[j].enu).norm();
      if (std::abs(map_m - earth_m) <= worst) continue;
      worst = std::abs(map_m - earth_m);
      text = "from " + called(points[i], i) + " to " + called(points[j], j) + " it is " +
             fixedText(map_m, 2) + " m in the map and " + fixedText(earth_m, 2) + " m on the earth";
    }
  return text;
}

void requireAgreement(
    const std::vector<Correspondence>& points, const std::vector<double>& used,
    const EarthFitWords& words)
{
  const double count = sum(used);
  if (count >= 2 && 2 * count > static_cast<double>(points.size())) return;
  throw std::runtime_error(
      words.points + " contradict each other: no more than " + fixedText(count, 0) + " of " +
      std::to_string(points.size()) + " agree within " + shortestText(kGate) +
      " standard deviations; " + worstDistance(points) + "; " + words.if_contradicting);
}

void requireHeading(
    const YawObservability& seen, std::size_t used, double most_yaw_std_deg,
    const EarthFitWords& words)
{
  const double yaw_std_deg = seen.yaw_std_rad * kDegPerRad;
  if (yaw_std_deg <= most_yaw_std_deg) return;
  throw std::runtime_error(
      words.points + " do not show the heading of the map: the " + std::to_string(used) +
      " in use lie within " + fixedText(seen.horizontal_spread_m, 2) +
      " m of their centre (rms, horizontal)" +
      (std::isfinite(yaw_std_deg)
           ? ", which leaves a standard deviation of " + fixedText(yaw_std_deg, 1) +
                 " deg, more than " + shortestText(most_yaw_std_deg)
           : "") +
      "; " + words.if_close);
}

/** The residual at each point, and their mean. */
void addResiduals(
    const std::vector<Correspondence>& points, const std::vector<double>& used, EarthFit& fit)
{
  double squares_m = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 residual = fit.T_enu_map * points[i].map - points[i].enu;
    fit.residuals.push_back({points[i].name, residual, used[i] > 0});
    squares_m += used[i] * residual.squaredNorm();
  }
  fit.rms_m = std::sqrt(squares_m / sum(used));
}
}  // namespace

std::size_t EarthFit::used() const
{
  return static_cast<std::size_t>(std::count_if(
      residuals.begin(), residuals.end(), [](const EarthResidual& r) { return r.is_used; }));
}

EarthFit fitToEarth(const std::vector<Correspondence>& points, const EarthFitOptions& options)
{
  requireUsable(points, options);
  const Problem problem(points, options.map_std_m);
  EarthFit fit;
  fit.T_enu_map = robustFit(problem);
  const std::vector<double> used = problem.within(fit.T_enu_map);
  requireAgreement(points, used, options.words);
  addResiduals(points, used, fit);
  requireHeading(
      yawObservability(points, problem.information(used)), fit.used(), options.most_yaw_std_deg,
      options.words);
  return fit;
}

}  // namespace fastlio
