// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bag_fields.h The head of a record of a ROS 1 bag: fields "name=value". */
#pragma once

#include <fastlio/recordings/byte_source.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** Of records of a ROS 1 bag, version 2.0. */
enum class BagOp : std::uint8_t
{
  Message = 0x02,
  BagHeader = 0x03,
  Index = 0x04,
  Chunk = 0x05,
  ChunkInfo = 0x06,
  Connection = 0x07
};

/** Points into the bytes that it was made of. */
class BagFields
{
 public:
  /** Nothing: the bytes are not fields. */
  [[nodiscard]] static std::optional<BagFields> parse(const std::uint8_t* data, std::size_t size);

  [[nodiscard]] std::optional<std::string_view> text(std::string_view name) const;
  [[nodiscard]] std::optional<std::uint32_t> number(std::string_view name) const;
  [[nodiscard]] std::optional<BagOp> op() const;

 private:
  struct Field
  {
    std::string_view name, value;
  };
  std::vector<Field> fields_;
};

}  // namespace fastlio
