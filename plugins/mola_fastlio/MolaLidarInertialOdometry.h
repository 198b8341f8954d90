// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file MolaLidarInertialOdometry.h The odometry as a front-end of MOLA; built where MOLA is. */
#pragma once

#include <fastlio/slam/CLidarInertialOdometry.h>

#include <deque>
#include <memory>
#include <mola_kernel/interfaces/FrontEndBase.h>
#include <mola_kernel/interfaces/LocalizationSourceBase.h>
#include <mola_kernel/interfaces/MapSourceBase.h>
#include <mutex>

namespace fastlio
{
/** The type of the only argument of a method: MOLA's consumers take pointers to observations or to
 * constant ones, depending on the version. */
template <typename Method>
struct ArgumentOf;
template <typename Class, typename Argument>
struct ArgumentOf<void (Class::*)(Argument)>
{
  using type = Argument;
};

/** Takes observations of the modules in `raw_data_source`, and advertises pose and map:
 *
 *     modules:
 *       - name: odometry
 *         type: fastlio::MolaLidarInertialOdometry
 *         raw_data_source: dataset
 *         execution_rate: 50
 *         params:
 *           reference_frame: map         # of the pose
 *           map_every_n_scans: 10        # 0: no map
 *           output_tum_path: walk.tum    # poses of the vehicle, written at the end; default: none
 *           odometry:                    # docs/parameters.md; without it: all defaults
 *             map:
 *               voxel_size: 0.3
 *
 * onNewObservation() only puts into a queue; spinOnce() empties it, and so does onQuit(): every
 * observation that was sent is used. */
class MolaLidarInertialOdometry : public mola::FrontEndBase,
                                  public mola::LocalizationSourceBase,
                                  public mola::MapSourceBase
{
  DEFINE_MRPT_OBJECT(MolaLidarInertialOdometry, fastlio)

 public:
  using ObservationArgument = ArgumentOf<decltype(&mola::RawDataConsumer::onNewObservation)>::type;

  MolaLidarInertialOdometry();

  void onNewObservation(ObservationArgument observation) override;
  void spinOnce() override;
  void onQuit() override;
  /** Before the data sources (50), which would drop what they send until somebody listens. */
  int launchOrderPriority() const override { return 40; }

 protected:
  void initialize_frontend(const mola::Yaml& cfg) override;

 private:
  void advertise(const OdometryEstimate& estimate);
  void advertiseMap(std::int64_t stamp_ns);
  void writeTrajectory();
  [[nodiscard]] mrpt::obs::CObservation::ConstPtr takeOne();

  std::string reference_frame_ = "map";
  std::size_t map_every_n_scans_ = 10;
  std::string output_tum_path_;
  std::size_t scans_ = 0;
  CLidarInertialOdometry odometry_;
  std::mutex queue_mutex_;
  std::deque<mrpt::obs::CObservation::ConstPtr> queue_;
};

}  // namespace fastlio
