// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file fuzz_targets.h The code that is fed with arbitrary bytes: every reader of foreign files.
 * A target must come back, without an exception, whatever the bytes are. */
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** A function that takes bytes, and how its seeds are called. */
struct FuzzTarget
{
  const char* name;  //!< of the folder in tests/fuzz/corpus
  void (*run)(const std::uint8_t* data, std::size_t size);

  /** Names the tests: an address in a name would change from run to run. */
  friend std::ostream& operator<<(std::ostream& out, const FuzzTarget& target)
  {
    return out << target.name;
  }
};

/** The bytes are a rawlog: read, converted, and given to the odometry. */
void fuzzRawlog(const std::uint8_t* data, std::size_t size);
/** A model number and the packets of a Velodyne. */
void fuzzPackets(const std::uint8_t* data, std::size_t size);
/** Columns of a point cloud: numbers of every kind. */
void fuzzCloud(const std::uint8_t* data, std::size_t size);
/** Text of a parameter file. */
void fuzzYaml(const std::uint8_t* data, std::size_t size);
/** A map to start in: PLY, PCD or an archive of MRPT, as the bytes say. */
void fuzzMap(const std::uint8_t* data, std::size_t size);
/** A trajectory for the evaluation: TUM, KITTI or CSV, as the bytes say. */
void fuzzTrajectory(const std::uint8_t* data, std::size_t size);
/** A line with a pattern, and a label. */
void fuzzLabel(const std::uint8_t* data, std::size_t size);
/** A line with the name of a file that a recording refers to, and what is in the file. */
void fuzzExternal(const std::uint8_t* data, std::size_t size);
/** Arguments of fastlio-replay, one a line. */
void fuzzCommandLine(const std::uint8_t* data, std::size_t size);

/** A recording of another maker in one file: what it is, the bytes say. */
void fuzzRecording(const std::uint8_t* data, std::size_t size);
/** A capture of a network. */
void fuzzCapture(const std::uint8_t* data, std::size_t size);
/** An encoding, a type and a message of it. */
void fuzzMessage(const std::uint8_t* data, std::size_t size);
/** Metadata of an Ouster. */
void fuzzMetadata(const std::uint8_t* data, std::size_t size);
/** A cloud in a file of its own, PCD or BIN. */
void fuzzCloudFile(const std::uint8_t* data, std::size_t size);

[[nodiscard]] const std::vector<FuzzTarget>& fuzzTargets();

/** Small valid inputs of a target, by file name: where mutations start. */
struct Seed
{
  std::string name, bytes;
};
[[nodiscard]] std::vector<Seed> seedsOf(const std::string& target);
/** Those of the targets in fuzz_files.cpp. */
[[nodiscard]] std::vector<Seed> seedsOfFiles(const std::string& target);
/** Those of the targets in fuzz_recordings.cpp. */
[[nodiscard]] std::vector<Seed> seedsOfRecordings(const std::string& target);

}  // namespace fastlio::testing
