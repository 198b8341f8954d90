// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mcap_record.h Records of MCAP as bytes. */
#pragma once

#include <fastlio/math/little_endian.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace fastlio
{
enum McapOpcode : std::uint8_t
{
  kHeaderOp = 0x01,
  kFooterOp,
  kSchemaOp,
  kChannelOp,
  kMessageOp,
  kChunkOp,
  kMessageIndexOp,
  kChunkIndexOp,
  kStatisticsOp = 0x0B,
  kDataEndOp = 0x0F
};

/** The bytes of a record: little endian, packed. */
class McapRecord
{
 public:
  template <typename T>
  McapRecord& number(T value)
  {
    appendLittle(bytes_, value);
    return *this;
  }
  McapRecord& text(std::string_view text)
  {
    number(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
    return *this;
  }
  McapRecord& raw(std::string_view bytes)
  {
    bytes_ += bytes;
    return *this;
  }
  [[nodiscard]] std::string finish(std::uint8_t op) const
  {
    McapRecord head;
    head.number(op).number(std::uint64_t{bytes_.size()});
    return head.bytes_ + bytes_;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace fastlio
