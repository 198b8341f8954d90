// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/register_classes.h>
#include <fastlio/config/config_document.h>
#include <fastlio/files/atomic_file.h>
#include <fastlio/files/gzip_file.h>
#include <fastlio/files/same_file.h>
#include <fastlio/options/number_text.h>
#include <fastlio/parallel/workers.h>
#include <fastlio/run/run_folder.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/recording.h>

#include <Eigen/Geometry>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string_view>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::int64_t kTruthPeriodNs = 5'000'000;
constexpr std::size_t kSweepsAtOnce = 16;

/** The bytes of an object as a rawlog holds them. */
std::string serialized(const mrpt::serialization::CSerializable& object)
{
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream).WriteObject(object);
  const std::uint64_t length = stream.getTotalBytesCount();
  return {static_cast<const char*>(stream.getRawBufferData()), static_cast<std::size_t>(length)};
}

/** An observation on its way to the file. */
struct Encoded
{
  std::int64_t stamp_ns = 0;
  std::string bytes;
};

/** Puts observations into a gzip file in the order of their stamps. */
class RawlogFile
{
 public:
  /** \param aids observations of other sensors, in the order of their stamps */
  RawlogFile(
      const std::string& path, const std::vector<ImuSample>& samples, std::vector<Encoded> aids)
      : samples_(samples), aids_(std::move(aids)), file_(path)
  {
  }

  void write(const Encoded& sweep)
  {
    writeUntil(sweep.stamp_ns);
    file_.write(sweep.bytes);
  }

  void finish()
  {
    writeUntil(std::numeric_limits<std::int64_t>::max());
    file_.commit();
  }

 private:
  void writeUntil(std::int64_t stamp_ns)
  {
    for (; next_ < samples_.size() && samples_[next_].stamp_ns <= stamp_ns; ++next_)
    {
      // Of what has one stamp, the IMU comes first.
      writeAidsBefore(samples_[next_].stamp_ns);
      file_.write(serialized(*toImuObservation(samples_[next_])));
    }
    writeAidsBefore(stamp_ns);
  }

  void writeAidsBefore(std::int64_t stamp_ns)
  {
    for (; next_aid_ < aids_.size() && aids_[next_aid_].stamp_ns < stamp_ns; ++next_aid_)
      file_.write(aids_[next_aid_].bytes);
  }

  const std::vector<ImuSample>& samples_;
  std::vector<Encoded> aids_;
  GzipFile file_;
  std::size_t next_ = 0, next_aid_ = 0;
};

/** The observations of the sensors beside LiDAR and IMU, in the order of stamps. */
std::vector<Encoded> encodeAids(const Simulation& simulation)
{
  std::vector<Encoded> aids;
  for (const SimulatedFix& fix : simulation.gnss())
    aids.push_back({fix.stamp_ns, serialized(*toGnssObservation(fix, simulation.settings().gnss))});
  for (const WheelReading& reading : simulation.wheels())
    aids.push_back({reading.stamp_ns, serialized(*toWheelObservation(reading))});
  std::stable_sort(
      aids.begin(), aids.end(),
      [](const Encoded& a, const Encoded& b) { return a.stamp_ns < b.stamp_ns; });
  return aids;
}

Encoded encodeSweep(const Simulation& simulation, std::size_t index)
{
  const auto observation = toLidarObservation(simulation, index);
  return {toNanoseconds(observation->timestamp), serialized(*observation)};
}

void writeRawlog(
    const Simulation& simulation, const std::string& path, const RecordingProgress& progress)
{
  registerBridgeClasses();
  RawlogFile file(path, simulation.imu().samples, encodeAids(simulation));
  const Workers workers(0);
  const std::size_t total = simulation.scanCount();
  std::size_t done = 0;
  std::vector<Encoded> coming, ready;
  const auto writeReady = [&]
  {
    for (const Encoded& sweep : ready)
    {
      file.write(sweep);
      if (progress) progress(++done, total);
    }
  };
  // Sweeps are fired and encoded in parallel, but compressed and written in order.
  for (std::size_t first = 0; first < total; first += kSweepsAtOnce)
  {
    coming.resize(std::min(kSweepsAtOnce, total - first));
    const auto encode = [&](std::size_t i) { coming[i] = encodeSweep(simulation, first + i); };
    workers.alongside(writeReady, [&] { workers.forEach(coming.size(), encode); });
    ready.swap(coming);
  }
  writeReady();
  file.finish();
}

std::string configText(const SimulationSettings& settings)
{
  const std::string header = "# Parameters that match the simulated recording '" +
                             settings.scenario + "', seed " + std::to_string(settings.seed) + ".\n";
  return toYaml(matchingConfig(settings), header);
}

RecordingFiles filesOf(const std::string& directory)
{
  return {
      directory + "/recording.rawlog", directory + "/ground_truth.tum", directory + "/config.yaml",
      directory + "/scenario.json"};
}

RunFolderPlan folderPlan(const std::string& directory, bool overwrite)
{
  return {
      directory,
      {"recording.rawlog", "ground_truth.tum", "config.yaml", "scenario.json"},
      "scenario.json",
      "scenario",
      overwrite};
}
}  // namespace

std::string groundTruthText(const Simulation& simulation)
{
  const std::int64_t start_ns = simulation.settings().start_ns;
  const auto count = static_cast<std::int64_t>(
      simulation.settings().duration * 1e9 / static_cast<double>(kTruthPeriodNs) + 1e-6);
  std::string text = "# time[s] x y z[m] qx qy qz qw: IMU in the world\n";
  for (std::int64_t i = 0; i <= count; ++i)
  {
    const std::int64_t stamp_ns = start_ns + i * kTruthPeriodNs;
    const Pose pose = simulation.truth(stamp_ns).T_world_imu;
    Eigen::Quaterniond q(pose.R);
    if (q.w() < 0.0) q.coeffs() = -q.coeffs();
    text += secondsText(stamp_ns);
    for (const double v : {pose.p.x(), pose.p.y(), pose.p.z(), q.x(), q.y(), q.z(), q.w()})
      text += ' ' + fixedText(v, 9);
    text += '\n';
  }
  return text;
}

void requireRecordingPlace(const std::string& directory, bool overwrite)
{
  const RecordingFiles files = filesOf(directory);
  requireDistinctFiles(
      {}, {{files.rawlog, "recording"},
           {files.ground_truth, "ground truth"},
           {files.config, "configuration"},
           {files.scenario, "scenario"}});
  requireReplaceable(folderPlan(directory, overwrite));
}

RecordingFiles writeRecording(
    const Simulation& simulation, const std::string& directory, const RecordingProgress& progress,
    bool overwrite)
{
  requireRecordingPlace(directory, overwrite);
  const RunFolder folder(folderPlan(directory, overwrite));
  RecordingFiles files = filesOf(directory);
  // The largest is the first: where it does not fit, what was there before stays as it was.
  writeRawlog(simulation, files.rawlog, progress);
  try
  {
    writeFileAtomically(files.config, configText(simulation.settings()));
    writeFileAtomically(files.ground_truth, groundTruthText(simulation));
    // The last: it says that the recording is complete.
    writeFileAtomically(files.scenario, scenarioJson(simulation));
  }
  catch (...)
  {
    for (const std::string& file : {files.rawlog, files.config, files.ground_truth})
      std::remove(file.c_str());
    throw;
  }
  folder.removeLeftovers({});
  return files;
}

}  // namespace fastlio
