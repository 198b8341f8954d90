// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file MolaLidarInertialOdometry.h The odometry as a front-end of MOLA; built where MOLA is. */
#pragma once

#include "MolaDiagnostics.h"
#include "MolaKeyframes.h"
#include <fastlio/slam/CLidarInertialOdometry.h>

#include <deque>
#include <memory>
#include <mola_kernel/interfaces/FrontEndBase.h>
#include <mola_kernel/interfaces/LocalizationSourceBase.h>
#include <mola_kernel/interfaces/MapSourceBase.h>
#include <mutex>

#if __has_include(<mola_kernel/interfaces/MapServer.h>)
#define FASTLIO_MOLA_HAS_MAP_SERVER 1
#include <mola_kernel/interfaces/MapServer.h>
#else
#define FASTLIO_MOLA_HAS_MAP_SERVER 0
#endif

#if __has_include(<mola_kernel/interfaces/Relocalization.h>)
#define FASTLIO_MOLA_HAS_RELOCALIZATION 1
#include <mola_kernel/interfaces/Relocalization.h>
#else
#define FASTLIO_MOLA_HAS_RELOCALIZATION 0
#endif

namespace fastlio
{
/** Saves and loads the map when MOLA asks for it, where MOLA does. */
#if FASTLIO_MOLA_HAS_MAP_SERVER
using MolaMapServer = mola::MapServer;
#else
class MolaMapServer
{
};
#endif

/** Searches the pose anew where MOLA asks for that. */
#if FASTLIO_MOLA_HAS_RELOCALIZATION
using MolaRelocalization = mola::Relocalization;
#else
class MolaRelocalization
{
};
#endif

/** The type of the only argument of a method: MOLA's consumers take pointers to observations or to
 * constant ones, depending on the version. */
template <typename Method>
struct ArgumentOf;
template <typename Class, typename Argument>
struct ArgumentOf<void (Class::*)(Argument)>
{
  using type = Argument;
};

/** Takes observations of the modules in `raw_data_source`, and advertises pose, map and health:
 *
 *     modules:
 *       - name: odometry
 *         type: fastlio::MolaLidarInertialOdometry
 *         raw_data_source: dataset
 *         execution_rate: 50
 *         params:
 *           reference_frame: map         # of the pose
 *           map_every_n_scans: 10        # 0: no map
 *           output_tum_path: walk.tum    # poses of the vehicle, written at the end; default: none.
 *                                        # Poses before a map was loaded: walk_1.tum, walk_2.tum...
 *           odometry:                    # docs/parameters.md; without it: all defaults
 *             map:
 *               voxel_size: 0.3
 *
 * onNewObservation() only puts into a queue; spinOnce() empties it, and so does onQuit(): every
 * observation that was sent is used. */
class MolaLidarInertialOdometry : public mola::FrontEndBase,
                                  public mola::LocalizationSourceBase,
                                  public mola::MapSourceBase,
                                  public MolaDiagnostics,
                                  public MolaMapServer,
                                  public MolaRelocalization
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

#if FASTLIO_MOLA_HAS_MAP_SERVER
  /** Writes `path`.metricmap, which `--map-in` of the programs takes. From any thread. */
  ReturnStatus map_save(const std::string& path) override;
  /** Goes on in the map of `path`.metricmap, about where it begins; relocalize_near_pose_pdf()
   * gives another place. Nothing changes when it cannot be read. From any thread. */
  ReturnStatus map_load(const std::string& path) override;
#endif

#if FASTLIO_MOLA_HAS_RELOCALIZATION
  /** Searches the vehicle around this pose in the map in use, as far as its covariance says; poses
   * are advertised again when it is found. From any thread. */
  void relocalize_near_pose_pdf(const mrpt::poses::CPose3DPDFGaussian& pose) override;
  /** Nothing changes, and the log says so: the odometry does not use GNSS. */
  void relocalize_from_gnss() override;
#endif

 protected:
  void initialize_frontend(const mola::Yaml& cfg) override;

 private:
  void advertise(const OdometryEstimate& estimate);
  void advertiseMap(std::int64_t stamp_ns);
  void offerKeyframe(const OdometryEstimate& estimate);
  void writeTrajectory(const std::string& path);
  [[nodiscard]] std::string earlierTrajectoryPath() const;
  [[nodiscard]] mrpt::obs::CObservation::ConstPtr takeOne();

  std::string reference_frame_ = "map";
  std::size_t map_every_n_scans_ = 10;
  std::string output_tum_path_;
  std::size_t scans_ = 0, loaded_maps_ = 0;
  std::recursive_mutex odometry_mutex_;  // who is told of a pose may ask for the map at once
  CLidarInertialOdometry odometry_;
  MolaKeyframes keyframes_;
  std::mutex queue_mutex_;
  std::deque<mrpt::obs::CObservation::ConstPtr> queue_;
};

}  // namespace fastlio
