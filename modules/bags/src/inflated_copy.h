// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file inflated_copy.h A compressed file, inflated to one that can be read at any place. */
#pragma once

#include <cstddef>
#include <string>

namespace fastlio
{
/** A file in the folder for temporary files ($TMPDIR), which goes with the object. */
class InflatedCopy
{
 public:
  /** \exception std::runtime_error the data are damaged or claim to be unusually large, or there is
   * no room */
  explicit InflatedCopy(const std::string& path);
  ~InflatedCopy();
  InflatedCopy(const InflatedCopy&) = delete;
  InflatedCopy& operator=(const InflatedCopy&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/** The first inflated bytes of a file of Zstandard; none when it is no such file. */
[[nodiscard]] std::string inflatedHeadOf(const std::string& path, std::size_t size);

}  // namespace fastlio
