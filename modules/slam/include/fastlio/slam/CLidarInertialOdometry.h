// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file CLidarInertialOdometry.h The odometry as MRPT programs use one: made by name, set up from
 * YAML, fed with observations. */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/config/config_document.h>
#include <fastlio/interface/scan_result.h>
#include <fastlio/localmap/saved_map.h>
#include <fastlio/run/pose_track.h>

#include <mrpt/containers/yaml.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/system/COutputLogger.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace fastlio
{
class Odometry;

/** The outcome of a scan. */
struct OdometryEstimate
{
  ScanResult result;  //!< of the IMU
  /** Of the vehicle, to which the sensorPoses of the observations refer; nothing when the pose is
   * not to be trusted. */
  std::optional<TrackedPose> vehicle;
};

/** About where the vehicle is in a map. The pose is searched as far around as the standard
 * deviations reach; gravity shows roll and pitch. */
struct VehicleGuess
{
  Pose T_map_vehicle;
  double position_std = InitializationOptions{}.pose_position_std;  //!< [m], 0 to 100
  double yaw_std = InitializationOptions{}.pose_yaw_std;            //!< [rad], 0 to pi
};

/** LiDAR-inertial odometry behind the interface of MRPT's class registry:
 *
 * \code
 * mrpt::system::loadPluginModules("libmrpt_fastlio_plugin.so");
 * auto object = mrpt::rtti::classFactory("fastlio::CLidarInertialOdometry");
 * auto odometry = std::dynamic_pointer_cast<fastlio::CLidarInertialOdometry>(object);
 * odometry->initialize(mrpt::containers::yaml::FromFile("params.yaml"));
 * odometry->onNewObservation(observation);
 * \endcode
 *
 * Sensors: of each kind the first that is usable and whose label matches input.lidar_sensor_label
 * or input.imu_sensor_label; observations of others are left alone, and so are further LiDARs. The
 * first few scans are kept until it is clear what the times of their points mean. When the label or
 * the data of the LiDAR name a model of params/, its values take the place of the defaults, and the
 * log says so; what the user gave stays. Scans are
 * processed once inertial samples reach their end, inside of onNewObservation(). One thread uses an
 * object. */
class CLidarInertialOdometry : public mrpt::rtti::CObject, public mrpt::system::COutputLogger
{
  DEFINE_MRPT_OBJECT(CLidarInertialOdometry, fastlio)

 public:
  using Callback = std::function<void(const OdometryEstimate&)>;

  CLidarInertialOdometry();
  ~CLidarInertialOdometry() override;
  CLidarInertialOdometry(const CLidarInertialOdometry& other) = delete;
  CLidarInertialOdometry& operator=(const CLidarInertialOdometry& other) = delete;
  CLidarInertialOdometry(CLidarInertialOdometry&&) = delete;
  CLidarInertialOdometry& operator=(CLidarInertialOdometry&&) = delete;

  /** Takes parameters (docs/parameters.md; an empty document: all defaults) and starts anew.
   * \exception std::invalid_argument lists every problem of the document */
  void initialize(const mrpt::containers::yaml& parameters);
  /** The same with parameters that were set in code: values other than the defaults. */
  void initialize(const Config& config);

  /** Takes an observation of any class; those of other sensors are left alone. Before initialize(),
   * the defaults count. Data never throw: what cannot be used is logged. */
  void onNewObservation(const mrpt::obs::CObservation::ConstPtr& observation);

  /** Goes on in another map. Poses and track() refer to it from now on; there are none until the
   * vehicle is found in it. Sensors that are known stay so.
   * \param map its T_map_imu does not count
   * \exception std::invalid_argument the map is empty, or the guess is out of range; nothing has
   * changed then */
  void startIn(SavedMap map, const VehicleGuess& guess);

  /** Searches the vehicle anew in the map in use, which stays. There are no poses until it is
   * found.
   * \return false: there is no map yet; nothing has changed
   * \exception std::invalid_argument as startIn() */
  bool relocalize(const VehicleGuess& guess);

  /** No more observations: also processes scans that reach beyond the inertial data. */
  void finish();

  /** Called for every scan, from within onNewObservation() and finish(). */
  void setCallback(Callback callback);

  /** Called for every inertial sample in use, as Odometry::setSampleCallback() gives it. */
  void setSampleCallback(std::function<void(const ImuSample&)> callback);

  /** The estimator within: in a callback, it has the registered points of this scan. */
  [[nodiscard]] const Odometry& estimator() const;

  /** The latest scan's result; nothing before the first. */
  [[nodiscard]] const std::optional<OdometryEstimate>& latest() const;

  /** The points of a scan of the LiDAR in use, without taking it in; nothing for observations of
   * other sensors, and as long as the sensors are not known. */
  [[nodiscard]] std::optional<LidarScan> decode(const mrpt::obs::CObservation& observation) const;

  /** The stamp of a raw scan on the clock of track(): with the offset that was given and found
   * [ns].
   */
  [[nodiscard]] std::int64_t poseTimeOf(std::int64_t stamp_ns) const;

  /** All poses of the vehicle so far. */
  [[nodiscard]] const PoseTrack& track() const;

  /** The points of the map that scans are matched with: a copy. */
  [[nodiscard]] mrpt::maps::CSimplePointsMap::Ptr map() const;

  /** The map in use as it is, with its planes where it has some: for startIn(), there or in another
   * run. A copy. */
  [[nodiscard]] SavedMap savedMap() const;

  /** In use; with the preset of the LiDAR once it is known. */
  [[nodiscard]] const OdometryOptions& parameters() const;

 private:
  void start(const Config& config, OptionFilter is_given);

  class Impl;
  std::unique_ptr<Impl> impl_;
};

/** Registers the classes of this module with mrpt::rtti; runs by itself when the library is loaded.
 */
void registerSlamClasses();

}  // namespace fastlio
