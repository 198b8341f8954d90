// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "measurement.h"

#include <fastlio/odometry/odometry.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace fastlio::benchmarks
{
namespace
{
/** FNV-1a over the bytes of numbers. */
class Digest
{
 public:
  template <typename Derived>
  void add(const Eigen::MatrixBase<Derived>& m)
  {
    for (Eigen::Index c = 0; c < m.cols(); ++c)
      for (Eigen::Index r = 0; r < m.rows(); ++r)
        add(m(r, c));
  }

  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  void add(double number)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    for (int shift = 0; shift < 64; shift += 8)
      value_ = (value_ ^ ((bits >> shift) & 0xFFU)) * 0x100000001B3ULL;
  }

  std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

void keepLeast(StageTimings& least, const StageTimings& t)
{
  for (auto stage :
       {&StageTimings::propagate, &StageTimings::deskew, &StageTimings::downsample,
        &StageTimings::associate, &StageTimings::update, &StageTimings::insert,
        &StageTimings::total})
    least.*stage = std::min(least.*stage, t.*stage);
}

/** The tracked scans of one run, in their order. */
std::vector<ScanResult> runOnce(const Inputs& inputs, int threads)
{
  OdometryOptions parameters = inputs.parameters;
  parameters.threads = threads;
  Odometry odometry(parameters);
  std::vector<ScanResult> results;
  const auto take = [&](std::optional<ScanResult> result)
  {
    if (result && result->status == ScanStatus::Tracking) results.push_back(std::move(*result));
  };
  for (const Input& input : inputs.data)
  {
    if (const auto* sample = std::get_if<ImuSample>(&input))
      odometry.addImu(*sample);
    else
      odometry.addScan(std::get<LidarScan>(input));
    take(odometry.next());
  }
  while (auto result = odometry.flush())
    take(std::move(result));
  return results;
}

void merge(const std::vector<ScanResult>& results, RunTimes& run)
{
  const bool first = run.scans.empty();
  run.scans.resize(results.size());
  Digest digest;
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    const ScanResult& result = results[i];
    ScanTime& scan = run.scans[i];
    if (first) scan.least = result.milliseconds;
    keepLeast(scan.least, result.milliseconds);
    scan.each.push_back(result.milliseconds.total);
    scan.effective_points = result.statistics.points_effective;
    digest.add(result.filter.x.R);
    digest.add(result.filter.x.p);
    digest.add(result.filter.P);
  }
  run.digest = digest.value();
}
}  // namespace

std::vector<RunTimes> measure(const Inputs& inputs, const std::vector<int>& threads, int repeats)
{
  std::vector<RunTimes> runs(threads.size());
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    for (std::size_t i = 0; i < threads.size(); ++i)
    {
      runs[i].threads = threads[i];
      merge(runOnce(inputs, threads[i]), runs[i]);
    }
  }
  return runs;
}

double percentile(std::vector<double> values, double p)
{
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(p * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

}  // namespace fastlio::benchmarks
