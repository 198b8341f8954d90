// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file failure.h Why a program ends, and with which status. */
#pragma once

#include <fastlio/files/failure_text.h>

#include <iostream>
#include <stdexcept>
#include <string>
#include <variant>

namespace fastlio
{
class Failure : public std::runtime_error
{
 public:
  /** \param status of the program's enumeration */
  template <typename Status>
  Failure(Status status, const std::string& text)
      : std::runtime_error(text), status_(static_cast<int>(status))
  {
  }

  [[nodiscard]] int status() const { return status_; }

 private:
  int status_;
};

/** Runs what may throw. \exception Failure with this status, or with its own */
template <typename Status, typename Step>
auto failingWith(Status status, Step step)
{
  try
  {
    return step();
  }
  catch (const Failure&)
  {
    throw;
  }
  catch (const std::exception& e)
  {
    throw Failure(status, failureText(e));
  }
}

/** The same of what throws std::invalid_argument for what the user asks, others for the input. */
template <typename Status, typename Step>
auto failingWith(Status asked, Status input, Step step)
{
  return failingWith(
      input,
      [&]
      {
        try
        {
          return step();
        }
        catch (const std::invalid_argument& e)
        {
          throw Failure(asked, failureText(e));
        }
      });
}

/** The status that \a run gives; what it throws is said on standard error.
 * \param otherwise status of what is no Failure */
template <typename Status, typename Run>
int endOf(const char* program, Status otherwise, Run run)
{
  try
  {
    return failingWith(otherwise, [&] { return static_cast<int>(run()); });
  }
  catch (const Failure& failure)
  {
    std::cerr << program << ": " << failure.what() << '\n';
    return failure.status();
  }
}

/** The same of \a run with the arguments that the command line gives.
 * \param parsed these, or the status of a command line after which nothing is to be run */
template <typename Status, typename Arguments, typename Run>
int endOf(const char* program, Status otherwise, std::variant<Arguments, int> parsed, Run run)
{
  if (const int* status = std::get_if<int>(&parsed)) return *status;
  return endOf(program, otherwise, [&] { return run(std::get<Arguments>(parsed)); });
}

}  // namespace fastlio
