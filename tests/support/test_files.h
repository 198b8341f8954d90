// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file test_files.h Rawlogs written for a test, in a folder that is removed after it. */
#pragma once

#include "temporary_folder.h"

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/serialization/CSerializable.h>

#include <cstdint>
#include <string>
#include <vector>
#include <zlib.h>

namespace fastlio::testing
{
using Object = mrpt::serialization::CSerializable::Ptr;

/** The bytes of an object in an uncompressed rawlog. */
std::string serialize(const mrpt::serialization::CSerializable& object);

/** The bytes of an uncompressed rawlog. */
std::string serialize(const std::vector<Object>& objects);

/** One member of a gzip file, with whatever kinds of blocks zlib's level and strategy make. */
std::string gzip(
    const std::string& bytes, int level = 6, int strategy = Z_DEFAULT_STRATEGY,
    gz_header* header = nullptr);

/** A frame of Zstandard with a checksum, as MRPT 2.15.7 and newer write rawlogs. */
std::string zstd(const std::string& bytes);

void write(const std::string& file, const std::string& bytes);

constexpr std::int64_t kStart = 1'700'000'000'000'000'000;  // [ns]

/** A sample at rest, seconds after kStart. */
mrpt::obs::CObservationIMU::Ptr imuAt(double seconds, const std::string& label = "imu");

/** Empty when the tests were configured without recordings. */
std::string recordingsFolder();

}  // namespace fastlio::testing
