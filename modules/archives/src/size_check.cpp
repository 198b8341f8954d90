// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "object_layouts.h"
#include <fastlio/archives/rotating_scan_stream.h>
#include <fastlio/archives/size_check.h>

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CAction.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/rtti/CObject.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{
using namespace fastlio::object_layouts;
using fastlio::kEndFlag;
using fastlio::ObjectStream;
using fastlio::SizeVerdict;

constexpr std::size_t kCountBytes = 4;
constexpr std::size_t kMostParts = 100'000;  // observations of a frame, lists of a scan
constexpr int kDeepest = 8;                  // frames hold observations hold clouds hold parameters

// Goes through an object field by field. Every step returns false when there is no going on, for
// the reason in verdict().
class Walk
{
 public:
  explicit Walk(ObjectStream& stream) : stream_(stream) {}

  [[nodiscard]] SizeVerdict verdict() const { return verdict_; }

  /** \param base class that MRPT expects there; null: it checks that itself before it reads */
  bool object(int depth, const mrpt::rtti::TRuntimeClassId* base = nullptr)
  {
    // MRPT reads objects in objects by recursion, as deep as the file says.
    if (depth > kDeepest) return stop(SizeVerdict::Misaligned);
    const auto header = stream_.headerAtOffset(at_);
    if (!header)
      return stop(stream_.endsInsideHeader(at_) ? SizeVerdict::RunsOut : SizeVerdict::Misaligned);
    if (!skip(header->length)) return false;
    if (header->class_name == "nullptr") return endFlag();
    // MRPT finds a class also when its namespace is another one.
    const auto* id = mrpt::rtti::findRegisteredClass(header->class_name);
    if (id == nullptr) return stop(SizeVerdict::Plausible);  // MRPT goes no further either
    if (base != nullptr && !id->derivedFrom(base)) return stop(SizeVerdict::Misaligned);
    if (!skip(1)) return false;
    const Layout* layout = layoutOf(id->className, stream_.byteAt(at_ - 1));
    if (layout == nullptr && hasOneVersion(id->className)) return stop(SizeVerdict::Misaligned);
    if (layout == nullptr) return stop(SizeVerdict::Plausible);
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
    return skip(stream_.numberAt<std::uint32_t>(at_ - kCountBytes) * size);
  }

  template <typename Step>
  bool repeated(Step step)
  {
    if (!skip(kCountBytes)) return false;
    const std::size_t count = stream_.numberAt<std::uint32_t>(at_ - kCountBytes);
    if (count > kMostParts) return stop(SizeVerdict::Misaligned);
    for (std::size_t i = 0; i < count; ++i)
      if (!step()) return false;
    return true;
  }

  bool storedCloud(int depth)
  {
    if (!skip(1)) return false;
    return stream_.byteAt(at_ - 1) == 0 ? object(depth + 1, CLASS_ID(mrpt::maps::CPointsMap))
                                        : countedBytes(kString.size);
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

  // Inside of other objects only the layout of the installed MRPT is read.
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
    return stream_.numberAt<std::uint16_t>(at);
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
        return repeated([&] { return object(depth + 1, CLASS_ID(mrpt::obs::CObservation)); });
      case Field::CountedActions:
        return repeated([&] { return object(depth + 1, CLASS_ID(mrpt::obs::CAction)); });
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
