// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for the widest vectors, as -march=native does it on such a machine, and never run:
// memory that Eigen gets here may be released by MRPT's libraries or by a user's program, which are
// built for any machine.

#include <Eigen/Core>

static_assert(EIGEN_DEFAULT_ALIGN_BYTES == 16 && EIGEN_MAX_ALIGN_BYTES == 16);
static_assert(EIGEN_MALLOC_ALREADY_ALIGNED == 1, "free() must release what Eigen allocates");
