// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Messages of LiDARs: clouds with any fields, Livox's own, Velodyne's packets.

#include <fastlio/math/time.h>
#include <fastlio/messages/ros_messages.h>
#include <fastlio/packets/velodyne_scans.h>
#include <fastlio/recordings/cloud_builder.h>
#include <fastlio/recordings/point_grid.h>

#include <cstdlib>

namespace fastlio
{
namespace
{
std::vector<PointField> readFields(WireReader& in)
{
  constexpr std::size_t kLeast = 13;  // bytes of a field without a name
  std::vector<PointField> fields(in.count(kLeast));
  for (PointField& field : fields)
  {
    field.name = in.text();
    field.offset = in.number<std::uint32_t>();
    field.type = in.number<std::uint8_t>();
    (void)in.number<std::uint32_t>();  // values per point: the first one is read
  }
  return fields;
}

}  // namespace

RosObservation readPointCloud2(WireReader& in, const std::string& label)
{
  const RosHeader header = readRosHeader(in);
  PointGrid grid;
  grid.height = in.number<std::uint32_t>();
  grid.width = in.number<std::uint32_t>();
  const std::vector<PointField> fields = readFields(in);
  grid.swap = in.number<std::uint8_t>() != 0;
  grid.step = in.number<std::uint32_t>();
  grid.row_step = in.number<std::uint32_t>();
  const std::size_t bytes = in.count(1);
  grid.data = in.take(bytes);
  // Some drivers leave the length of a row out.
  if (grid.height == 1 || grid.row_step == 0) grid.row_step = grid.width * grid.step;
  return {makeCloud(columnsOf(grid, bytes, fields), label, header.stamp_ns), header.frame};
}

// Livox's offsets count from the message's time base, which drivers also write as its stamp, some
// of them by way of a double.
RosObservation readLivoxCustom(WireReader& in, const std::string& label)
{
  constexpr std::size_t kPointBytes = 19;
  constexpr std::int64_t kRounding = 1'000, kOtherClock = 1'000'000'000;  // [ns]
  const RosHeader header = readRosHeader(in);
  const auto base_ns = static_cast<std::int64_t>(in.number<std::uint64_t>());
  (void)in.number<std::uint32_t>();  // points, which the sequence holds again
  (void)in.take(4);                  // number of the LiDAR, reserved
  const std::size_t n = in.count(kPointBytes);
  const double ahead = static_cast<double>(base_ns) - static_cast<double>(header.stamp_ns);
  const bool shifted = std::abs(ahead) > kRounding && std::abs(ahead) < kOtherClock;
  const std::int64_t shift_ns = shifted ? base_ns - header.stamp_ns : 0;
  CloudColumns columns;
  for (std::size_t i = 0; i < n; ++i)
  {
    columns.time.push_back(toSeconds(std::int64_t{in.number<std::uint32_t>()} + shift_ns));
    columns.x.push_back(in.number<float>());
    columns.y.push_back(in.number<float>());
    columns.z.push_back(in.number<float>());
    columns.intensity.push_back(in.number<std::uint8_t>());
    (void)in.number<std::uint8_t>();  // tag
    columns.ring.push_back(in.number<std::uint8_t>());
  }
  return {makeCloud(columns, label, header.stamp_ns), header.frame};
}

RosObservation readVelodyneScan(WireReader& in, const std::string& label)
{
  const RosHeader header = readRosHeader(in);
  constexpr std::size_t kLeast = 8 + kVelodynePacketBytes;
  const std::size_t n = in.count(kLeast);
  std::vector<VelodynePacketBytes> packets;
  std::int64_t first_ns = header.stamp_ns;
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::int64_t stamp_ns = readRosTime(in);
    // The header's stamp is that of the last packet with most drivers; MRPT's is the first one's.
    if (i == 0 && stamp_ns != 0) first_ns = stamp_ns;
    packets.push_back(in.take(kVelodynePacketBytes));
  }
  return {makeVelodyneScan(packets, label, first_ns), header.frame};
}

}  // namespace fastlio
