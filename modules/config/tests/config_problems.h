// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file config_problems.h What a configuration is refused with, as text. */
#pragma once

#include "failure_message.h"
#include <fastlio/config/config_yaml.h>

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace fastlio::testing
{
inline Config fromText(const std::string& text)
{
  return loadConfig(mrpt::containers::yaml::FromText(text));
}

/** The message of the error that \a action throws; fails the test when it throws none. */
template <typename Error, typename Action>
std::string messageOf(const Action& action)
{
  std::string message = failureOf<Error>(action);
  EXPECT_FALSE(message.empty()) << "no exception of the expected type";
  return message;
}

inline std::string problemOf(const std::string& text)
{
  return messageOf<std::invalid_argument>([&] { (void)fromText(text); });
}

inline void expectContains(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}
}  // namespace fastlio::testing
