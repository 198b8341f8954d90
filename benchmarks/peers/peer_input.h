// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file peer_input.h The input of a peer: inertial samples and scans in the order in which they
 * can be used, in the byte order of the machine. It includes nothing of this project, because it is
 * compiled together with the sources of the peers. */
#pragma once

#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

namespace peers
{
struct ImuRecord
{
  std::int64_t stamp_ns = 0;
  double gyro[3] = {};   //!< [rad/s]
  double accel[3] = {};  //!< specific force [m/s^2]
};

struct PointRecord
{
  float x = 0.0F, y = 0.0F, z = 0.0F;  //!< LiDAR frame [m]
  std::int32_t offset_ns = 0;          //!< since the first point of the scan
};

struct ScanRecord
{
  std::int64_t begin_ns = 0, end_ns = 0;  //!< times of the first and the last point
  double R_imu_lidar[9] = {};             //!< rows of the extrinsic's rotation
  double p_imu_lidar[3] = {};             //!< [m]
  std::vector<PointRecord> points;
};

using Record = std::variant<ImuRecord, ScanRecord>;

template <typename T>
void writeBytes(std::ostream& output, const T& value)
{
  output.write(reinterpret_cast<const char*>(&value), sizeof(value));
}

inline void write(std::ostream& output, const ImuRecord& record)
{
  output.put('I');
  writeBytes(output, record);
}

inline void write(std::ostream& output, const ScanRecord& record)
{
  output.put('S');
  writeBytes(output, record.begin_ns);
  writeBytes(output, record.end_ns);
  writeBytes(output, record.R_imu_lidar);
  writeBytes(output, record.p_imu_lidar);
  writeBytes(output, static_cast<std::uint64_t>(record.points.size()));
  output.write(
      reinterpret_cast<const char*>(record.points.data()),
      static_cast<std::streamsize>(record.points.size() * sizeof(PointRecord)));
}

template <typename T>
void readBytes(std::istream& input, T& value)
{
  input.read(reinterpret_cast<char*>(&value), sizeof(value));
}

/** All records of a file that write() made.
 * \exception std::runtime_error it ends inside a record */
inline std::vector<Record> readAll(std::istream& input)
{
  std::vector<Record> records;
  for (char kind = 0; input.get(kind);)
  {
    if (kind == 'I')
    {
      ImuRecord record;
      readBytes(input, record);
      records.emplace_back(record);
    }
    else
    {
      ScanRecord record;
      std::uint64_t size = 0;
      readBytes(input, record.begin_ns);
      readBytes(input, record.end_ns);
      readBytes(input, record.R_imu_lidar);
      readBytes(input, record.p_imu_lidar);
      readBytes(input, size);
      record.points.resize(size);
      input.read(
          reinterpret_cast<char*>(record.points.data()),
          static_cast<std::streamsize>(size * sizeof(PointRecord)));
      records.emplace_back(std::move(record));
    }
    if (!input) throw std::runtime_error("the input ends inside a record");
  }
  return records;
}
}  // namespace peers
