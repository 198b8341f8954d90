// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-import: recordings of other makers as rawlogs. */

#include "command_line.h"
#include "import_run.h"
#include <fastlio/files/failure_text.h>

#include <iostream>

int main(int argc, char** argv)
{
  using namespace fastlio;
  const auto parsed = parseCommandLine(argc, argv);
  if (const auto* status = std::get_if<int>(&parsed)) return *status;
  try
  {
    return static_cast<int>(runImport(std::get<ImportArguments>(parsed)));
  }
  catch (const ImportInputError& e)
  {
    std::cerr << "fastlio-import: " << e.what() << '\n';
    return static_cast<int>(ImportStatus::Unusable);
  }
  catch (const std::exception& e)
  {
    std::cerr << "fastlio-import: " << failureText(e) << '\n';
    return static_cast<int>(ImportStatus::Usage);
  }
}
