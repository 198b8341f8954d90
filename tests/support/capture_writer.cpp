// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "capture_writer.h"

#include "wire_writer.h"

namespace fastlio::testing
{
namespace
{
std::string big16(std::size_t value)
{
  return {static_cast<char>((value >> 8U) & 0xFFU), static_cast<char>(value & 0xFFU)};
}

WireWriter little()
{
  return WireWriter(Wire::Ros1);
}

/** The frames of the Ethernet that a packet is sent in. */
std::vector<std::string> framesOf(
    const SentPacket& packet, std::size_t number, const CaptureStyle& style)
{
  const std::string udp = big16(50000) + big16(packet.port) + big16(8 + packet.payload.size()) +
                          big16(0) + packet.payload;
  const std::size_t most = style.most / 8 * 8;
  std::vector<std::string> frames;
  for (std::size_t at = 0; at < udp.size(); at += most)
  {
    const std::string data = udp.substr(at, most);
    const bool more = at + most < udp.size();
    const std::string address = std::string("\xC0\xA8\x01", 3) + static_cast<char>(packet.sender);
    const std::string ip = std::string("\x45\0", 2) + big16(20 + data.size()) + big16(number) +
                           big16(at / 8 + (more ? 0x2000U : 0U)) + std::string("\x40\x11\0\0", 4) +
                           address + std::string("\xFF\xFF\xFF\xFF", 4);
    frames.push_back(
        std::string(12, '\x02') + (style.vlan ? big16(0x8100) + big16(5) : "") + big16(0x0800) +
        ip + data);
  }
  return frames;
}

std::string block(std::uint32_t type, std::string body)
{
  body.resize((body.size() + 3) / 4 * 4);
  const auto size = static_cast<std::uint32_t>(body.size() + 12);
  return little().number(type).number(size).raw(body).number(size).bytes();
}

std::string headOf(const CaptureStyle& style)
{
  constexpr std::uint32_t kSnap = 262144, kEthernet = 1;
  if (!style.next_generation)
    return little()
        .number(std::uint32_t{0xA1B23C4D})  // nanoseconds
        .number(std::uint16_t{2})
        .number(std::uint16_t{4})
        .number(std::uint64_t{0})
        .number(kSnap)
        .number(kEthernet)
        .bytes();
  const std::string section = little()
                                  .number(std::uint32_t{0x1A2B3C4D})
                                  .number(std::uint16_t{1})
                                  .number(std::uint16_t{0})
                                  .number(std::int64_t{-1})
                                  .bytes();
  // The option if_tsresol says nanoseconds.
  const std::string interface = little()
                                    .number(std::uint16_t{1})
                                    .number(std::uint16_t{0})
                                    .number(kSnap)
                                    .number(std::uint16_t{9})
                                    .number(std::uint16_t{1})
                                    .number(std::uint32_t{9})
                                    .number(std::uint32_t{0})
                                    .bytes();
  return block(0x0A0D0D0A, section) + block(1, interface);
}

std::string recordOf(const std::string& frame, std::int64_t stamp_ns, const CaptureStyle& style)
{
  const auto size = static_cast<std::uint32_t>(frame.size());
  if (!style.next_generation)
    return little().time(stamp_ns).number(size).number(size).raw(frame).bytes();
  return block(
      6, little()
             .number(std::uint32_t{0})
             .number(static_cast<std::uint32_t>(stamp_ns >> 32U))
             .number(static_cast<std::uint32_t>(stamp_ns))
             .number(size)
             .number(size)
             .raw(frame)
             .bytes());
}
}  // namespace

std::string captureOf(const std::vector<SentPacket>& packets, const CaptureStyle& style)
{
  std::string bytes = headOf(style);
  std::vector<std::string> late;
  for (std::size_t i = 0; i < packets.size(); ++i)
  {
    std::size_t part = 0;
    for (const std::string& frame : framesOf(packets[i], i % 65536, style))
    {
      const std::string record = recordOf(frame, packets[i].stamp_ns, style);
      if (style.interleaved && part++ > 0)
        late.push_back(record);
      else
        bytes += record;
    }
  }
  for (const std::string& record : late)
    bytes += record;
  return bytes;
}

}  // namespace fastlio::testing
