// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/archives/object_stream.h>

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/poses/CPosePDFSOG.h>
#include <mrpt/rtti/CObject.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace
{
constexpr std::size_t kChunk = 1U << 15U;
constexpr std::size_t kLongestClassName = 120;  // limit of MRPT's format
constexpr unsigned char kHeaderFlag = 0x80;
// MRPT reads objects in objects by recursion: this is a hundred of them, and whole files have five.
// A small part of any thread's stack.
constexpr std::uintptr_t kMostStack = 128U << 10U;
const std::string kObservations = "mrpt::obs::";
constexpr std::string_view kMovement = "CActionRobotMovement2D";  // MRPT needs no namespace

bool isClassNameCharacter(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr(":_<>, ", c) != nullptr;
}
}  // namespace

namespace fastlio
{
// Makes bytes_ reach to end; it grows by what the file really holds only.
bool ObjectStream::fill(std::size_t end)
{
  while (bytes_.size() < end)
  {
    if (file_.end() != FileEnd::NotYet) return false;
    const std::size_t old_size = bytes_.size();
    bytes_.resize(old_size + kChunk);
    bytes_.resize(old_size + file_.read(bytes_.data() + old_size, kChunk));
    if (bytes_.size() == old_size) return false;
  }
  return true;
}

bool ObjectStream::require(std::size_t size)
{
  if (position_ - object_ + size > largest_object_)
    throw std::runtime_error(
        "it is larger than " + std::to_string(largest_object_ >> 20U) + " MiB");
  return fill(position_ + size);
}

bool ObjectStream::holds(std::size_t offset, std::size_t size)
{
  return size <= largest_object_ && offset <= largest_object_ - size &&
         fill(object_ + offset + size);
}

unsigned char ObjectStream::byteAt(std::size_t offset) const
{
  return static_cast<unsigned char>(bytes_[object_ + offset]);
}

std::optional<ObjectHeader> ObjectStream::headerAtOffset(std::size_t offset)
{
  if (!holds(offset, 1)) return {};
  fill(object_ + offset + 1 + kLongestClassName);
  return headerAt(object_ + offset);
}

void ObjectStream::requireRoomOnStack()
{
  const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  if (stack_ == 0) stack_ = here;
  too_deep_ = too_deep_ || stack_ > here + kMostStack;
  if (too_deep_) throw std::runtime_error("the objects in it are nested too deeply");
}

std::size_t ObjectStream::Read(void* data, std::size_t size)
{
  requireRoomOnStack();
  if (!require(size))
  {
    ran_out_ = true;
    position_ = bytes_.size();
    throw std::runtime_error("the file ends inside an object");
  }
  const char* read = bytes_.data() + position_;
  std::memcpy(data, read, size);
  position_ += size;
  if (size >= kMovement.size() && size <= kLongestClassName &&
      std::string_view(read, size).substr(size - kMovement.size()) == kMovement)
    requirePoseOfMovement(size);
  return size;
}

// MRPT takes any object for the pose of a movement and follows the null pointer that its cast then
// gives. The name of the class has just been read: what lies behind is looked at before MRPT does.
void ObjectStream::requirePoseOfMovement(std::size_t name_size)
{
  constexpr unsigned char kFirstWithMethod = 2;  // in front of the pose
  const auto fail = [] { throw std::runtime_error("a movement in it has no pose"); };
  const std::size_t name = position_ - name_size, at = position_ - object_;
  // Headers without the flag are those of MRPT before 0.5.5.
  if (name == 0 || (static_cast<unsigned char>(bytes_[name - 1]) & kHeaderFlag) == 0) fail();
  if (!holds(at, 5)) return;  // the next reads meet the end
  const bool has_method = byteAt(at) >= kFirstWithMethod;
  const std::size_t pose = at + (has_method ? 5 : 1);
  const auto header = headerAtOffset(pose);
  if (has_method &&
      numberAt<std::uint32_t>(at + 1) == mrpt::obs::CActionRobotMovement2D::emOdometry)
  {
    if (header) requireFewParticles(pose + header->length, byteAt(at));
    return;
  }
  if (!header && endsInsideHeader(pose)) return;
  if (!header || header->class_name == "nullptr") fail();
  const auto* id = mrpt::rtti::findRegisteredClass(header->class_name);
  if (id != nullptr && !id->derivedFrom(CLASS_ID(mrpt::poses::CPosePDF))) fail();
  if (id == CLASS_ID(mrpt::poses::CPosePDFParticles) || id == CLASS_ID(mrpt::poses::CPosePDFSOG))
    requireFewParticles(pose + header->length, {});
}

// MRPT takes the memory for as many as are claimed, and draws them for a movement of odometry.
void ObjectStream::requireFewParticles(
    std::size_t pose_version, std::optional<unsigned char> odometry_version)
{
  constexpr std::size_t kMostParticles = 1'000'000;  // 300 are usual
  constexpr unsigned char kFirstWithCount = 3;
  if (!holds(pose_version, 1)) return;
  std::size_t count = pose_version + 1;
  if (odometry_version)
  {
    if (*odometry_version < kFirstWithCount) return;
    // Three coordinates, the end flag, the model, and its options for the other model.
    count += byteAt(pose_version) == 0 ? 3 * sizeof(float) : 3 * sizeof(double);
    count += 1 + 4 + (*odometry_version == kFirstWithCount ? 5 : 6) * sizeof(float);
  }
  if (holds(count, 4) && numberAt<std::uint32_t>(count) > kMostParticles)
    throw std::runtime_error(
        "a movement in it claims " + std::to_string(numberAt<std::uint32_t>(count)) + " particles");
}

std::size_t ObjectStream::Write(const void* /*data*/, std::size_t /*size*/)
{
  throw std::logic_error("ObjectStream is for reading only");
}

void ObjectStream::beginObject()
{
  object_ = position_;
  stack_ = 0;
  too_deep_ = ran_out_ = false;
  if (object_ < std::max(kChunk, bytes_.size() / 2))
    return;  // moving the rest costs in proportion to it
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(object_));
  origin_ += object_;
  position_ = object_ = 0;
}

void ObjectStream::rewindTo(std::size_t offset)
{
  position_ = std::min(object_ + offset, bytes_.size());
  ran_out_ = false;
}

bool ObjectStream::atEnd()
{
  return !require(1);
}

std::optional<ObjectHeader> ObjectStream::headerAt(std::size_t at) const
{
  const auto flagged = static_cast<unsigned char>(bytes_[at]);
  const std::size_t length = flagged & ~kHeaderFlag & 0xFFU;
  if ((flagged & kHeaderFlag) == 0 || length == 0 || length > kLongestClassName) return {};
  if (bytes_.size() - at < 1 + length) return {};
  const char* name = bytes_.data() + at + 1;
  if (!std::all_of(name, name + length, isClassNameCharacter)) return {};
  return ObjectHeader{std::string(name, length), 1 + length};
}

std::optional<ObjectHeader> ObjectStream::peekHeader()
{
  require(1 + kLongestClassName);
  if (available() == 0) return {};
  return headerAt(position_);
}

bool ObjectStream::endsInsideHeader(std::size_t offset)
{
  if (holds(offset, 1 + kLongestClassName)) return false;
  if (!holds(offset, 1)) return true;
  const std::size_t length = byteAt(offset) & ~kHeaderFlag & 0xFFU;
  const auto name = bytes_.begin() + static_cast<std::ptrdiff_t>(object_ + offset) + 1;
  const auto held = static_cast<std::size_t>(bytes_.end() - name);
  return (byteAt(offset) & kHeaderFlag) != 0 && length <= kLongestClassName && held < length &&
         std::all_of(name, bytes_.end(), isClassNameCharacter);
}

std::optional<ObjectHeader> ObjectStream::lastHeaderRead() const
{
  for (std::size_t length = 1; length <= kLongestClassName; ++length)
  {
    if (position_ - object_ < length + 2) return {};
    const std::size_t at = position_ - length - 2;
    auto header = headerAt(at);
    if (header && header->length == length + 1) return header;
  }
  return {};
}

bool ObjectStream::seekNextObservation()
{
  skipped_zeros_only_ = true;
  for (; seekHeaderFlag(); ++position_)
  {
    require(1 + kLongestClassName);
    const auto header = headerAt(position_);
    if (header && header->class_name.compare(0, kObservations.size(), kObservations) == 0 &&
        mrpt::rtti::findRegisteredClass(header->class_name) != nullptr)
      return true;
  }
  return false;
}

// To the next byte that may begin a header. What is skipped is forgotten: a damaged file may have
// gigabytes of it.
bool ObjectStream::seekHeaderFlag()
{
  for (; require(1); beginObject())
  {
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(position_);
    const auto found = std::find_if(
        begin, bytes_.end(),
        [](char c) { return (static_cast<unsigned char>(c) & kHeaderFlag) != 0; });
    skipped_zeros_only_ = skipped_zeros_only_ && found == bytes_.end() &&
                          std::all_of(begin, found, [](char c) { return c == 0; });
    position_ += static_cast<std::size_t>(found - begin);
    if (found != bytes_.end())
    {
      if (position_ - object_ > kChunk) beginObject();
      return true;
    }
  }
  return false;
}

}  // namespace fastlio
