// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-import: recordings of other makers as rawlogs. */

#include "../shared/failure.h"
#include "../shared/interruption.h"
#include "command_line.h"
#include "import_run.h"

int main(int argc, char** argv)
{
  using namespace fastlio;
  catchInterruptions();
  return endOf("fastlio-import", ImportStatus::Usage, parseCommandLine(argc, argv), runImport);
}
