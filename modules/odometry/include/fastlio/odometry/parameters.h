// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameters.h The former name of OdometryOptions. */
#pragma once

#include <fastlio/odometry/odometry_options.h>

namespace fastlio
{
using Parameters = OdometryOptions;

using OdometryOptions = Parameters;

}  // namespace fastlio
