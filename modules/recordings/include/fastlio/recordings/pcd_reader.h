// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pcd_reader.h The points of PCD files. */
#pragma once

#include <fastlio/recordings/byte_source.h>
#include <fastlio/recordings/point_grid.h>

#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

namespace fastlio
{
/** Reads a PCD file (ascii, binary or binary_compressed, with any fields) piece by piece. It takes
 * memory for the piece at hand; a compressed file becomes one piece of at most 256 MiB. What its
 * exceptions say continues a sentence that begins with the file. */
class PcdReader
{
 public:
  /** \exception std::runtime_error it cannot be opened, its head is none, its coordinates are no
   * floats, its compressed data are damaged, or it has fewer bytes than binary points */
  explicit PcdReader(const std::string& path);

  /** Of the records; numbers in words are records of doubles. */
  [[nodiscard]] const std::vector<PointField>& fields() const { return fields_; }

  /** The next points, at most so many, as a row whose bytes last until the next call; none behind
   * the last one.
   * \exception std::runtime_error the file ends before, or a line has too few numbers */
  [[nodiscard]] PointGrid next(std::size_t most);

 private:
  enum class Form
  {
    Ascii,
    Binary,
    Compressed
  };

  void readHead();
  void readAscii(std::size_t points);
  void readBinary(std::size_t points);
  void unpack(std::size_t bytes_left);

  std::ifstream in_;
  std::vector<PointField> fields_;
  std::vector<std::size_t> counts_;  // values of each field
  std::size_t step_ = 0;             // bytes of a record
  std::size_t points_ = 0, given_ = 0;
  Form form_ = Form::Ascii;
  Bytes records_;  // of the piece at hand, of a compressed file all
};

}  // namespace fastlio
