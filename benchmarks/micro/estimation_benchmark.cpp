// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Cost of the steps of the filter, and of the sums and fits that feed it.

#include "street.h"
#include <fastlio/filter/propagation.h>
#include <fastlio/filter/update.h>
#include <fastlio/map/plane_fit.h>
#include <fastlio/map/plane_voxel.h>
#include <fastlio/matching/measured_scan.h>

#include <benchmark/benchmark.h>

#include <random>

namespace fastlio::benchmarks
{
namespace
{
/** Body points on the walls of a box, with the planes that they lie on. */
struct Matched
{
  BodyPoints body;
  std::vector<PlaneMatch> matches;
};

Matched matchedPoints(std::size_t count)
{
  std::mt19937 rng(1);
  std::normal_distribution<float> n;
  Matched matched;
  matched.body.resize(count);
  matched.matches.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Eigen::Vector3f p = 10.0F * Eigen::Vector3f(n(rng), n(rng), n(rng));
    const Eigen::Vector3f normal = Eigen::Vector3f(n(rng), n(rng), n(rng)).normalized();
    const Eigen::Vector3f beam = p.normalized();
    BodyPoints& b = matched.body;
    b.x[i] = p.x(), b.y[i] = p.y(), b.z[i] = p.z();
    b.ux[i] = beam.x(), b.uy[i] = beam.y(), b.uz[i] = beam.z();
    matched.matches[i] = {normal.x(), normal.y(), normal.z(), -normal.dot(p) + 0.01F * n(rng),
                          1e-4F,      1e-5F,      1,          1};
  }
  return matched;
}

void measure(const Matched& matched, const Workers& workers, MeasuredScan& scan)
{
  scan.measure(workers, Pose{}, matched.body, matched.matches, ResidualModel{});
}

InformationSums sumsOf(const Matched& matched)
{
  MeasuredScan scan;
  measure(matched, Workers(1), scan);
  return scan.sums();
}

FilterState someState()
{
  FilterState s;
  s.P = StateMatrix::Identity() * 1e-4;
  return s;
}

void measurePoints(benchmark::State& state)
{
  const Matched matched = matchedPoints(static_cast<std::size_t>(state.range(0)));
  const Workers workers(1);
  MeasuredScan scan;
  for (auto _ : state)
  {
    measure(matched, workers, scan);
    InformationSums sums = scan.sums();
    benchmark::DoNotOptimize(sums);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void propagateSample(benchmark::State& state)
{
  FilterState s = someState();
  for (auto _ : state)
    benchmark::DoNotOptimize(
        propagate({s, {}}, {0.1, 0.2, 0.3}, {0.1, 0.2, 9.8}, 0.005, ImuNoise{}));
}

void informationGain(benchmark::State& state)
{
  const FilterState prior = someState();
  MeasurementEvaluation evaluation;
  evaluation.sums = sumsOf(matchedPoints(1000));
  const MeasurementModel model = [&](const NavState&, int) { return evaluation; };
  IterationLimits limits;
  limits.max_iterations = 1;
  for (auto _ : state)
    benchmark::DoNotOptimize(iteratedUpdate(prior, model, limits, GainForm::Information));
}

void standardGain(benchmark::State& state)
{
  const Matched matched = matchedPoints(static_cast<std::size_t>(state.range(0)));
  MeasurementEvaluation evaluation;
  evaluation.sums = sumsOf(matched);
  evaluation.stacked = stack(Pose{}, matched.body, matched.matches, ResidualModel{});
  const MeasurementModel model = [&](const NavState&, int) { return evaluation; };
  IterationLimits limits;
  limits.max_iterations = 1;
  for (auto _ : state)
    benchmark::DoNotOptimize(iteratedUpdate(someState(), model, limits, GainForm::Standard));
}

std::vector<Eigen::Vector3d> planarPoints(std::size_t count)
{
  std::mt19937 rng(1);
  std::normal_distribution<double> n;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(0.3 * n(rng), 0.3 * n(rng), 0.01 * n(rng));
  return points;
}

void fitFivePoints(benchmark::State& state)
{
  const auto points = planarPoints(5);
  for (auto _ : state)
    benchmark::DoNotOptimize(fitPlane(momentsOf(points.data(), points.size())));
}

void fitVoxel(benchmark::State& state)
{
  PlaneVoxel voxel;
  for (const Eigen::Vector3d& p : planarPoints(100))
    voxel.add(p.cast<float>(), {0.0F, 0.0F, -1.0F});
  for (auto _ : state)
  {
    voxel.fit(Eigen::Vector3f::Zero(), PlaneRules{}, 1);
    VoxelPlane plane = voxel.plane();
    benchmark::DoNotOptimize(plane);
  }
}

BENCHMARK(measurePoints)->Arg(100)->Arg(1000)->Arg(10000);
BENCHMARK(propagateSample);
BENCHMARK(informationGain);
BENCHMARK(standardGain)->Arg(100)->Arg(400);
BENCHMARK(fitFivePoints);
BENCHMARK(fitVoxel);
}  // namespace
}  // namespace fastlio::benchmarks
