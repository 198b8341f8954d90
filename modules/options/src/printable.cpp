// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/printable.h>

#include <cstdint>

namespace fastlio
{
namespace
{
/** A character of UTF-8, or a byte that begins none. */
struct Character
{
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool valid = false;
};

unsigned char byteOf(std::string_view text, std::size_t at)
{
  return static_cast<unsigned char>(text[at]);
}

Character characterAt(std::string_view text, std::size_t at)
{
  constexpr std::uint32_t kFirstOfLength[] = {0, 0, 0x80, 0x800, 0x10000};
  const unsigned char lead = byteOf(text, at);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t length = (lead & 0xE0U) == 0xC0   ? 2
                             : (lead & 0xF0U) == 0xE0 ? 3
                             : (lead & 0xF8U) == 0xF0 ? 4
                                                      : 0;
  if (length == 0 || text.size() - at < length) return {lead, 1, false};
  std::uint32_t code = lead & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i)
  {
    const unsigned char next = byteOf(text, at + i);
    if ((next & 0xC0U) != 0x80) return {lead, 1, false};
    code = (code << 6U) | (next & 0x3FU);
  }
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  const bool valid = code >= kFirstOfLength[length] && code <= 0x10FFFF && !surrogate;
  return {code, valid ? length : 1, valid};
}

/** Controls (C0, C1, DEL), ends of lines and marks of direction. */
bool isControl(std::uint32_t code)
{
  return code < 0x20 || (code >= 0x7F && code <= 0x9F) || code == 0x61C ||
         (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
}

std::string escaped(unsigned char byte)
{
  constexpr const char* kDigits = "0123456789abcdef";
  if (byte == '\n') return "\\n";
  if (byte == '\r') return "\\r";
  if (byte == '\t') return "\\t";
  return std::string("\\x") + kDigits[byte >> 4U] + kDigits[byte & 0xFU];
}
}  // namespace

std::string printable(std::string_view text, std::size_t longest)
{
  std::string shown;
  for (std::size_t at = 0; at < text.size();)
  {
    const Character character = characterAt(text, at);
    if (at + character.bytes > longest)
      return shown + "... (" + std::to_string(text.size()) + " bytes)";
    if (character.valid && !isControl(character.code))
      shown += text.substr(at, character.bytes);
    else
      for (std::size_t i = 0; i < character.bytes; ++i)
        shown += escaped(byteOf(text, at + i));
    at += character.bytes;
  }
  return shown;
}

}  // namespace fastlio
