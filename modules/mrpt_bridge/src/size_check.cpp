// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "size_check.h"

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

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
    Object,          // another object
    CountedObjects,  // 32-bit count, so many objects
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
const Field kString{Field::Counted, 1};

std::map<std::string, Layout> makeLayouts()
{
  using mrpt::obs::CObservationVelodyneScan;
  constexpr std::size_t kImuFields = mrpt::obs::COUNT_IMU_DATA_FIELDS;
  constexpr std::size_t kPacket = sizeof(CObservationVelodyneScan::TVelodyneRawPacket);
  constexpr std::size_t kLaser = sizeof(mrpt::obs::VelodyneCalibration::PerLaserCalib);
  const std::vector<Field> points_and_more{{Field::Counted, kPoint}, {Field::Unknown}};
  return {
      {"mrpt::poses::CPose3D", {3, {{Field::Fixed, 12 * kDouble}}}},
      {"mrpt::obs::CSensoryFrame", {2, {{Field::CountedObjects}}}},
      {"mrpt::obs::CObservationIMU",
       {4,
        {{Field::Object},
         {Field::Fixed, kImuFields},
         {Field::Fixed, kStamp},
         {Field::Fixed, kImuFields * kDouble},
         kString}}},
      // Packets, calibration, then the point cloud: x, y, z, intensity, [satellite time], stamps,
      // azimuths, laser numbers, indices by laser.
      {"mrpt::obs::CObservationVelodyneScan",
       {2,
        {{Field::Fixed, kStamp},
         kString,
         {Field::Fixed, 2 * kDouble},
         {Field::Object},
         {Field::Counted, kPacket},
         {Field::Counted, kLaser},
         {Field::Counted, 4},
         {Field::Counted, 4},
         {Field::Counted, 4},
         {Field::Counted, 1},
         {Field::Fixed, 1},
         {Field::Counted, kStamp},
         {Field::Counted, 4},
         {Field::Counted, 2},
         {Field::CountedLists, 8}}}},
      {"mrpt::obs::CObservationPointCloud",
       {0, {kString, {Field::Fixed, kStamp}, {Field::Object}, {Field::StoredCloud}}}},
      {"mrpt::maps::CPointsMapXYZIRT",
       {0,
        {{Field::Counted, kPoint},
         {Field::Counted, 4},
         {Field::Counted, 2},
         {Field::Counted, 4},
         {Field::Unknown}}}},
      {"mrpt::maps::CPointsMapXYZI", {0, {{Field::Counted, kPoint + 4}, {Field::Unknown}}}},
      {"mrpt::maps::CSimplePointsMap", {10, points_and_more}},
      {"mrpt::maps::CColouredPointsMap", {9, points_and_more}},
      {"mrpt::maps::CWeightedPointsMap", {2, points_and_more}}};
}

const Layout* layoutOf(const std::string& class_name, unsigned char version)
{
  static const std::map<std::string, Layout> layouts = makeLayouts();
  const auto found = layouts.find(class_name);
  if (found == layouts.end() || found->second.version != version) return nullptr;
  return &found->second;
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

  bool counted(std::size_t size)
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
    return stream_.byteAt(at_ - 1) == 0 ? object(depth + 1) : counted(kString.size);
  }

  bool walk(const Field& field, int depth)
  {
    switch (field.kind)
    {
      case Field::Fixed:
        return skip(field.size);
      case Field::Counted:
        return counted(field.size);
      case Field::CountedLists:
        return repeated([&] { return counted(field.size); });
      case Field::Object:
        return object(depth + 1);
      case Field::CountedObjects:
        return repeated([&] { return object(depth + 1); });
      case Field::StoredCloud:
        return storedCloud(depth);
      case Field::Unknown:
        break;
    }
    return stop(SizeVerdict::Plausible);
  }

  ObjectStream& stream_;
  std::size_t at_ = 0;  // from the start of the object at hand
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
