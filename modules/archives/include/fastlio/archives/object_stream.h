// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file object_stream.h The bytes of a rawlog for MRPT's archives, with the way back to the start
 * of the object at hand. */
#pragma once

#include <fastlio/archives/inflating_file.h>
#include <fastlio/math/little_endian.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** The start of a serialised object: 0x80 | length, class name. */
struct ObjectHeader
{
  std::string class_name;
  std::size_t length = 0;  //!< of the header [bytes]
};

/** The last byte of a serialised object. */
inline constexpr std::uint8_t kEndFlag = 0x88;

/** Has what mrpt::serialization::archiveFrom() asks of a stream. All positions are in uncompressed
 * bytes from the start of the file. */
class ObjectStream
{
 public:
  explicit ObjectStream(const std::string& path, std::size_t largest_object = kLargestRecord)
      : file_(path), largest_object_(largest_object)
  {
  }

  /** Exactly \a size bytes.
   * \exception std::runtime_error the file has fewer left, the object is larger than the limit,
   * the caller has come too far down the stack since the first call for this object, or an action
   * of MRPT that begins there would end the program */
  std::size_t Read(void* data, std::size_t size);

  /** \exception std::logic_error always: this stream is for reading */
  std::size_t Write(const void* data, std::size_t size);

  [[nodiscard]] std::string getStreamDescription() const { return "rawlog"; }

  /** The object at hand starts here; what lies before is forgotten. */
  void beginObject();

  /** Back to \a offset bytes behind the start of the object at hand. */
  void rewindTo(std::size_t offset);

  /** Looks for the next header of a known class in namespace mrpt::obs, from the current position
   * on, and goes there. False: there is none. */
  bool seekNextObservation();

  /** The last seekNextObservation() has skipped zeros and nothing else: what a loss of power leaves
   * behind. */
  [[nodiscard]] bool skippedZerosOnly() const { return skipped_zeros_only_; }

  /** The header at the current position, if there is one. */
  [[nodiscard]] std::optional<ObjectHeader> peekHeader();

  /** \name Looking into the object at hand, by offset to its start, without moving.
   * @{ */
  [[nodiscard]] bool holds(std::size_t offset, std::size_t size);
  [[nodiscard]] unsigned char byteAt(std::size_t offset) const;
  template <typename Number>
  [[nodiscard]] Number numberAt(std::size_t offset) const
  {
    return littleAt<Number>(bytes_.data() + object_ + offset);
  }
  [[nodiscard]] std::optional<ObjectHeader> headerAtOffset(std::size_t offset);
  /** The file ends there or inside of what may be a header there. */
  [[nodiscard]] bool endsInsideHeader(std::size_t offset);
  /** @} */

  /** The header that ends at the current position but for its version byte: what reading stopped
   * at. */
  [[nodiscard]] std::optional<ObjectHeader> lastHeaderRead() const;

  [[nodiscard]] bool atEnd();
  [[nodiscard]] std::uint64_t position() const { return origin_ + position_; }
  [[nodiscard]] bool ranOut() const { return ran_out_; }

  /** Objects in the object at hand are nested so deeply that Read() has refused to go on. */
  [[nodiscard]] bool isTooDeep() const { return too_deep_; }
  [[nodiscard]] const InflatingFile& file() const { return file_; }

 private:
  [[nodiscard]] std::size_t available() const { return bytes_.size() - position_; }
  void requireRoomOnStack();
  void requirePoseOfMovement(std::size_t name_size);
  void requireFewParticles(std::size_t pose_version, std::optional<unsigned char> odometry_version);
  bool require(std::size_t size);
  bool fill(std::size_t end);
  bool seekHeaderFlag();
  [[nodiscard]] std::optional<ObjectHeader> headerAt(std::size_t at) const;

  InflatingFile file_;
  std::size_t largest_object_;
  std::vector<char> bytes_;   // from the start of the object at hand, or a little before
  std::size_t object_ = 0;    // start of the object at hand, in bytes_
  std::size_t position_ = 0;  // in bytes_
  std::uint64_t origin_ = 0;  // of bytes_ in the file
  std::uintptr_t stack_ = 0;  // where the object's first read was called; 0: there was none
  bool too_deep_ = false;     // a read since beginObject() was refused for its depth
  bool ran_out_ = false;      // a read since beginObject() met the end
  bool skipped_zeros_only_ = false;
};

}  // namespace fastlio
