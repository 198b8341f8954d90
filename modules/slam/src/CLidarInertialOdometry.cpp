// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "given_options.h"
#include "online_sensors.h"
#include "start_in_map.h"
#include <fastlio/compat/register_classes.h>
#include <fastlio/config/config_yaml.h>
#include <fastlio/map/register_classes.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/run/lidar_clock.h>
#include <fastlio/slam/CLidarInertialOdometry.h>

#include <mrpt/core/initializer.h>

#include <memory>
#include <stdexcept>
#include <utility>

IMPLEMENTS_MRPT_OBJECT(CLidarInertialOdometry, mrpt::rtti::CObject, fastlio)

MRPT_INITIALIZER(registerFastlioSlamClasses)
{
  fastlio::registerSlamClasses();
}

namespace fastlio
{
void registerSlamClasses()
{
  registerBridgeClasses();
  registerMapClasses();
  mrpt::rtti::registerClass(CLASS_ID(fastlio::CLidarInertialOdometry));
}

class CLidarInertialOdometry::Impl
{
 public:
  Impl(const Config& config, OptionFilter is_given)
      : lidar_clock(config.odometry.lidar.time_offset), sensors_(config, std::move(is_given))
  {
    makeOdometry(config.odometry);
  }

  /** A description of the observation for the log; empty when it was used or belongs to other
   * sensors. */
  std::string take(const mrpt::obs::CObservation::ConstPtr& observation)
  {
    const bool were_known = sensors_.areKnown();
    auto outputs = sensors_.convert(observation);
    // With the preset of the LiDAR, before the first sample.
    if (!were_known && sensors_.areKnown())
    {
      startAnew();
      lidar_clock = LidarClock(sensors_.config().odometry.lidar.time_offset);
    }
    for (BridgeOutput& output : outputs)
    {
      if (auto* sample = std::get_if<ImuSample>(&output)) odometry_->addImu(*sample);
      if (auto* scan = std::get_if<LidarScan>(&output)) odometry_->addScan(std::move(*scan));
    }
    return sensors_.takeMessage();
  }

  std::optional<LidarScan> decode(const mrpt::obs::CObservation& observation)
  {
    return sensors_.decode(observation);
  }

  void startIn(SavedMap map, const VehicleGuess& guess)
  {
    if (map.empty()) throw std::invalid_argument("the map to start in has no points");
    requireUsable(guess);
    if (odometry_->relocalize(ofImu(guess), &map))
      start_.reset();
    else
      begin({std::move(map), guess});
    latest.reset();
    track_ = PoseTrack({});
  }

  [[nodiscard]] bool relocalize(const VehicleGuess& guess)
  {
    requireUsable(guess);
    if (!odometry_->relocalize(ofImu(guess)))
    {
      if (!start_ && odometry_->map().pointCount() == 0) return false;
      begin({start_ ? std::move(start_->map) : savedMapOf(*odometry_), guess});
    }
    latest.reset();
    return true;
  }

  void drain(bool at_end)
  {
    while (const auto result = at_end ? odometry_->flush() : odometry_->next())
      announce(*result);
  }

  [[nodiscard]] const Odometry& odometry() const { return *odometry_; }
  [[nodiscard]] const PoseTrack& track() const { return track_; }

  std::optional<OdometryEstimate> latest;
  LidarClock lidar_clock;
  Callback callback;
  std::function<void(const ImuSample&)> sample_callback;

 private:
  void makeOdometry(const OdometryOptions& options)
  {
    odometry_.emplace(options);
    odometry_->setSampleCallback(
        [this](const ImuSample& sample)
        {
          if (sample_callback) sample_callback(sample);
        });
  }

  void announce(const ScanResult& result)
  {
    if (hasPose(result.status)) start_.reset();
    if (track_.poses().empty()) track_ = PoseTrack({"vehicle", sensors_.T_vehicle_imu().inverse()});
    track_.add(result);
    lidar_clock.add(result);
    latest = OdometryEstimate{result, std::nullopt};
    if (hasPose(result.status)) latest->vehicle = track_.poses().back();
    if (!callback) return;
    // Whoever is told may start anew, which empties `latest`.
    const OdometryEstimate estimate = *latest;
    callback(estimate);
  }

  struct StartInMap
  {
    SavedMap map;
    VehicleGuess guess;
  };

  /** Of a run without a state to go on with. */
  void begin(StartInMap start)
  {
    in_motion_ = in_motion_ || latest.has_value();
    start_ = std::move(start);
    startAnew();
  }

  [[nodiscard]] PoseGuess ofImu(const VehicleGuess& guess) const
  {
    return {guess.T_map_vehicle * sensors_.T_vehicle_imu(), guess.position_std, guess.yaw_std};
  }

  /** With what is known of the sensors; scans that wait for inertial samples are given up. */
  void startAnew()
  {
    if (!start_)
    {
      makeOdometry(sensors_.config().odometry);
      return;
    }
    makeOdometry(optionsFor(start_->guess));
    start_->map.T_map_imu = ofImu(start_->guess).T_world_imu;
    odometry_->startIn(start_->map);
  }

  [[nodiscard]] OdometryOptions optionsFor(const VehicleGuess& guess) const
  {
    OdometryOptions options = sensors_.config().odometry;
    options.initialization.pose_position_std = guess.position_std;
    options.initialization.pose_yaw_std = guess.yaw_std;
    // In the middle of a run nobody waits for a rest.
    if (in_motion_) options.initialization.mode = InitializationMode::Auto;
    return options;
  }

  std::optional<Odometry> odometry_;  // always there
  std::optional<StartInMap> start_;   // until the vehicle is found in the map
  bool in_motion_ = false;            // as far as anybody knows, at that start
  OnlineSensors sensors_;
  PoseTrack track_{{}};
};

CLidarInertialOdometry::CLidarInertialOdometry()
    : mrpt::system::COutputLogger("fastlio::CLidarInertialOdometry"),
      impl_(std::make_unique<Impl>(Config{}, differsFromDefault(Config{})))
{
}
CLidarInertialOdometry::~CLidarInertialOdometry() = default;

void CLidarInertialOdometry::initialize(const mrpt::containers::yaml& parameters)
{
  start(parameters.empty() ? Config{} : loadConfig(parameters), standsIn(parameters));
}

void CLidarInertialOdometry::initialize(const Config& config)
{
  start(config, differsFromDefault(config));
}

void CLidarInertialOdometry::start(const Config& config, OptionFilter is_given)
{
  Callback callback = std::move(impl_->callback);
  auto sample_callback = std::move(impl_->sample_callback);
  impl_ = std::make_unique<Impl>(config, std::move(is_given));
  impl_->callback = std::move(callback);
  impl_->sample_callback = std::move(sample_callback);
}

void CLidarInertialOdometry::onNewObservation(const mrpt::obs::CObservation::ConstPtr& observation)
{
  if (!observation) return;
  const std::string message = impl_->take(observation);
  if (!message.empty()) logStr(mrpt::system::LVL_INFO, message);
  impl_->drain(false);
}

std::optional<LidarScan> CLidarInertialOdometry::decode(
    const mrpt::obs::CObservation& observation) const
{
  return impl_->decode(observation);
}

std::int64_t CLidarInertialOdometry::poseTimeOf(std::int64_t stamp_ns) const
{
  return impl_->lidar_clock.poseTimeOf(stamp_ns);
}

void CLidarInertialOdometry::startIn(SavedMap map, const VehicleGuess& guess)
{
  impl_->startIn(std::move(map), guess);
}

bool CLidarInertialOdometry::relocalize(const VehicleGuess& guess)
{
  return impl_->relocalize(guess);
}

void CLidarInertialOdometry::finish()
{
  impl_->drain(true);
}

void CLidarInertialOdometry::setCallback(Callback callback)
{
  impl_->callback = std::move(callback);
}

void CLidarInertialOdometry::setSampleCallback(std::function<void(const ImuSample&)> callback)
{
  impl_->sample_callback = std::move(callback);
}

const Odometry& CLidarInertialOdometry::estimator() const
{
  return impl_->odometry();
}

const std::optional<OdometryEstimate>& CLidarInertialOdometry::latest() const
{
  return impl_->latest;
}

const PoseTrack& CLidarInertialOdometry::track() const
{
  return impl_->track();
}

mrpt::maps::CSimplePointsMap::Ptr CLidarInertialOdometry::map() const
{
  return impl_->odometry().map().toPointsMap();
}

SavedMap CLidarInertialOdometry::savedMap() const
{
  return savedMapOf(impl_->odometry());
}

const OdometryOptions& CLidarInertialOdometry::parameters() const
{
  return impl_->odometry().parameters();
}

}  // namespace fastlio
