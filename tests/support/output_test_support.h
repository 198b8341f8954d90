// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file output_test_support.h Lines of files, made-up results. */
#pragma once

#include "temporary_folder.h"
#include <fastlio/interface/scan_result.h>
#include <fastlio/run/output_map.h>
#include <fastlio/run/run_summary.h>

#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** Lines without comments. */
inline std::vector<std::string> dataLinesOf(const std::string& path)
{
  std::istringstream in(contentOf(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line.front() != '#') lines.push_back(line);
  return lines;
}

inline std::vector<std::string> split(const std::string& line, char separator)
{
  std::istringstream in(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(in, cell, separator);)
    cells.push_back(cell);
  return cells;
}

constexpr std::int64_t kMapStamp = 1'403'636'500'000'000'000;

/** 2500 m of points: more than one tile, more than one block of the writers. */
inline OutputPoints smallMapPoints()
{
  OutputPoints points;
  for (int i = 0; i < 5000; ++i)
  {
    points.x.push_back(0.5F * static_cast<float>(i));
    points.y.push_back(-1.25F);
    points.z.push_back(1e-3F * static_cast<float>(i));
    points.intensity.push_back(static_cast<float>(i % 256));
    points.stamp_ns.push_back(kMapStamp + std::int64_t{i} * 1'000'000);
  }
  return points;
}

/** The same as what exporters get. */
inline std::unique_ptr<OutputMap> smallMap()
{
  OutputMapOptions options;
  options.spacing = 0.0;
  auto map = std::make_unique<OutputMap>(options);
  map->insert(smallMapPoints());
  return map;
}

/** A result whose every number differs from the others. */
inline ScanResult madeUpResult(std::int64_t stamp_ns, ScanStatus status = ScanStatus::Tracking)
{
  ScanResult result;
  result.stamp_ns = stamp_ns;
  result.begin_ns = stamp_ns - 100'000'000;
  result.status = status;
  result.message = status == ScanStatus::Tracking ? "" : "because of \"this\"";
  NavState& x = result.filter.x;
  x.R = expSO3({0.1, -0.2, 0.3});
  x.p = {1.25, -2.5, 3.75};
  x.v = {0.1, 0.2, 0.3};
  x.gyro_bias = {1e-3, 2e-3, 3e-3};
  x.accel_bias = {0.01, 0.02, 0.03};
  x.g = {0.05, -0.06, -9.8};
  StateMatrix A;
  for (int i = 0; i < kStateDim; ++i)
    for (int j = 0; j < kStateDim; ++j)
      A(i, j) = 1e-3 * (1 + (7 * i + 3 * j) % 11);
  result.filter.P = A * A.transpose() + 1e-6 * StateMatrix::Identity();
  result.statistics.points_in = 20000;
  result.statistics.points_effective = 900;
  result.statistics.converged = true;
  result.milliseconds.total = 4.5;
  return result;
}

// Of resultAt().
constexpr std::int64_t kRunStart = 1'700'000'000'000'000'000;
constexpr std::int64_t kPeriod = 100'000'000;

/** The scan with that index, counted from 0. \param x where it was made [m] \param ms it took */
inline ScanResult resultAt(int index, ScanStatus status, double x, double ms)
{
  ScanResult result = madeUpResult(kRunStart + (index + 1) * kPeriod, status);
  result.filter.x.p = {x, 0.0, 0.0};
  result.milliseconds.total = ms;
  return result;
}

/** A run of one good scan. */
inline RunSummary goodRun()
{
  RunSummary run;
  run.statistics.add(resultAt(0, ScanStatus::Tracking, 0, 1));
  return run;
}

}  // namespace fastlio::testing
