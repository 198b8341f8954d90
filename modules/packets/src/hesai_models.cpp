// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The layouts follow Hesai's user manuals (section "data structure"), the tables of angles and
// times their appendices.

#include "hesai_models.h"

#include "packet_numbers.h"
#include <fastlio/math/angles.h>
#include <fastlio/recordings/byte_source.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace fastlio
{
namespace
{
/** Elevation [deg], offset of the azimuth [deg], time after that of the block [ns]. */
using BeamRow = std::array<double, 3>;

// clang-format off
constexpr std::array<BeamRow, 64> kPandar64{{
    {14.708, -1.042, -23180}, {10.858, -1.042, -21876}, {7.885, -1.042, -20572}, {4.883, -1.042, -19268},
    {2.866, -1.042, -17964}, {1.854, -1.042, -16660}, {1.686, 1.042, -11444}, {1.514, 3.125, -46796},
    {1.348, 5.208, -7532}, {1.177, -5.208, -36956}, {1.01, -3.125, -50732}, {0.839, -1.042, -54668},
    {0.672, 1.042, -40892}, {0.501, 3.125, -44828}, {0.334, 5.208, -31052}, {0.163, -5.208, -34988},
    {-0.005, -3.125, -48764}, {-0.174, -1.042, -52700}, {-0.343, 1.042, -38924}, {-0.511, 3.125, -42860},
    {-0.682, 5.208, -29084}, {-0.849, -5.208, -33020}, {-1.019, -3.125, -46796}, {-1.187, -1.042, -25148},
    {-1.358, 1.042, -36956}, {-1.525, 3.125, -50732}, {-1.696, 5.208, -27116}, {-1.862, -5.208, -40892},
    {-2.034, -3.125, -44828}, {-2.202, -1.042, -31052}, {-2.372, 1.042, -34988}, {-2.539, 3.125, -48764},
    {-2.71, 5.208, -25148}, {-2.874, -5.208, -38924}, {-3.047, -3.125, -42860}, {-3.214, -1.042, -29084},
    {-3.384, 1.042, -33020}, {-3.549, 3.125, -52700}, {-3.722, 5.208, -6228}, {-3.886, -5.208, -54668},
    {-4.058, -3.125, -15356}, {-4.224, -1.042, -27116}, {-4.395, 1.042, -10140}, {-4.559, 3.125, -23180},
    {-4.732, 5.208, -4924}, {-4.894, -5.208, -21876}, {-5.066, -3.125, -14052}, {-5.231, -1.042, -17964},
    {-5.403, 1.042, -8836}, {-5.565, 3.125, -19268}, {-5.739, 5.208, -3620}, {-5.9, -5.208, -20572},
    {-6.072, -3.125, -12748}, {-6.235, -1.042, -16660}, {-7.237, -1.042, -7532}, {-8.233, -1.042, -11444},
    {-9.234, -1.042, -6228}, {-10.059, -1.042, -15356}, {-11.206, -1.042, -10140}, {-12.18, -1.042, -4924},
    {-13.148, -1.042, -3620}, {-14.104, -1.042, -14052}, {-19.063, -1.042, -8836}, {-25.071, -1.042, -12748}}};

constexpr std::array<BeamRow, 40> kPandar40P{{
    {15.21, -1.042, -42220}, {11.36, -1.042, -28470}, {8.387, -1.042, -16040}, {5.385, -1.042, -3620},
    {3.368, -1.042, -45490}, {2.356, -1.042, -31740}, {2.016, 3.125, -47460}, {1.679, -5.208, -54670},
    {1.341, -1.042, -20620}, {1.003, 3.125, -33710}, {0.665, -5.208, -40910}, {0.328, -1.042, -8190},
    {-0.009, 3.125, -20620}, {-0.347, -5.208, -27160}, {-0.685, -1.042, -50730}, {-1.023, 3.125, -8190},
    {-1.36, -5.208, -14740}, {-1.7, -1.042, -36980}, {-2.037, 3.125, -45490}, {-2.372, -5.208, -52700},
    {-2.712, -1.042, -23890}, {-3.047, 3.125, -31740}, {-3.384, -5.208, -38950}, {-3.722, -1.042, -11470},
    {-4.057, 3.125, -18650}, {-4.392, -5.208, -25190}, {-4.729, -1.042, -48760}, {-5.063, 3.125, -6230},
    {-5.398, -5.208, -12770}, {-5.733, -1.042, -35010}, {-6.735, -1.042, -21920}, {-7.731, -1.042, -9500},
    {-8.732, -1.042, -43520}, {-9.557, -1.042, -29770}, {-10.704, -1.042, -17350}, {-11.678, -1.042, -4920},
    {-12.646, -1.042, -42220}, {-13.602, -1.042, -28470}, {-18.561, -1.042, -16040}, {-24.569, -1.042, -3620}}};

/** Of PandarQT: the times follow a rule, see timeOfQt(). */
constexpr std::array<std::array<double, 2>, 64> kPandarQt{{
    {-52.121, 8.736}, {-49.785, 8.314}, {-47.577, 7.964}, {-45.477, 7.669}, {-43.465, 7.417}, {-41.528, 7.198},
    {-39.653, 7.007}, {-37.831, 6.838}, {-36.055, 6.688}, {-34.32, 6.554}, {-32.619, 6.434}, {-30.95, 6.326},
    {-29.308, 6.228}, {-27.69, 6.14}, {-26.094, 6.059}, {-24.517, 5.987}, {-22.964, -5.27}, {-21.42, -5.216},
    {-19.889, -5.167}, {-18.372, -5.123}, {-16.865, -5.083}, {-15.368, -5.047}, {-13.88, -5.016}, {-12.399, -4.988},
    {-10.925, -4.963}, {-9.457, -4.942}, {-7.994, -4.924}, {-6.535, -4.91}, {-5.079, -4.898}, {-3.626, -4.889},
    {-2.175, -4.884}, {-0.725, -4.881}, {0.725, 5.493}, {2.175, 5.496}, {3.626, 5.502}, {5.079, 5.512},
    {6.534, 5.525}, {7.993, 5.541}, {9.456, 5.561}, {10.923, 5.584}, {12.397, 5.611}, {13.877, 5.642},
    {15.365, 5.676}, {16.861, 5.716}, {18.368, 5.759}, {19.885, 5.808}, {21.415, 5.862}, {22.959, 5.921},
    {24.524, -5.33}, {26.101, -5.396}, {27.697, -5.469}, {29.315, -5.55}, {30.957, -5.64}, {32.627, -5.74},
    {34.328, -5.85}, {36.064, -5.974}, {37.84, -6.113}, {39.662, -6.269}, {41.537, -6.447}, {43.475, -6.651},
    {45.487, -6.887}, {47.587, -7.163}, {49.795, -7.493}, {52.133, -7.892}}};
// clang-format on

/** Banks of eight fire in turn, with pauses between banks and between pairs of them. */
double timeOfQt(std::size_t channel)
{
  constexpr double kFirst = 2310, kNext = 2057, kBank = 16'850, kPair = 34'300;
  const auto times = [](std::size_t n, double ns) { return static_cast<double>(n) * ns; };
  return kFirst + times(channel % 8, kNext) + times(channel / 8 % 2, kBank) +
         times(channel / 16, kPair);
}

void append(HesaiBeams& beams, const BeamRow& row)
{
  beams.elevation.push_back(kRadPerDeg * row[0]);
  beams.azimuth.push_back(kRadPerDeg * row[1]);
  beams.time_ns.push_back(row[2]);
}

/** \name Layouts by family. A packet that is too short for its layout is refused by the caller.
 * @{ */
HesaiLayout ofPandar(HesaiKind kind, std::size_t blocks, std::size_t channels)
{
  HesaiLayout layout;
  layout.kind = kind;
  layout.blocks = blocks;
  layout.channels = channels;
  layout.unit = 3;
  layout.step_ns = 55'560;
  const bool marked = kind == HesaiKind::Pandar40P;  // each block begins with FF EE
  layout.head = marked ? 0 : 8;
  layout.block_head = marked ? 4 : 2;
  layout.offset_ns = marked ? -28'580 : -42'580;
  const std::size_t tail = layout.head + blocks * layout.blockBytes();
  layout.time_at = tail + 10;
  layout.return_at = tail + 14;
  layout.date_at = tail + 16;
  return layout;
}

HesaiLayout ofQt(std::size_t blocks, std::size_t channels)
{
  HesaiLayout layout;
  layout.kind = HesaiKind::PandarQT64;
  layout.blocks = blocks;
  layout.channels = channels;
  layout.head = 12;
  layout.unit = 4;
  layout.step_ns = 166'667;
  layout.offset_ns = 25'710 + 10'000;
  layout.from_first = true;
  layout.may_count_seconds = true;
  const std::size_t tail = layout.head + blocks * layout.blockBytes();
  layout.time_at = tail + 12;
  layout.return_at = tail + 16;
  layout.date_at = tail + 18;
  return layout;
}

HesaiLayout ofXt(HesaiKind kind, std::size_t blocks, std::size_t channels)
{
  HesaiLayout layout;
  layout.kind = kind;
  layout.blocks = blocks;
  layout.channels = channels;
  layout.head = 12;
  layout.unit = 4;
  layout.step_ns = 50'000;
  layout.may_count_seconds = true;
  const std::size_t tail = layout.head + blocks * layout.blockBytes();
  layout.return_at = tail + 10;
  layout.date_at = tail + 13;
  layout.time_at = tail + 19;
  return layout;
}

HesaiLayout of128(const UdpPacket& packet, std::size_t blocks, std::size_t channels)
{
  constexpr std::size_t kFlags = 11, kChecksum = 4, kSafetyBytes = 17, kMode = 11;
  constexpr std::uint8_t kSafety = 0x04, kConfidence = 0x10, kWeight = 0x20, kLight = 0x40;
  const std::uint8_t flags = packet.data[kFlags];
  const auto has = [flags](std::uint8_t bit) { return (flags & bit) != 0 ? 1U : 0U; };
  HesaiLayout layout;
  layout.kind = HesaiKind::Pandar128;
  layout.blocks = blocks;
  layout.channels = channels;
  layout.head = 12;
  layout.unit = std::size_t{3} + has(kConfidence) + has(kWeight) + has(kLight);
  layout.may_count_seconds = true;
  const std::size_t tail =
      layout.head + blocks * layout.blockBytes() + kChecksum + has(kSafety) * kSafetyBytes;
  layout.return_at = tail + 12;
  layout.date_at = tail + 15;
  layout.time_at = tail + 21;
  // High resolution fires twice as often.
  const bool fine = packet.size > tail + kMode && packet.data[tail + kMode] == 0;
  layout.step_ns = fine ? 27'778 : 55'556;
  return layout;
}
/** @} */

/** Of the packets that begin with EE FF, version and the numbers of channels and blocks. */
std::optional<HesaiLayout> layoutWithHead(const UdpPacket& packet)
{
  constexpr std::size_t kHead = 12;
  if (packet.size < kHead) return std::nullopt;
  const auto version = std::make_pair(int{packet.data[2]}, int{packet.data[3]});
  const std::size_t channels = packet.data[6], blocks = packet.data[7];
  if (version == std::make_pair(64, 6)) return ofPandar(HesaiKind::Pandar64, 6, 64);
  if (version == std::make_pair(3, 1) && channels == 64 && blocks <= 4) return ofQt(blocks, 64);
  if (version == std::make_pair(1, 4) && channels == 128 && blocks <= 2)
    return of128(packet, blocks, channels);
  if (version != std::make_pair(6, 1) || blocks > 8) return std::nullopt;
  if (channels == 16) return ofXt(HesaiKind::PandarXT16, blocks, channels);
  if (channels != 32) return std::nullopt;
  return ofXt(blocks == 6 ? HesaiKind::PandarXT32M : HesaiKind::PandarXT32, blocks, channels);
}

constexpr std::array<std::size_t, 2> kPandar40PBytes{1262, 1266};  // without and with a number
}  // namespace

std::optional<HesaiLayout> hesaiLayoutOf(const UdpPacket& packet)
{
  constexpr std::uint8_t kMark[] = {0xEE, 0xFF};
  constexpr std::size_t kDateBytes = 6, kUnitAt = 9, kUnitAt64 = 5;
  if (packet.size < 2) return std::nullopt;
  if (packet.data[0] == kMark[1] && packet.data[1] == kMark[0] &&
      (packet.size == kPandar40PBytes[0] || packet.size == kPandar40PBytes[1]))
    return ofPandar(HesaiKind::Pandar40P, 10, 40);
  if (packet.data[0] != kMark[0] || packet.data[1] != kMark[1]) return std::nullopt;
  auto layout = layoutWithHead(packet);
  if (!layout || layout->blocks == 0) return std::nullopt;
  const std::size_t end = std::max(layout->date_at + kDateBytes, layout->time_at + 4);
  if (packet.size < end) return std::nullopt;
  layout->range_unit =
      1e-3 * packet.data[layout->kind == HesaiKind::Pandar64 ? kUnitAt64 : kUnitAt];
  return layout;
}

HesaiBeams hesaiBeamsOf(HesaiKind kind)
{
  HesaiBeams beams;
  const auto evenly = [&beams](std::size_t n, double top, double step, double between)
  {
    constexpr double kFirst = 6000;  // ns
    for (std::size_t i = 0; i < n; ++i)
      append(
          beams,
          {top - static_cast<double>(i) * step, 0, kFirst + between * static_cast<double>(i)});
  };
  switch (kind)
  {
    case HesaiKind::Pandar40P:
      for (const BeamRow& row : kPandar40P)
        append(beams, row);
      break;
    case HesaiKind::Pandar64:
      for (const BeamRow& row : kPandar64)
        append(beams, row);
      break;
    case HesaiKind::PandarQT64:
      for (std::size_t i = 0; i < kPandarQt.size(); ++i)
        append(beams, {kPandarQt.at(i)[0], kPandarQt.at(i)[1], timeOfQt(i)});
      break;
    case HesaiKind::PandarXT16:
      evenly(16, 15, 2, 3024);
      break;
    case HesaiKind::PandarXT32:
      evenly(32, 15, 1, 1512);
      break;
    case HesaiKind::PandarXT32M:
      evenly(32, 19.5, 1.3, 2888);
      for (std::size_t i = 16; i < 32; ++i)  // two banks fire together
        beams.time_ns[i] = beams.time_ns[i - 16];
      break;
    case HesaiKind::Pandar128:
      beams.time_ns.assign(128, 0.0);  // within 0.05 ms
      break;
  }
  return beams;
}

std::optional<HesaiBeams> hesaiAnglesOf(const std::string& text)
{
  constexpr std::size_t kMostChannels = 512;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  if (line.find("Elevation") == std::string::npos || line.find("Azimuth") == std::string::npos)
    return std::nullopt;
  HesaiBeams beams;
  while (std::getline(lines, line))
  {
    for (char& c : line)
      if (c == ',' || c == '\r') c = ' ';
    std::istringstream row(line);
    std::size_t channel = 0;
    double elevation = 0, azimuth = 0;
    if (!(row >> channel)) continue;
    const bool good = static_cast<bool>(row >> elevation >> azimuth) && std::isfinite(elevation) &&
                      std::isfinite(azimuth) && channel == beams.elevation.size() + 1;
    if (!good || channel > kMostChannels) return std::nullopt;
    append(beams, {elevation, azimuth, 0});
  }
  if (beams.elevation.empty()) return std::nullopt;
  return beams;
}

std::optional<HesaiBeams> hesaiAnglesBeside(const std::string& capture)
{
  namespace fs = std::filesystem;
  constexpr std::size_t kLargestTable = 1U << 16U;
  fs::path path(capture);
  if (!path.has_filename()) path = path.parent_path();  // of a folder, as the shell completes it
  std::error_code error;
  for (const fs::path& table :
       {fs::path(path).replace_extension(".csv"), fs::path(path.string() + ".csv")})
    if (fs::is_regular_file(table, error) && fs::file_size(table, error) <= kLargestTable)
      return hesaiAnglesOf(headOf(table.string(), kLargestTable));
  return std::nullopt;
}

}  // namespace fastlio
