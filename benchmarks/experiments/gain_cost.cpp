// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gain_cost.cpp The paper's Table II: what one step of the update costs with the gain of eq.
 * 18 and with that of eq. 20, against the number of measurements. */

#include <fastlio/filter/update.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <random>
#include <vector>

namespace fastlio
{
namespace
{
/** A row of the paper's table. */
struct PaperRow
{
  std::size_t features;
  double standard_ms, information_ms;
};
constexpr std::array<PaperRow, 6> kPaper{
    {{307, 7.1, 0.07},
     {717, 23.4, 0.11},
     {998, 109.3, 0.25},
     {1243, 251.0, 0.37},
     {1453, 1219.0, 0.59},
     {1802, 1621.0, 1.16}}};

/** A prediction, and points on planes around it. */
struct Problem
{
  FilterState prior;
  StackedMeasurements measurements;
};

Problem makeProblem(std::size_t count)
{
  std::mt19937 rng(static_cast<unsigned>(count));
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(rng), normal(rng), normal(rng)); };
  Problem problem;
  problem.prior.x.R = expSO3(vector());
  problem.prior.P.diagonal().setConstant(1e-4);
  StackedMeasurements& m = problem.measurements;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3 p_imu = 10.0 * vector(), u = vector().normalized();
    Vector6 h;
    h << p_imu.cross(problem.prior.x.R.transpose() * u), u;
    m.h.push_back(h);
    m.z.push_back(0.02 * normal(rng));
    m.variance.push_back(4e-4);
  }
  return problem;
}

/** The part of eq. 20 that needs the rows: its cost grows with their number. */
InformationSums sumsOf(const StackedMeasurements& m)
{
  InformationSums sums;
  for (std::size_t i = 0; i < m.z.size(); ++i)
  {
    const double weight = 1.0 / m.variance[i];
    sums.HtRinvH.noalias() += weight * m.h[i] * m.h[i].transpose();
    sums.HtRinvz += weight * m.z[i] * m.h[i];
  }
  sums.count = m.z.size();
  return sums;
}

/** Median time of a call [ms]. */
template <typename Call>
double medianMilliseconds(int repetitions, const Call& call)
{
  using Clock = std::chrono::steady_clock;
  std::vector<double> times;
  for (int k = 0; k < repetitions; ++k)
  {
    const auto begin = Clock::now();
    call();
    times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
  }
  std::nth_element(times.begin(), times.begin() + repetitions / 2, times.end());
  return times[static_cast<std::size_t>(repetitions / 2)];
}

void printRow(const PaperRow& paper)
{
  const Problem problem = makeProblem(paper.features);
  const FilterState& prior = problem.prior;
  UpdateStep by_standard, by_information;
  const double standard_ms = medianMilliseconds(
      5, [&] { by_standard = standardStep(prior, prior.x, problem.measurements); });
  const double information_ms = medianMilliseconds(
      1001,
      [&] { by_information = informationStep(prior, prior.x, sumsOf(problem.measurements)); });
  std::printf(
      "| %zu | %.2f | %.4f | %.0f | %.1f | %.2f | %.0f | %.1e |\n", paper.features, standard_ms,
      information_ms, standard_ms / information_ms, paper.standard_ms, paper.information_ms,
      paper.standard_ms / paper.information_ms,
      (by_standard.dx - by_information.dx).cwiseAbs().maxCoeff());
}

void printTable()
{
  std::puts(
      "| features | eq. 18 [ms] | eq. 20 [ms] | ratio | paper, eq. 18 [ms] | paper, eq. 20 [ms] | "
      "paper, ratio | difference of the steps |");
  std::puts("|--:|--:|--:|--:|--:|--:|--:|--:|");
  for (const PaperRow& row : kPaper)
    printRow(row);
}
}  // namespace
}  // namespace fastlio

int main()
{
  try
  {
    fastlio::printTable();
    return 0;
  }
  catch (const std::exception& e)
  {
    std::fprintf(stderr, "fastlio-gain-cost: %s\n", e.what());
    return 1;
  }
}
