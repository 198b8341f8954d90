// mrpt_fastlio: an output of your own: a row of exporterKinds() with a class behind it.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/made_folders.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/options/number_text.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/survey/sensor_selection.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <variant>

namespace
{
/** `speed.csv`: how fast the IMU moves at the end of each scan. */
class SpeedExporter : public fastlio::Exporter
{
 public:
  explicit SpeedExporter(const std::string& path) : file_(path)
  {
    file_.write("stamp_ns,speed_m_s\n");
  }

  void onScan(const fastlio::ScanResult& result) override
  {
    if (!fastlio::hasPose(result.status)) return;
    const double speed = result.filter.x.v.norm();  // [m/s]
    file_.write(std::to_string(result.stamp_ns) + "," + fastlio::roundTripText(speed) + "\n");
  }

  // commit() gives the file its name: from here on it is complete.
  std::vector<fastlio::OutputFile> finish(const fastlio::RunEnd& /*end*/) override
  {
    return {file_.commit()};
  }

 private:
  fastlio::AtomicFile file_;
};

/** All formats of the project, and ours. */
std::vector<fastlio::ExporterKind> kindsWithSpeed()
{
  std::vector<fastlio::ExporterKind> kinds = fastlio::exporterKinds();
  const fastlio::ExporterKind speed = {
      "speed", "speed.csv", "speed at each scan's end", true,
      [](const fastlio::ExportTarget& target) -> std::unique_ptr<fastlio::Exporter>
      { return std::make_unique<SpeedExporter>(target.path("speed.csv")); }};
  kinds.insert(kinds.begin(), speed);  // the summary stays the last, it lists the files before it
  return kinds;
}

fastlio::ExporterSet exportersInto(const std::string& directory)
{
  fastlio::ExportTarget target;
  target.directory = directory;
  target.parameters.exporters = "trajectory, speed";
  return fastlio::makeExporters(target, kindsWithSpeed());
}

/** Number of files that were completed. */
std::size_t replay(const std::string& rawlog, const std::string& directory)
{
  const fastlio::MadeFolders folder(directory);  // removed in the end when it is still empty
  fastlio::ExporterSet exporters = exportersInto(directory);
  fastlio::Odometry odometry({});  // every option has its default

  const fastlio::SensorPatterns any;
  fastlio::ObservationBridge bridge(
      fastlio::selectSensors(fastlio::surveySensors({rawlog}, any), any));
  fastlio::RawlogSource source({rawlog});
  while (const auto observation = source.next())
  {
    auto input = bridge.convert(*observation);
    if (const auto* sample = std::get_if<fastlio::ImuSample>(&input)) odometry.addImu(*sample);
    if (auto* scan = std::get_if<fastlio::LidarScan>(&input)) odometry.addScan(std::move(*scan));
    while (const auto result = odometry.next())
      exporters.onScan(*result);
  }

  const fastlio::RunSummary summary = exporters.finish({}, fastlio::OutputMap());
  for (const fastlio::OutputFile& file : summary.outputs)
    std::cout << file.path << ": " << file.bytes << " bytes\n";
  for (const std::string& problem : summary.output_problems)
    std::cerr << problem << "\n";
  return summary.outputs.size();
}
}  // namespace

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "Usage: own_exporter RECORDING.rawlog DIRECTORY\n";
    return EXIT_FAILURE;
  }
  try
  {
    return replay(argv[1], argv[2]) > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
