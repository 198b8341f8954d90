// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-eval: how far is an estimated trajectory from the truth? */

#include "command_line.h"
#include <fastlio/evaluation/report.h>
#include <fastlio/files/atomic_file.h>
#include <fastlio/files/same_file.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>

namespace
{
constexpr int kExitOk = 0;
constexpr int kExitInput = 1;
constexpr int kExitGate = 2;

void writeReports(
    const fastlio::EvalCommand& command, const fastlio::EvaluationReport& report,
    const std::vector<fastlio::GateResult>& gates)
{
  const bool json_to_stdout = command.json_path == "-";
  std::cout << (json_to_stdout ? fastlio::toJson(report, gates) : fastlio::toTable(report, gates))
            << std::flush;
  if (!std::cout) throw std::runtime_error("standard output cannot be written");
  if (!command.json_path.empty() && !json_to_stdout)
    fastlio::writeFileAtomically(command.json_path, fastlio::toJson(report, gates));
  if (!command.svg_path.empty())
    fastlio::writeFileAtomically(command.svg_path, fastlio::toSvg(report));
}

/** No report may replace what it is about. */
void requireHarmlessOutputs(const fastlio::EvalCommand& command)
{
  std::vector<fastlio::FileUse> inputs = {
      {command.reference.string(), "--reference"}, {command.estimate.string(), "--estimate"}};
  if (!command.kitti.times_file.empty())
    inputs.push_back({command.kitti.times_file.string(), "--kitti-times"});
  std::vector<fastlio::FileUse> outputs;
  if (!command.json_path.empty() && command.json_path != "-")
    outputs.push_back({command.json_path, "--json"});
  if (!command.svg_path.empty()) outputs.push_back({command.svg_path.string(), "--plot"});
  fastlio::requireDistinctFiles(inputs, outputs);
}

/** Says on standard error which limits are not kept, with both numbers. */
int statusOf(const std::vector<fastlio::GateResult>& gates)
{
  int status = kExitOk;
  for (const fastlio::GateResult& gate : gates)
  {
    if (gate.passed) continue;
    std::cerr << "fastlio-eval: limit not kept: --" << gate.name << ": " << gate.measured << ' '
              << gate.unit << ", limit " << gate.limit << '\n';
    status = kExitGate;
  }
  return status;
}

int run(const fastlio::EvalCommand& command)
{
  requireHarmlessOutputs(command);
  const fastlio::EvaluationReport report = fastlio::evaluate(
      fastlio::readTrajectory(command.estimate, command.kitti),
      fastlio::readTrajectory(command.reference, command.kitti), command.evaluation);
  const std::vector<fastlio::GateResult> gates = fastlio::checkGates(report, command.gates);
  writeReports(command, report, gates);
  return statusOf(gates);
}

}  // namespace

int main(int argc, char** argv)
try
{
  CLI::App app{"Compares an estimated trajectory with the truth.", "fastlio-eval"};
  fastlio::EvalCommand command;
  fastlio::addOptions(app, command);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& e)
  {
    return app.exit(e) == 0 ? kExitOk : kExitInput;
  }
  return run(command);
}
catch (const std::exception& e)
{
  std::cerr << "fastlio-eval: " << e.what() << '\n';
  return kExitInput;
}
