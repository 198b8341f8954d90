// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "fuzz_targets.h"

#include <cstring>

/** Entry of libFuzzer; the target is chosen when the program is built. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  for (const auto& target : fastlio::testing::fuzzTargets())
    if (std::strcmp(target.name, FASTLIO_FUZZ_TARGET) == 0) target.run(data, size);
  return 0;
}
