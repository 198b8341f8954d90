// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file exporter.h Exporters of results: one class per file format, fed scan by scan. */
#pragma once

#include <fastlio/files/atomic_file.h>
#include <fastlio/interface/imu_rate.h>
#include <fastlio/interface/scan_result.h>
#include <fastlio/run/output_map.h>
#include <fastlio/run/run_summary.h>

#include <memory>
#include <string>
#include <vector>

namespace fastlio
{
class SurfaceMap;

/** The state of the run after the last scan. */
struct RunEnd
{
  const RunSummary& summary;  //!< with the outputs of the exporters that finished before
  const OutputMap& map;       //!< final map, world frame; empty unless an exporter needs it
  /** The map that scans were matched with, if there is one. */
  const SurfaceMap* surfaces = nullptr;
  std::string map_problem = {};  //!< why the map is not complete, or empty
};

/** Turns a run into one or more files. Constructors open the files, so that an unwritable place is
 * known before the run; rows are written as they come. */
class Exporter
{
 public:
  Exporter() = default;
  virtual ~Exporter() = default;
  Exporter(const Exporter&) = delete;
  Exporter& operator=(const Exporter&) = delete;

  /** Takes one scan's result, in time order.
   * \exception std::runtime_error the file cannot be written */
  virtual void onScan(const ScanResult& /*result*/) {}

  /** Takes the states between the scan before and the one that onScan() gets next, in time order;
   * for files at the rate of the inertial sensor.
   * \exception std::runtime_error the file cannot be written */
  virtual void onImuRate(const std::vector<ImuRateState>& /*states*/) {}

  /** Whether finish() needs the map. */
  [[nodiscard]] virtual bool needsMap() const { return false; }

  /** Whether finish() makes use of the map, and can do without. */
  [[nodiscard]] virtual bool usesMap() const { return needsMap(); }

  /** Completes the files and gives them their final names.
   * \exception std::runtime_error the file cannot be written */
  virtual std::vector<OutputFile> finish(const RunEnd& end) = 0;
};

/** All exporters of a run. One that fails is left out from there on and reported; the others go on.
 */
class ExporterSet
{
 public:
  /** \param file what the exporter writes, for messages that do not name it themselves */
  void add(std::unique_ptr<Exporter> exporter, std::string file = {});
  /** One scan, and the states at the inertial samples before it (Odometry::imuRateStates()). */
  void onScan(const ScanResult& result, const std::vector<ImuRateState>& before = {});

  /** Finishes all, in the order they were added.
   * \return the summary, completed with outputs and output_problems */
  [[nodiscard]] RunSummary finish(
      RunSummary summary, const OutputMap& map, const SurfaceMap* surfaces = nullptr);

  /** Leaves out the exporters that need the map from here on, because it is not complete. */
  void giveUpMap(const std::string& reason);

  /** Whether any of them uses the map: otherwise none has to be collected. */
  [[nodiscard]] bool needMap() const;

  /** Sentences about exporters that failed so far. */
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

 private:
  struct Member
  {
    std::unique_ptr<Exporter> exporter;  //!< null: given up
    std::string file;
  };

  void giveUp(Member& member, const std::string& reason);

  std::vector<Member> members_;
  std::vector<std::string> problems_;
  std::string map_problem_;  //!< why the map is not complete
};

}  // namespace fastlio
