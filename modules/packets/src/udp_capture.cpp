// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "udp_capture.h"

#include "packet_numbers.h"
#include <fastlio/math/time.h>
#include <fastlio/recordings/byte_source.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <pcap/pcap.h>
#include <stdexcept>
#include <string_view>

namespace fastlio
{
namespace
{
constexpr std::uint8_t kUdpProtocol = 17;
constexpr std::size_t kUdpHead = 8;
constexpr std::uint16_t kIp4Type = 0x0800, kIp6Type = 0x86DD, kVlanType = 0x8100,
                        kQinqType = 0x88A8;
constexpr std::size_t kMostFragmented = 64;  // packets that are put together at a time
constexpr std::size_t kLargestPacket = 65535;
constexpr std::int64_t kLatestSecond = kLatestStamp / kSecondNs;
}  // namespace

bool isCapture(const std::string& path)
{
  const std::string head = headOf(path, 4);
  constexpr std::array<std::string_view, 5> kMagics{
      "\xD4\xC3\xB2\xA1", "\xA1\xB2\xC3\xD4", "\x4D\x3C\xB2\xA1", "\xA1\xB2\x3C\x4D",
      "\x0A\x0D\x0D\x0A"};
  return std::find(kMagics.begin(), kMagics.end(), head) != kMagics.end();
}

UdpCapture::UdpCapture(const std::string& path) : pcap_(nullptr, pcap_close)
{
  const FileBytes readable(path);
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  pcap_.reset(pcap_open_offline_with_tstamp_precision(
      path.c_str(), PCAP_TSTAMP_PRECISION_NANO, error.data()));
  if (!pcap_) throw std::runtime_error(std::string("cannot be read as a capture: ") + error.data());
  link_ = pcap_datalink(pcap_.get());
}

UdpCapture::~UdpCapture() = default;

std::uint64_t UdpCapture::position() const
{
  const long position = std::ftell(pcap_file(pcap_.get()));
  return position < 0 ? 0 : static_cast<std::uint64_t>(position);
}

std::optional<UdpPacket> UdpCapture::next()
{
  for (;;)
  {
    pcap_pkthdr* head = nullptr;
    const std::uint8_t* data = nullptr;
    const int result = pcap_next_ex(pcap_.get(), &head, &data);
    if (result == PCAP_ERROR) failure_ = pcap_geterr(pcap_.get());
    if (result != 1) return std::nullopt;
    const auto ip = ipOf({data, head->caplen});
    if (!ip || ip->size == 0) continue;
    auto packet = ip->data[0] >> 4U == 4 ? udpOverIp4(*ip) : udpOverIp6(*ip);
    if (!packet) continue;
    // tv_usec holds nanoseconds, whatever the file has: libpcap was asked for them.
    const std::int64_t seconds = std::clamp<std::int64_t>(head->ts.tv_sec, 0, kLatestSecond);
    packet->stamp_ns =
        seconds * kSecondNs + std::clamp<std::int64_t>(head->ts.tv_usec, 0, 999'999'999);
    return packet;
  }
}

// The bytes behind the head of the link.
std::optional<UdpCapture::View> UdpCapture::ipOf(View frame) const
{
  constexpr std::size_t kEthernet = 14, kVlan = 4, kCooked = 16, kCooked2 = 20, kNull = 4;
  std::size_t at = 0;
  if (link_ == DLT_EN10MB)
  {
    if (frame.size < kEthernet) return std::nullopt;
    at = kEthernet;
    std::uint16_t type = big16At(frame.data + at - 2);
    for (; (type == kVlanType || type == kQinqType) && frame.size >= at + kVlan; at += kVlan)
      type = big16At(frame.data + at + 2);
    if (type != kIp4Type && type != kIp6Type) return std::nullopt;
  }
  else if (link_ == DLT_LINUX_SLL)
    at = kCooked;
  else if (link_ == DLT_LINUX_SLL2)
    at = kCooked2;
  else if (link_ == DLT_NULL || link_ == DLT_LOOP)
    at = kNull;
  else if (link_ != DLT_RAW && link_ != DLT_IPV4 && link_ != DLT_IPV6)
    return std::nullopt;
  if (frame.size <= at) return std::nullopt;
  return View{frame.data + at, frame.size - at};
}

namespace
{
/** \param at the head of UDP */
std::optional<UdpPacket> udpAt(const std::uint8_t* at, std::size_t size, std::string source)
{
  if (size < kUdpHead) return std::nullopt;
  const std::size_t length = big16At(at + 4);
  if (length < kUdpHead) return std::nullopt;
  UdpPacket packet;
  packet.source = std::move(source);
  packet.port = big16At(at + 2);
  packet.data = at + kUdpHead;
  packet.size = std::min(length, size) - kUdpHead;
  return packet;
}
}  // namespace

std::optional<UdpPacket> UdpCapture::udpOverIp4(View ip)
{
  constexpr std::size_t kShortest = 20;
  if (ip.size < kShortest) return std::nullopt;
  const std::size_t head = std::size_t{ip.data[0] & 0x0FU} * 4;
  const std::size_t length = big16At(ip.data + 2);
  if (head < kShortest || length < head || ip.size < length || ip.data[9] != kUdpProtocol)
    return std::nullopt;
  const auto whole = join(ip, {ip.data + head, length - head});
  if (!whole) return std::nullopt;
  const std::uint8_t* from = ip.data + 12;
  return udpAt(
      whole->data, whole->size,
      mrpt::format("%u.%u.%u.%u", unsigned{from[0]}, from[1], from[2], from[3]));
}

std::optional<UdpPacket> UdpCapture::udpOverIp6(View ip)
{
  constexpr std::size_t kHead = 40, kNextHeader = 6, kSource = 8;
  if (ip.size < kHead || ip.data[kNextHeader] != kUdpProtocol) return std::nullopt;
  std::string source;
  for (std::size_t i = 0; i < 16; i += 2)
    source += mrpt::format(i == 0 ? "%x" : ":%x", unsigned{big16At(ip.data + kSource + i)});
  return udpAt(ip.data + kHead, ip.size - kHead, std::move(source));
}

// A packet of its own at once; one in parts with the last part to come.
std::optional<UdpCapture::View> UdpCapture::join(View ip, View payload)
{
  const std::uint16_t word = big16At(ip.data + 6);
  const bool more = (word & 0x2000U) != 0;
  const std::size_t offset = std::size_t{word & 0x1FFFU} * 8;
  if (!more && offset == 0) return payload;
  const std::string key = std::string(reinterpret_cast<const char*>(ip.data) + 12, 8) +
                          std::string(reinterpret_cast<const char*>(ip.data) + 4, 2);
  auto found = std::find_if(
      fragments_.begin(), fragments_.end(), [&](const Fragments& f) { return f.key == key; });
  if (found == fragments_.end() || offset == 0)
  {
    if (found != fragments_.end()) fragments_.erase(found);  // the number is used again
    if (fragments_.size() == kMostFragmented) fragments_.pop_front();
    found = fragments_.insert(fragments_.end(), {key, {}, 0, 0});
  }
  const std::size_t end = offset + payload.size;
  if (end > kLargestPacket) return std::nullopt;
  found->bytes.resize(std::max(found->bytes.size(), end));
  std::copy_n(
      payload.data, payload.size, found->bytes.begin() + static_cast<std::ptrdiff_t>(offset));
  found->received += payload.size;
  if (!more) found->total = end;
  if (found->total == 0 || found->received < found->total) return std::nullopt;
  joined_ = std::move(found->bytes);
  fragments_.erase(found);
  return View{joined_.data(), joined_.size()};
}

}  // namespace fastlio
