// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/config/presets.h>
#include <fastlio/mapping/session.h>
#include <fastlio/rawlog/decode_ahead_source.h>

#include <utility>

namespace fastlio
{
Session::Session(
    std::string name, std::vector<std::string> files, Config config,
    const std::function<bool(std::string_view)>& is_given)
    : name_(std::move(name)), files_(std::move(files)), config_(std::move(config))
{
  selection_ = sensorsIn(files_, config_.sensors);
  if (const auto preset = takePreset(selection_, is_given, config_)) notes_.push_back(preset->text);
  plan_ = planInput(selection_, config_.sensors, config_.odometry.lidar);
  notes_.insert(notes_.end(), plan_.notes.begin(), plan_.notes.end());
  notes_.insert(notes_.end(), plan_.warnings.begin(), plan_.warnings.end());
}

SessionPass Session::run(
    const std::function<bool(const ScanResult&, const Odometry&)>& use,
    const std::function<void(double share)>& progress,
    const std::function<void(const ImuSample&)>& imu) const
{
  SessionPass pass;
  DecodeAheadSource source(RawlogSource(files_), ObservationBridge(selection_, plan_.bridge));
  Odometry odometry(config_.odometry);
  odometry.setSampleCallback(imu);
  const auto take = [&](const ScanResult& result)
  {
    ++pass.scans;
    pass.stopped = pass.stopped || !use(result, odometry);
  };
  while (!pass.stopped)
  {
    auto input = source.next();
    if (!input) break;
    if (auto* sample = std::get_if<ImuSample>(&input->data))
      odometry.addImu(*sample);
    else
    {
      auto& scan = std::get<LidarScan>(input->data);
      pass.lidar_in_imu = scan.T_imu_lidar.p;
      odometry.addScan(std::move(scan));
    }
    while (const auto result = pass.stopped ? std::nullopt : odometry.next())
      take(*result);
    if (progress) progress(input->progress.share());
  }
  source.stop();
  while (const auto result = pass.stopped ? std::nullopt : odometry.flush())
    take(*result);
  pass.problems = source.problems();
  pass.bridge = source.statistics();
  return pass;
}

}  // namespace fastlio
