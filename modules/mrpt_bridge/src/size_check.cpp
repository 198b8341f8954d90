// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "size_check.h"

#include "rotating_scan_stream.h"

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace
{
using fastlio::ObjectStream;
using fastlio::SizeVerdict;

constexpr unsigned char kEndFlag = 0x88;
constexpr std::size_t kCountBytes = 4;
constexpr int kDeepest = 8;  // frames hold observations hold clouds hold parameters

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
    CountedObjects,  // 32-bit count, so many objects
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

Field fixed(std::size_t size)
{
  return {Field::Fixed, size};
}
Field counted(std::size_t size)
{
  return {Field::Counted, size};
}
Field named(std::size_t size)
{
  return {Field::NamedLists, size};
}
const Field kString = counted(1);
const Field kPose{Field::Object};
const Field kRest{Field::Unknown};

std::vector<Field> imuFields()
{
  constexpr std::size_t kChannels = mrpt::obs::COUNT_IMU_DATA_FIELDS;
  return {kPose, fixed(kChannels), fixed(kStamp), fixed(kChannels * kDouble), kString};
}

std::vector<Field> velodyneFields()
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
Layout genericCloud(unsigned char version)
{
  std::vector<Field> fields{counted(kPoint), named(4)};
  if (version >= 1) fields.push_back(named(8));
  fields.push_back(named(2));
  if (version >= 2) fields.push_back(named(1));
  if (version >= 4) fields.push_back(named(4));
  fields.push_back(kRest);
  return {version, fields};
}

std::vector<Field> rotatingScanFields()
{
  return {fixed(kStamp),      kString, {Field::ImageSize}, fixed(4 * kDouble),     kString,
          fixed(2 * kDouble), kPose,   fixed(kStamp + 1),  {Field::RotatingImages}};
}

std::multimap<std::string, Layout> makeLayouts()
{
  const std::vector<Field> points_and_more{counted(kPoint), kRest};
  std::multimap<std::string, Layout> layouts{
      {"mrpt::poses::CPose3D", {3, {fixed(12 * kDouble)}}},
      {"mrpt::obs::CSensoryFrame", {2, {{Field::CountedObjects}}}},
      {"mrpt::obs::CObservationIMU", {4, imuFields()}},
      {"mrpt::obs::CObservationVelodyneScan", {2, velodyneFields()}},
      {fastlio::kRotatingScanClass, {0, rotatingScanFields()}},
      {"mrpt::obs::CObservationPointCloud",
       {0, {kString, fixed(kStamp), kPose, {Field::StoredCloud}}}},
      {"mrpt::maps::CPointsMapXYZIRT",
       {0, {counted(kPoint), counted(4), counted(2), counted(4), kRest}}},
      {"mrpt::maps::CPointsMapXYZI", {0, {counted(kPoint + 4), kRest}}},
      {"mrpt::maps::CSimplePointsMap", {10, points_and_more}},
      {"mrpt::maps::CColouredPointsMap", {9, points_and_more}},
      {"mrpt::maps::CWeightedPointsMap", {2, points_and_more}}};
  for (unsigned char version = 0; version <= 4; ++version)
    layouts.emplace("mrpt::maps::CGenericPointsMap", genericCloud(version));
  return layouts;
}

const Layout* layoutOf(const std::string& class_name, unsigned char version)
{
  static const std::multimap<std::string, Layout> layouts = makeLayouts();
  const auto [begin, end] = layouts.equal_range(class_name);
  const auto found = std::find_if(
      begin, end, [version](const auto& entry) { return entry.second.version == version; });
  return found == end ? nullptr : &found->second;
}

// Goes through an object field by field. Every step returns false when there is no going on, for
// the reason in verdict().
class Walk
{
 public:
  explicit Walk(ObjectStream& stream) : stream_(stream) {}

  [[nodiscard]] SizeVerdict verdict() const { return verdict_; }

  bool object(int depth)
  {
    const auto header = stream_.headerAtOffset(at_);
    if (!header)
      return stop(stream_.endsInsideHeader(at_) ? SizeVerdict::RunsOut : SizeVerdict::Misaligned);
    if (!skip(header->length)) return false;
    if (header->class_name == "nullptr") return endFlag();
    if (!skip(1)) return false;
    const Layout* layout = layoutOf(header->class_name, stream_.byteAt(at_ - 1));
    if (layout == nullptr || depth > kDeepest) return stop(SizeVerdict::Plausible);
    for (const Field& field : layout->fields)
      if (!walk(field, depth)) return false;
    return endFlag();
  }

 private:
  bool stop(SizeVerdict verdict)
  {
    verdict_ = verdict;
    return false;
  }

  bool skip(std::size_t size)
  {
    if (!stream_.holds(at_, size)) return stop(SizeVerdict::RunsOut);
    at_ += size;
    return true;
  }

  bool endFlag()
  {
    if (!skip(1)) return false;
    return stream_.byteAt(at_ - 1) == kEndFlag || stop(SizeVerdict::Misaligned);
  }

  bool countedBytes(std::size_t size)
  {
    if (!skip(kCountBytes)) return false;
    return skip(stream_.wordAt(at_ - kCountBytes) * size);
  }

  template <typename Step>
  bool repeated(Step step)
  {
    if (!skip(kCountBytes)) return false;
    const std::size_t count = stream_.wordAt(at_ - kCountBytes);
    for (std::size_t i = 0; i < count; ++i)
      if (!step()) return false;
    return true;
  }

  bool storedCloud(int depth)
  {
    if (!skip(1)) return false;
    return stream_.byteAt(at_ - 1) == 0 ? object(depth + 1) : countedBytes(kString.size);
  }

  bool imageSize()
  {
    if (!skip(4)) return false;
    rows_ = shortAt(at_ - 4);
    columns_ = shortAt(at_ - 2);
    return true;
  }

  // An image: 16-bit columns and rows, so many values.
  bool image(std::size_t value_size)
  {
    if (!skip(4)) return false;
    pixels_ = std::size_t{shortAt(at_ - 4)} * shortAt(at_ - 2);
    return skip(pixels_ * value_size);
  }

  bool images()
  {
    if (!image(2)) return false;
    const std::size_t range_pixels = pixels_;
    if (!image(1) || !skip(2)) return false;
    for (int layers = shortAt(at_ - 2); layers > 0; --layers)
      if (!countedBytes(kString.size) || !skip(2 * range_pixels)) return false;
    return true;
  }

  // Inside of a frame MRPT itself reads them, and only its own layout.
  bool rotatingImages(int depth)
  {
    if (!stream_.holds(at_, 4)) return stop(SizeVerdict::RunsOut);
    const auto layout = fastlio::layoutOf(
        {stream_.byteAt(at_), stream_.byteAt(at_ + 1), stream_.byteAt(at_ + 2),
         stream_.byteAt(at_ + 3)},
        rows_, columns_);
    if (depth > 0 && layout != fastlio::kNativeRotatingScan) return stop(SizeVerdict::Misaligned);
    if (layout == fastlio::RotatingScanLayout::Images) return images();
    if (layout == fastlio::RotatingScanLayout::Neither) return stop(SizeVerdict::Misaligned);
    if (!skip(1)) return false;
    if (stream_.byteAt(at_ - 1) != 0) return countedBytes(kString.size);
    constexpr std::size_t kPointBytes = 12;
    return images() && image(kPointBytes);
  }

  [[nodiscard]] std::uint16_t shortAt(std::size_t at) const
  {
    return static_cast<std::uint16_t>(stream_.byteAt(at) | (stream_.byteAt(at + 1) << 8U));
  }

  bool walk(const Field& field, int depth)
  {
    switch (field.kind)
    {
      case Field::Fixed:
        return skip(field.size);
      case Field::Counted:
        return countedBytes(field.size);
      case Field::CountedLists:
        return repeated([&] { return countedBytes(field.size); });
      case Field::NamedLists:
        return repeated([&] { return countedBytes(kString.size) && countedBytes(field.size); });
      case Field::Object:
        return object(depth + 1);
      case Field::CountedObjects:
        return repeated([&] { return object(depth + 1); });
      case Field::ImageSize:
        return imageSize();
      case Field::RotatingImages:
        return rotatingImages(depth);
      case Field::StoredCloud:
        return storedCloud(depth);
      case Field::Unknown:
        break;
    }
    return stop(SizeVerdict::Plausible);
  }

  ObjectStream& stream_;
  std::size_t at_ = 0;                    // from the start of the object at hand
  std::uint16_t rows_ = 0, columns_ = 0;  // of the rotating scan at hand
  std::size_t pixels_ = 0;                // of its last image
  SizeVerdict verdict_ = SizeVerdict::Plausible;
};
}  // namespace

namespace fastlio
{
SizeVerdict checkSizes(ObjectStream& stream)
{
  Walk walk(stream);
  walk.object(0);
  return walk.verdict();
}

}  // namespace fastlio
