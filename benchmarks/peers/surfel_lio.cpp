// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file surfel_lio.cpp Runs Surfel-LIO with a configuration file of its own, on one thread, with
 * the extrinsic of the recording. It takes the pose at its last inertial sample for that at the end
 * of the scan, so it gets a sample there, interpolated between its neighbours. */

#include "ConfigUtils.h"
#include "Estimator.h"
#include "peer_run.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <spdlog/spdlog.h>
#include <utility>

namespace
{
/** The sample at a time between two others. */
peers::ImuRecord between(
    const peers::ImuRecord& before, const peers::ImuRecord& after, std::int64_t stamp_ns)
{
  const double weight = static_cast<double>(stamp_ns - before.stamp_ns) /
                        static_cast<double>(after.stamp_ns - before.stamp_ns);
  peers::ImuRecord sample;
  sample.stamp_ns = stamp_ns;
  for (int i = 0; i < 3; ++i)
  {
    sample.gyro[i] = (1.0 - weight) * before.gyro[i] + weight * after.gyro[i];
    sample.accel[i] = (1.0 - weight) * before.accel[i] + weight * after.accel[i];
  }
  return sample;
}

class SurfelLio
{
 public:
  SurfelLio(const std::vector<peers::Record>& records, const std::string& config_file)
  {
    spdlog::set_level(spdlog::level::off);
    lio::LIOConfig config;
    if (!lio::LoadConfig(config_file, config))
      throw std::runtime_error(config_file + " cannot be read");
    configure(config);
    initializeAtRest(records, static_cast<std::size_t>(config.estimator.init_imu_samples));
  }

  // A sample later than the scan's end arrives before the scan: it waits for the scan.
  void addImu(const peers::ImuRecord& sample) { samples_.push_back(sample); }

  void prepare(const peers::ScanRecord& scan)
  {
    scan_ = &scan;
    cloud_ = std::make_shared<lio::PointCloud>();
    const std::int64_t start_ns = last_end_ns_ != 0 ? last_end_ns_ : scan.end_ns - 100000000;
    for (const peers::PointRecord& point : scan.points)
    {
      lio::Point3D its(point.x, point.y, point.z);
      const std::int64_t offset_ns = scan.begin_ns + point.offset_ns - start_ns;
      its.offset_time =
          static_cast<float>(static_cast<double>(std::max<std::int64_t>(offset_ns, 0)) * 1e-9);
      cloud_->push_back(its);
    }
    last_end_ns_ = scan.end_ns;
  }

  void addScan()
  {
    std::size_t used = 0;
    while (used < samples_.size() && samples_[used].stamp_ns <= scan_->end_ns)
      propagate(samples_[used++]);
    if (used > 0 && used < samples_.size() && samples_[used - 1].stamp_ns < scan_->end_ns)
      propagate(between(samples_[used - 1], samples_[used], scan_->end_ns));
    samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(used));
    usable_ = scan_->end_ns > initialized_ns_;
    if (usable_) estimator_->ProcessLidar(lio::LidarData(seconds(scan_->end_ns), cloud_));
  }

  bool pose(peers::TimedPose& pose) const
  {
    const lio::State state = estimator_->GetCurrentState();
    const Eigen::Quaternionf q(state.m_rotation);
    pose.stamp_ns = scan_->end_ns;
    for (int i = 0; i < 3; ++i)
      pose.position[i] = state.m_position[i];
    for (int i = 0; i < 4; ++i)
      pose.quaternion[i] = q.coeffs()[i];
    return usable_;
  }

 private:
  static constexpr double kLongestRest = 2.0;  // [s]; that the recordings of the tables begin with

  static double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

  static lio::IMUData dataOf(const peers::ImuRecord& sample)
  {
    return lio::IMUData(
        seconds(sample.stamp_ns), Eigen::Vector3d::Map(sample.accel).cast<float>(),
        Eigen::Vector3d::Map(sample.gyro).cast<float>());
  }

  void propagate(const peers::ImuRecord& sample)
  {
    if (sample.stamp_ns > initialized_ns_) estimator_->ProcessIMU(dataOf(sample));
  }

  void configure(const lio::LIOConfig& config)
  {
    auto& parameters = estimator_->m_params;
    const auto& own = config.estimator;
    parameters.voxel_size = own.voxel_size;
    parameters.max_correspondences = own.max_correspondences;
    parameters.max_correspondence_distance = own.max_correspondence_distance;
    parameters.max_iterations = own.max_iterations;
    parameters.convergence_threshold = own.convergence_threshold;
    parameters.enable_undistortion = own.enable_undistortion;
    parameters.min_range = own.min_distance;
    parameters.max_map_distance = own.max_distance;
    parameters.map_box_multiplier = own.map_box_multiplier;
    parameters.voxel_hierarchy_factor = own.voxel_hierarchy_factor;
    parameters.scan_planarity_threshold = own.scan_planarity_threshold;
    parameters.map_planarity_threshold = own.map_planarity_threshold;
    parameters.point_to_surfel_threshold = own.point_to_surfel_threshold;
    parameters.min_surfel_inliers = own.min_surfel_inliers;
    parameters.min_linearity_ratio = own.min_linearity_ratio;
    parameters.stride = own.stride;
    parameters.stride_then_voxel = own.stride_then_voxel;
    parameters.scan_duration = own.scan_duration;
    parameters.gyr_noise_std = std::sqrt(config.imu.gyr_cov);
    parameters.acc_noise_std = std::sqrt(config.imu.acc_cov);
    parameters.gyr_bias_noise_std = std::sqrt(config.imu.b_gyr_cov);
    parameters.acc_bias_noise_std = std::sqrt(config.imu.b_acc_cov);
    parameters.gravity = config.imu.gravity.cast<float>();
    estimator_->UpdateProcessNoise();
  }

  /** Takes the first samples for a rest, as its player does, but not more than two seconds, and the
   * extrinsic of the first scan. */
  void initializeAtRest(const std::vector<peers::Record>& records, std::size_t count)
  {
    std::vector<lio::IMUData> rest;
    const peers::ScanRecord* first_scan = nullptr;
    for (const peers::Record& record : records)
    {
      const auto* sample = std::get_if<peers::ImuRecord>(&record);
      if (sample != nullptr && rest.size() < count &&
          (rest.empty() || seconds(sample->stamp_ns) - rest.front().timestamp <= kLongestRest))
      {
        rest.push_back(dataOf(*sample));
        initialized_ns_ = sample->stamp_ns;
      }
      if (sample == nullptr && first_scan == nullptr)
        first_scan = &std::get<peers::ScanRecord>(record);
    }
    if (first_scan == nullptr) throw std::runtime_error("the input has no scan");
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    estimator_->m_params.R_il = RowMajor::Map(first_scan->R_imu_lidar).cast<float>();
    estimator_->m_params.t_il = Eigen::Vector3d::Map(first_scan->p_imu_lidar).cast<float>();
    if (!estimator_->GravityInitialization(rest)) throw std::runtime_error("it finds no rest");
  }

  std::unique_ptr<lio::Estimator> estimator_ = std::make_unique<lio::Estimator>();
  std::vector<peers::ImuRecord> samples_;
  lio::PointCloudPtr cloud_;
  const peers::ScanRecord* scan_ = nullptr;
  std::int64_t initialized_ns_ = 0, last_end_ns_ = 0;
  bool usable_ = false;
};
}  // namespace

int main(int argc, char** argv)
{
  return peers::main(
      argc, argv,
      [](const std::vector<peers::Record>& records, const std::string& config_file)
      { return SurfelLio(records, config_file); });
}
