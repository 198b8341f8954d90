// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file failure_message.h What a call throws, as text. */
#pragma once

#include <exception>
#include <string>

namespace fastlio::testing
{
/** The message of the Error that a call throws; empty when it throws nothing. Others pass. */
template <typename Error = std::exception, typename Call>
std::string failureOf(const Call& call)
{
  try
  {
    call();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return {};
}

}  // namespace fastlio::testing
