// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file object_reader.h The objects of one rawlog file, and why there are no more. */
#pragma once

#include <fastlio/archives/object_stream.h>
#include <fastlio/recordings/recording_reader.h>

#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>

namespace fastlio
{
/** An object (never null), a problem, after which reading may go on, or the end. */
using NextObject =
    std::variant<mrpt::serialization::CSerializable::Ptr, ReadProblem, EndOfRecording>;

class ObjectReader
{
 public:
  explicit ObjectReader(std::string path);

  /** Never throws for what the file holds. Behind an object that cannot be decoded it goes on at
   * the next one that can be found. Once EndOfRecording was returned it is returned again. */
  [[nodiscard]] NextObject next();

  /** Bytes of the file as it lies on disk that have been used. */
  [[nodiscard]] std::uint64_t compressedPosition() const;

 private:
  [[nodiscard]] NextObject readOne();
  [[nodiscard]] mrpt::serialization::CSerializable::Ptr readObject(const ObjectHeader& header);
  [[nodiscard]] mrpt::serialization::CSerializable::Ptr readFrame(
      mrpt::serialization::CArchive& archive);
  [[nodiscard]] mrpt::serialization::CSerializable::Ptr readCollection(
      mrpt::serialization::CArchive& archive);
  /** Hands over the objects in a frame or a collection.
   * \exception std::runtime_error one of them is not of a class that derives from \a base */
  template <typename Take>
  void readParts(
      mrpt::serialization::CArchive& archive, const mrpt::rtti::TRuntimeClassId* base,
      const Take& take);
  [[nodiscard]] NextObject atEndOfFile();
  [[nodiscard]] NextObject fail(ReadProblem problem);
  [[nodiscard]] ReadProblem diagnose(const std::string& class_name, const std::string& error) const;
  [[nodiscard]] ReadProblem diagnoseEnd(const std::string& class_name) const;
  [[nodiscard]] ReadProblem makeProblem(
      ReadProblemKind kind, const std::string& class_name, const std::string& what) const;
  void skipFrameEnds();

  std::string path_;
  std::unique_ptr<ObjectStream> stream_;
  std::size_t index_ = 0;            // of the object at hand
  std::uint64_t object_offset_ = 0;  // of the object at hand, uncompressed
  bool recovered_ = false;           // what follows may be the rest of a broken frame
  bool finished_ = false;
};

}  // namespace fastlio
