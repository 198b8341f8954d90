// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "fuzz_targets.h"

/** Entry of libFuzzer. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  fastlio::testing::fuzzYaml(data, size);
  return 0;
}
