// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "external_storage.h"

#include "rotating_scan_stream.h"
#include <fastlio/compat/mrpt_messages.h>

#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <filesystem>
#include <functional>

namespace
{
namespace fs = std::filesystem;

// The names that MRPT gives the folder of a rawlog NAME.rawlog. (CRawlog::detectImagesDirectory()
// of 2.5.8 loses the slash between folder and name.)
std::string externalFolderOf(const std::string& rawlog)
{
  const fs::path folder = fs::path(rawlog).parent_path();
  const std::string name = fs::path(rawlog).stem().string();
  for (const std::string& candidate : {name + "_Images", name + "_images", std::string("Images")})
  {
    std::error_code error;
    if (fs::is_directory(folder / candidate, error)) return (folder / candidate).string();
  }
  return (folder / (name + "_Images")).string();
}
}  // namespace

namespace fastlio
{
namespace
{
// What is kept in a file, and how to load it.
struct External
{
  std::string file;  // empty: nothing
  const char* what = "";
  std::function<void(const std::string& path)> load;
};

External externalOf(const mrpt::obs::CObservation& observation)
{
  if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation))
  {
    if (!cloud->isExternallyStored()) return {};
    return {cloud->getExternalStorageFile(), "a point cloud", [cloud](const std::string&) {
              cloud->load();
            }};
  }
  // Loading completes an observation, which MRPT regards as no change of it.
  auto* scan = const_cast<RotatingScan*>(dynamic_cast<const RotatingScan*>(&observation));
  if (scan == nullptr) return {};
  return {externalFileOf(*scan), "a rotating scan", [scan](const std::string& path) {
            loadRotatingScan(*scan, path);
          }};
}
}  // namespace

std::optional<std::string> loadExternal(
    const mrpt::obs::CObservation& observation, const std::string& rawlog)
{
  const External external = externalOf(observation);
  if (external.file.empty()) return std::nullopt;
  // MRPT keeps one base folder per process; files of several rawlogs may lie in several folders.
  mrpt::io::setLazyLoadPathBase(externalFolderOf(rawlog));
  const std::string file = mrpt::io::lazy_load_absolute_path(external.file);
  const std::string prefix = rawlog + ": " + external.what + " of sensor '" +
                             observation.sensorLabel + "' lies in the file " + file;
  std::error_code error;
  if (!fs::exists(file, error))
    return prefix + ", which does not exist. Copy the folder of external files along.";
  try
  {
    external.load(file);
    return std::nullopt;
  }
  catch (const std::exception& e)
  {
    return prefix + ", which cannot be read: " + innermostMessage(e.what()) + ".";
  }
}

}  // namespace fastlio
