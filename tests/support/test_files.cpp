// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "test_files.h"

#include <fastlio/math/time.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

namespace fastlio::testing
{
std::string serialize(const mrpt::serialization::CSerializable& object)
{
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream).WriteObject(object);
  return {
      static_cast<const char*>(stream.getRawBufferData()),
      static_cast<std::size_t>(stream.getTotalBytesCount())};
}

std::string serialize(const std::vector<Object>& objects)
{
  std::string bytes;
  for (const Object& object : objects)
    bytes += serialize(*object);
  return bytes;
}

std::string gzip(const std::string& bytes, int level, int strategy, gz_header* header)
{
  constexpr int kGzipWindow = 15 + 16;
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, kGzipWindow, 8, strategy) != Z_OK)
    throw std::runtime_error("deflateInit2");
  if (header != nullptr) deflateSetHeader(&stream, header);
  std::string packed(deflateBound(&stream, bytes.size()) + 64, '\0');
  std::string input = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

std::string zstd(const std::string& bytes)
{
  std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  packed.resize(
      ZSTD_compress2(context.get(), packed.data(), packed.size(), bytes.data(), bytes.size()));
  return packed;
}

void write(const std::string& file, const std::string& bytes)
{
  // A new file: truncating an old one makes ext4 flush it to the disk.
  std::filesystem::remove(file);
  std::ofstream(file, std::ios::binary) << bytes;
}

mrpt::obs::CObservationIMU::Ptr imuAt(double seconds, const std::string& label)
{
  auto imu = mrpt::obs::CObservationIMU::Create();
  imu->sensorLabel = label;
  imu->timestamp = fastlio::toMrptTime(kStart + toNanoseconds(seconds));
  imu->set(mrpt::obs::IMU_WX, 0.01);
  imu->set(mrpt::obs::IMU_WY, 0.02);
  imu->set(mrpt::obs::IMU_WZ, 0.03);
  imu->set(mrpt::obs::IMU_X_ACC, 0.1);
  imu->set(mrpt::obs::IMU_Y_ACC, 0.2);
  imu->set(mrpt::obs::IMU_Z_ACC, 9.81);
  return imu;
}

std::string recordingsFolder()
{
  return FASTLIO_RECORDINGS_DIR;
}

}  // namespace fastlio::testing
