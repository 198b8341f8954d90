// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mola_listener.cpp A module of MOLA for its test: notes what the odometry advertises, and
 * ends mola-cli when nothing more comes. */

#include <mrpt/core/initializer.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/system/datetime.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <mola_kernel/interfaces/ExecutableBase.h>
#include <mola_kernel/interfaces/LocalizationSourceBase.h>
#include <mola_kernel/interfaces/MapSourceBase.h>
#include <mutex>

#if __has_include(<mola_kernel/interfaces/SharedKeyframeMap.h>)
#define FASTLIO_TEST_NEWER 1
#include <mola_kernel/interfaces/DiagnosticsProvider.h>
#include <mola_kernel/interfaces/MapServer.h>
#include <mola_kernel/interfaces/Relocalization.h>
#include <mola_kernel/interfaces/SharedKeyframeMap.h>
using KeyframeSink = mola::SharedKeyframeMap;
#else
#define FASTLIO_TEST_NEWER 0
struct KeyframeSink
{
};
#endif

namespace fastlio_test
{
/** Parameters: `output`, a file with a line per pose and per map; `stop_after`, poses after which
 * the system is asked to end (0: when none has come for three seconds); `load`, a map that the
 * odometry goes on in after 50 poses. */
class MolaListener : public mola::ExecutableBase, public KeyframeSink
{
  DEFINE_MRPT_OBJECT(MolaListener, fastlio_test)

 public:
  MolaListener() = default;

  void initialize(const mola::Yaml& cfg) override
  {
    const auto params = mola::Yaml(cfg["params"]);
    output_ = params["output"].as<std::string>();
    out_.open(output_);
    stop_after_ = params.getOrDefault<std::size_t>("stop_after", 0);
    load_ = params.getOrDefault<std::string>("load", "");
    for (const auto& source : findService<mola::LocalizationSourceBase>())
      std::dynamic_pointer_cast<mola::LocalizationSourceBase>(source)
          ->subscribeToLocalizationUpdates([this](const auto& update) { note(update); });
    for (const auto& source : findService<mola::MapSourceBase>())
      std::dynamic_pointer_cast<mola::MapSourceBase>(source)->subscribeToMapUpdates(
          [this](const auto& update) { noteMap(update); });
  }

  void spinOnce() override
  {
    loadOnce();
    if (!isOver()) return;
    askForMore();
    requestShutdown();
  }

#if FASTLIO_TEST_NEWER
  std::optional<KeyFrameID> requestInsertKeyframe(const KeyframeInsertRequest& request) override
  {
    const std::lock_guard lock(mutex_);
    char line[200];
    std::snprintf(
        line, sizeof line, "keyframe %.6f %.3f %.3f %.3f %zu %.3f %.3f %s\n",
        mrpt::Clock::toDouble(request.timestamp), request.pose_in_source.mean.x(),
        request.pose_in_source.mean.y(), request.pose_in_source.mean.z(),
        request.observations.size(), request.quality,
        mrpt::system::timeDifference(
            request.observations.getObservationByIndex(0)->timestamp, request.timestamp),
        request.source_frame_id.c_str());
    out_ << line << std::flush;
    return keyframes_++;
  }
#endif

  int launchOrderPriority() const override
  {
    return 45;
  }  // after the odometry

 private:
  [[nodiscard]] bool isOver()
  {
    const std::lock_guard lock(mutex_);
    if (poses_ == 0) return false;
    const auto silence = std::chrono::steady_clock::now() - latest_;
    return stop_after_ > 0 ? poses_ >= stop_after_ : silence > std::chrono::seconds(3);
  }

  // What newer versions of MOLA's bridge ask of the odometry.
  void askForMore()
  {
#if FASTLIO_TEST_NEWER
    for (const auto& module : findService<mola::DiagnosticsProvider>())
    {
      std::vector<mola::DiagnosticStatusMsg> all;
      std::dynamic_pointer_cast<mola::DiagnosticsProvider>(module)->getDiagnostics(all);
      for (const auto& status : all)
        out_ << "diagnostic " << static_cast<int>(status.level) << ' ' << status.values.size()
             << ' ' << status.message << '\n';
    }
    for (const auto& module : findService<mola::MapServer>())
    {
      const auto server = std::dynamic_pointer_cast<mola::MapServer>(module);
      out_ << "saved " << server->map_save(output_).success << ' '
           << server->map_save("/nowhere/map").success << '\n';
    }
    out_ << std::flush;
#endif
  }

  // As somebody does who loads a map and clicks at the vehicle in it.
  void loadOnce()
  {
#if FASTLIO_TEST_NEWER
    constexpr std::size_t kPoses = 50;
    mrpt::poses::CPose3DPDFGaussian near;
    {
      const std::lock_guard lock(mutex_);
      if (load_.empty() || poses_ < kPoses) return;
      near.mean = mrpt::poses::CPose3D(latest_pose_);
    }
    near.cov.setDiagonal(6, 0.25);
    near.cov(3, 3) = 0.01;
    for (const auto& module : findService<mola::MapServer>())
    {
      const auto server = std::dynamic_pointer_cast<mola::MapServer>(module);
      const bool nonsense = server->map_load("/nowhere/map").success;
      const bool loaded = server->map_load(load_).success;
      const std::lock_guard lock(mutex_);
      out_ << "loaded " << loaded << ' ' << nonsense << '\n' << std::flush;
    }
    for (const auto& module : findService<mola::Relocalization>())
    {
      const auto finder = std::dynamic_pointer_cast<mola::Relocalization>(module);
      finder->relocalize_near_pose_pdf(near);
      finder->relocalize_from_gnss();
    }
    load_.clear();
#endif
  }

  void note(const mola::LocalizationSourceBase::LocalizationUpdate& update)
  {
    const std::lock_guard lock(mutex_);
    ++poses_;
    latest_ = std::chrono::steady_clock::now();
    latest_pose_ = update.pose;
    char line[200];
    std::snprintf(
        line, sizeof line, "pose %.6f %.6f %.6f %.6f %s %.3g\n",
        mrpt::Clock::toDouble(update.timestamp), update.pose.x, update.pose.y, update.pose.z,
        update.reference_frame.c_str(), update.cov ? (*update.cov)(0, 0) : -1.0);
    out_ << line << std::flush;
  }

  void noteMap(const mola::MapSourceBase::MapUpdate& update)
  {
    const auto points = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(update.map);
    const std::lock_guard lock(mutex_);
    out_ << "map " << (points ? points->size() : 0) << '\n' << std::flush;
  }

  std::string output_, load_;
  std::ofstream out_;
  std::mutex mutex_;
  std::size_t poses_ = 0, stop_after_ = 0, keyframes_ = 0;
  std::chrono::steady_clock::time_point latest_;
  mrpt::math::TPose3D latest_pose_;
};
}  // namespace fastlio_test

IMPLEMENTS_MRPT_OBJECT(MolaListener, mola::ExecutableBase, fastlio_test)

MRPT_INITIALIZER(registerListener)
{
  MOLA_REGISTER_MODULE(fastlio_test::MolaListener);
}
