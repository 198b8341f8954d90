// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/messages/wire_reader.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr std::size_t kEncapsulation = 4;  // bytes ahead of the data in CDR
// Second byte of the head: plain CDR of version 1 or 2, big or little endian.
constexpr std::uint8_t kCdrBig = 0, kCdrLittle = 1, kCdr2Big = 6, kCdr2Little = 7;
}  // namespace

WireReader::WireReader(const std::uint8_t* data, std::size_t size, WireFormat format)
    : begin_(data), at_(data), end_(data + size), format_(format)
{
  if (format == WireFormat::Ros1) return;
  const std::uint8_t* head = take(kEncapsulation);
  const std::uint8_t kind = head[1];
  const bool known = head[0] == 0 && (kind == kCdrBig || kind == kCdrLittle || kind == kCdr2Big ||
                                      kind == kCdr2Little);
  if (!known)
    throw std::runtime_error(
        "its encoding " + std::to_string(head[0]) + "/" + std::to_string(kind) +
        " is not plain CDR");
  swap_ = kind == kCdrBig || kind == kCdr2Big;
  if (kind == kCdr2Big || kind == kCdr2Little) largest_alignment_ = 4;
  begin_ = at_;
}

void WireReader::align(std::size_t size)
{
  if (format_ == WireFormat::Ros1) return;
  const std::size_t step = std::min(size, largest_alignment_);
  const auto over = static_cast<std::size_t>(at_ - begin_) % step;
  if (over != 0) (void)take(step - over);
}

const std::uint8_t* WireReader::take(std::size_t size)
{
  if (size > left())
    throw std::runtime_error(
        "it ends early: " + std::to_string(size) + " bytes are announced, " +
        std::to_string(left()) + " are left");
  const std::uint8_t* bytes = at_;
  at_ += size;
  return bytes;
}

std::string_view WireReader::text()
{
  const std::size_t size = count(1);
  std::string_view text(reinterpret_cast<const char*>(take(size)), size);
  if (format_ == WireFormat::Cdr && !text.empty() && text.back() == '\0') text.remove_suffix(1);
  return text;
}

std::size_t WireReader::count(std::size_t least)
{
  const auto n = number<std::uint32_t>();
  if (n > left() / least)
    throw std::runtime_error(
        "it ends early: a sequence of " + std::to_string(n) + " is announced, " +
        std::to_string(left()) + " bytes are left");
  return n;
}

}  // namespace fastlio
