// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file object_layouts.h Where the lengths stand in the objects of a rawlog (internal). */
#pragma once

#include <fastlio/archives/rotating_scan_stream.h>

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fastlio::object_layouts
{
// One piece of an object's layout.
struct Field
{
  enum Kind
  {
    Fixed,           // size bytes
    Counted,         // 32-bit count, count * size bytes
    CountedLists,    // 32-bit count, so many of Counted
    NamedLists,      // 32-bit count, so many of a string and Counted
    Object,          // another object
    CountedObjects,  // 32-bit count, so many observations
    CountedActions,  // 32-bit count, so many actions
    ImageSize,       // 16-bit rows and columns, which the images behind refer to
    RotatingImages,  // images of that size, in one of two layouts
    StoredCloud,     // 0 and an object, or another byte and the name of a file
    Unknown          // what follows depends on the version of MRPT
  };
  Kind kind;
  std::size_t size = 0;
};

struct Layout
{
  unsigned char version;
  std::vector<Field> fields;
};

constexpr std::size_t kStamp = 8, kDouble = 8, kPoint = 12;

inline Field fixed(std::size_t size)
{
  return {Field::Fixed, size};
}
inline Field counted(std::size_t size)
{
  return {Field::Counted, size};
}
inline Field named(std::size_t size)
{
  return {Field::NamedLists, size};
}
inline const Field kString = counted(1);
inline const Field kPose{Field::Object};
inline const Field kRest{Field::Unknown};

inline std::vector<Field> imuFields()
{
  constexpr std::size_t kChannels = mrpt::obs::COUNT_IMU_DATA_FIELDS;
  return {kPose, fixed(kChannels), fixed(kStamp), fixed(kChannels * kDouble), kString};
}

inline std::vector<Field> velodyneFields()
{
  using mrpt::obs::CObservationVelodyneScan;
  constexpr std::size_t kPacket = sizeof(CObservationVelodyneScan::TVelodyneRawPacket);
  constexpr std::size_t kLaser = sizeof(mrpt::obs::VelodyneCalibration::PerLaserCalib);
  std::vector<Field> fields{fixed(kStamp), kString,          fixed(2 * kDouble),
                            kPose,         counted(kPacket), counted(kLaser)};
  // Cached points: x, y, z, intensity; whether the stamp is a satellite's.
  fields.insert(fields.end(), {counted(4), counted(4), counted(4), counted(1), fixed(1)});
  // Their stamps (MRPT writes the names of these types before them), azimuths, lasers and indices.
  fields.insert(fields.end(), {kString, kString, counted(kStamp), counted(4), counted(2)});
  fields.insert(fields.end(), {kString, kString, {Field::CountedLists, 8}});
  return fields;
}

// A list of fields for each type of number, of which later versions have more.
inline Layout genericCloud(unsigned char version)
{
  std::vector<Field> fields{counted(kPoint), named(4)};
  if (version >= 1) fields.push_back(named(8));
  fields.push_back(named(2));
  if (version >= 2) fields.push_back(named(1));
  if (version >= 4) fields.push_back(named(4));
  fields.push_back(kRest);
  return {version, fields};
}

inline std::vector<Field> rotatingScanFields()
{
  return {fixed(kStamp),      kString, {Field::ImageSize}, fixed(4 * kDouble),     kString,
          fixed(2 * kDouble), kPose,   fixed(kStamp + 1),  {Field::RotatingImages}};
}

inline std::multimap<std::string, Layout> makeLayouts()
{
  const std::vector<Field> points_and_more{counted(kPoint), kRest};
  std::multimap<std::string, Layout> layouts{
      {"mrpt::poses::CPose3D", {3, {fixed(12 * kDouble)}}},
      {"mrpt::obs::CSensoryFrame", {2, {{Field::CountedObjects}}}},
      {"mrpt::obs::CActionCollection", {0, {{Field::CountedActions}}}},
      {"mrpt::obs::CObservationIMU", {4, imuFields()}},
      {"mrpt::obs::CObservationVelodyneScan", {2, velodyneFields()}},
      {fastlio::kRotatingScanClass, {0, rotatingScanFields()}},
      {"mrpt::obs::CObservationPointCloud",
       {0, {kString, fixed(kStamp), kPose, {Field::StoredCloud}}}},
      {"mrpt::maps::CPointsMapXYZIRT",
       {0, {counted(kPoint), counted(4), counted(2), counted(4), kRest}}},
      {"mrpt::maps::CPointsMapXYZI", {0, {counted(kPoint + 4), kRest}}}};
  // All versions so far begin alike.
  for (const auto& [name, newest] :
       {std::pair{"mrpt::maps::CSimplePointsMap", 10},
        {"mrpt::maps::CColouredPointsMap", 9},
        {"mrpt::maps::CWeightedPointsMap", 2}})
    for (int version = 0; version <= newest; ++version)
      layouts.emplace(name, Layout{static_cast<unsigned char>(version), points_and_more});
  for (unsigned char version = 0; version <= 4; ++version)
    layouts.emplace("mrpt::maps::CGenericPointsMap", genericCloud(version));
  return layouts;
}

inline const Layout* layoutOf(const std::string& class_name, unsigned char version)
{
  static const std::multimap<std::string, Layout> layouts = makeLayouts();
  const auto [begin, end] = layouts.equal_range(class_name);
  const auto found = std::find_if(
      begin, end, [version](const auto& entry) { return entry.second.version == version; });
  return found == end ? nullptr : &found->second;
}

// Classes of which every MRPT writes the same version: another one is damage.
inline bool hasOneVersion(const std::string& class_name)
{
  return class_name == "mrpt::obs::CSensoryFrame" ||
         class_name == "mrpt::obs::CObservationVelodyneScan" ||
         class_name == "mrpt::obs::CObservationPointCloud" ||
         class_name == "mrpt::maps::CPointsMapXYZIRT" || class_name == "mrpt::maps::CPointsMapXYZI";
}

}  // namespace fastlio::object_layouts
