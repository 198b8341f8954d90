// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gzip_inflater.h Decompression of gzip data, by one library or another. */
#pragma once

#include <fastlio/recordings/inflater.h>

namespace fastlio
{
/** Inflates one member of a gzip file after the other. */
using GzipInflater = Inflater;

/** zlib.
 * \exception std::bad_alloc */
[[nodiscard]] std::unique_ptr<GzipInflater> makeZlibInflater();

/** Intel's ISA-L, 2.5 times as fast (fastlio-microbenchmark --benchmark_filter=inflate); null where
 * it is not built in. */
[[nodiscard]] std::unique_ptr<GzipInflater> makeIsalInflater();

}  // namespace fastlio
