// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "external_storage.h"

#include <fastlio/archives/archived_object.h>
#include <fastlio/archives/inflating_file.h>
#include <fastlio/archives/rotating_scan_stream.h>
#include <fastlio/compat/mrpt_messages.h>
#include <fastlio/files/input_file.h>
#include <fastlio/options/printable.h>

#include <mrpt/io/lazy_load_path.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/math/CMatrixDynamic.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <vector>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;
using mrpt::obs::CObservationPointCloud;

// The names that MRPT gives the folder of a rawlog NAME.rawlog. (CRawlog::detectImagesDirectory()
// of 2.5.8 loses the slash between folder and name.)
fs::path externalFolderOf(const std::string& rawlog)
{
  const fs::path folder = fs::path(rawlog).parent_path();
  const std::string name = fs::path(rawlog).stem().string();
  for (const std::string& candidate : {name + "_Images", name + "_images", std::string("Images")})
  {
    std::error_code error;
    if (fs::is_directory(folder / candidate, error)) return folder / candidate;
  }
  return folder / (name + "_Images");
}

/** Whether \a path, made canonical, lies in \a folder or below. */
bool liesBelow(const fs::path& path, const fs::path& folder)
{
  const auto end = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end.first == folder.end() && end.second != path.end();
}

/** Where a file that a recording names lies.
 * \exception std::runtime_error the recording has no business there, or nothing can be read there */
fs::path externalPath(const fs::path& folder, const std::string& name)
{
  constexpr std::size_t kLongestName = 1000;  // [bytes]; folders and file below the recording's own
  if (name.size() > kLongestName || name.find('\0') != std::string::npos)
    throw std::runtime_error("which is no name of a file");
  std::error_code error;
  const fs::path root = fs::weakly_canonical(fs::absolute(folder), error);
  fs::path path = error ? fs::path() : fs::weakly_canonical(root / name, error);
  if (error) throw std::runtime_error("which cannot be found: " + error.message());
  if (!liesBelow(path, root))
    throw std::runtime_error(
        "which is outside of the recording's folder " + folder.string() +
        "; files from elsewhere are not read. Copy it there.");
  if (const auto problem = inputFileProblem(path.string()))
    throw std::runtime_error("which " + *problem + ". Copy the folder of external files along.");
  return path;
}

/** MRPT reads such a file as a whole, however much it inflates to. */
void requireBoundedSize(const std::string& path)
{
  InflatingFile file(path);
  std::vector<char> buffer(std::size_t{1} << 16U);
  std::size_t size = 0;
  for (std::size_t got = buffer.size(); got == buffer.size() && size <= kLargestRecord; size += got)
    got = file.read(buffer.data(), buffer.size());
  if (size > kLargestRecord)
    throw std::runtime_error("is larger than " + std::to_string(kLargestRecord >> 20U) + " MiB");
}

/** Data kept in a file, and the function that loads them. */
struct External
{
  std::string file;  // empty: nothing
  const char* what = "";
  std::function<void(const std::string& path)> load;
};

mrpt::maps::CPointsMap::Ptr archivedPoints(const std::string& path)
{
  const auto object = readArchivedObject(path);
  auto points = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(object);
  if (!points) throw std::runtime_error("holds no points");
  return points;
}

/** The rows "x y z", "x y z intensity" or "x y z r g b" of a text. MRPT's own reader takes rows
 * of two numbers for places, and reads beyond their end. */
mrpt::maps::CPointsMap::Ptr textPoints(const std::string& path)
{
  mrpt::math::CMatrixFloat rows;
  rows.loadFromTextFile(path);
  const auto columns = rows.cols();
  if (columns != 3 && columns != 4 && columns != 6)
    throw std::runtime_error(
        "holds rows of " + std::to_string(columns) +
        " numbers; a row is x y z, x y z intensity, or x y z r g b");
  mrpt::maps::CPointsMap::Ptr points = mrpt::maps::CSimplePointsMap::Create();
  if (columns == 4) points = mrpt::maps::CPointsMapXYZI::Create();
  points->resize(static_cast<std::size_t>(rows.rows()));
  std::vector<float> fields(columns == 4 ? 4 : 3);
  for (std::size_t row = 0; row < points->size(); ++row)
  {
    for (std::size_t field = 0; field < fields.size(); ++field)
      fields[field] = rows(row, field);
    points->setPointAllFieldsFast(row, fields);
  }
  return points;
}

/** MRPT says whether a cloud is in a file, and not in which format. */
struct FormatOf : CObservationPointCloud
{
  static ExternalStorageFormat of(const CObservationPointCloud& cloud)
  {
    return cloud.*(&FormatOf::m_externally_stored);
  }
};

// Loading completes an observation, which MRPT regards as no change of it.
void loadCloud(const CObservationPointCloud& cloud, const std::string& path)
{
  // MRPT would take the memory that an archive claims.
  if (FormatOf::of(cloud) == CObservationPointCloud::ExternalStorageFormat::MRPT_Serialization)
  {
    const_cast<CObservationPointCloud&>(cloud).pointcloud = archivedPoints(path);
    return;
  }
  requireBoundedSize(path);
  if (FormatOf::of(cloud) == CObservationPointCloud::ExternalStorageFormat::PlainTextFile)
    const_cast<CObservationPointCloud&>(cloud).pointcloud = textPoints(path);
  else
    cloud.load();
}

External externalOf(const mrpt::obs::CObservation& observation)
{
  if (const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation))
  {
    if (!cloud->isExternallyStored()) return {};
    return {cloud->getExternalStorageFile(), "a point cloud", [cloud](const std::string& path) {
              loadCloud(*cloud, path);
            }};
  }
  auto* scan = const_cast<RotatingScan*>(dynamic_cast<const RotatingScan*>(&observation));
  if (scan == nullptr) return {};
  return {
      externalFileOf(*scan), "a rotating scan",
      [scan](const std::string& path)
      {
        requireBoundedSize(path);
        loadRotatingScan(*scan, path);
      }};
}
}  // namespace

std::optional<std::string> loadExternal(
    const mrpt::obs::CObservation& observation, const std::string& rawlog)
{
  const External external = externalOf(observation);
  if (external.file.empty()) return std::nullopt;
  const fs::path folder = externalFolderOf(rawlog);
  const std::string prefix = rawlog + ": " + external.what + " of sensor '" +
                             printable(observation.sensorLabel) + "' lies in the file '" +
                             printable(external.file) + "', ";
  std::string path;
  try
  {
    path = externalPath(folder, external.file).string();
  }
  catch (const std::exception& e)
  {
    return prefix + e.what();
  }
  try
  {
    // MRPT keeps one base folder per process; files of several rawlogs may lie in several folders.
    mrpt::io::setLazyLoadPathBase(folder.string());
    external.load(path);
    return std::nullopt;
  }
  catch (const std::exception& e)
  {
    return prefix + "which cannot be read: " + printable(innermostMessage(e.what())) + ".";
  }
}

}  // namespace fastlio
