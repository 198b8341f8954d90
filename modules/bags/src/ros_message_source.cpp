// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "ros_message_source.h"

#include <cstring>
#include <stdexcept>

namespace fastlio
{
namespace
{
// Bags of ROS 2 may compress each message by itself; CDR never begins like that.
bool isCompressed(const RosMessage& message)
{
  return message.topic->format == WireFormat::Cdr && message.data->size() >= kZstdMagic.size() &&
         std::memcmp(message.data->data(), kZstdMagic.data(), kZstdMagic.size()) == 0;
}

Bytes inflated(const Bytes& packed)
{
  constexpr std::size_t kPiece = std::size_t{1} << 18U;
  const auto inflater = makeZstdInflater();
  Bytes bytes;
  for (std::size_t done = 0;;)
  {
    const std::size_t size = bytes.size();
    bytes.resize(size + kPiece);
    const auto step = inflater->step(
        packed.data() + done, static_cast<std::uint32_t>(packed.size() - done), bytes.data() + size,
        kPiece);
    done += step.consumed;
    bytes.resize(size + step.produced);
    if (step.status == InflateStatus::MemberEnd) return bytes;
    if (step.status == InflateStatus::Corrupt || (step.consumed == 0 && step.produced == 0))
      throw std::runtime_error("its compressed data are damaged");
    if (bytes.size() > kLargestRecord) throw std::runtime_error("it is larger than 256 MiB");
  }
}
}  // namespace

InflatedMessage::InflatedMessage(const RosMessage& message) : packed_(*message.data)
{
  if (isCompressed(message)) own_ = inflated(packed_);
}

}  // namespace fastlio
