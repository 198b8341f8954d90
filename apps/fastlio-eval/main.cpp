// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-eval: how far is an estimated trajectory from the truth? */

#include "../shared/failure.h"
#include "../shared/parsing.h"
#include "command_line.h"
#include "estimates.h"
#include "picture.h"
#include <fastlio/evaluation/report.h>
#include <fastlio/files/atomic_file.h>
#include <fastlio/files/same_file.h>

#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
constexpr int kExitOk = 0;
constexpr int kExitInput = 1;
constexpr int kExitGate = 2;

using fastlio::EvalCommand;
using fastlio::NamedReport;

void writeReports(const EvalCommand& command, const std::vector<NamedReport>& reports)
{
  const bool json_to_stdout = command.json_path == "-";
  if (json_to_stdout)
    std::cout << fastlio::toJson(reports) << std::flush;
  else if (!command.quiet)
    std::cout << fastlio::toTable(reports) << std::flush;
  if (!std::cout) throw std::runtime_error("standard output cannot be written");
  if (!command.json_path.empty() && !json_to_stdout)
    fastlio::writeFileAtomically(command.json_path, fastlio::toJson(reports));
  if (!command.svg_path.empty())
    fastlio::writePicture(
        command.svg_path,
        reports.size() == 1 ? fastlio::toSvg(reports.front().report) : fastlio::toSvg(reports));
}

/** No report may replace what it is about. */
void requireHarmlessOutputs(
    const EvalCommand& command, const std::vector<fastlio::EstimateFile>& estimates)
{
  std::vector<fastlio::FileUse> inputs = {{command.reference.string(), "--reference"}};
  for (const fastlio::EstimateFile& estimate : estimates)
    inputs.push_back({estimate.file.string(), "--estimate"});
  inputs.push_back({command.kitti.times_file.string(), "--kitti-times"});
  std::vector<fastlio::FileUse> outputs = {{command.svg_path.string(), "--plot"}};
  if (command.json_path != "-") outputs.push_back({command.json_path, "--json"});
  fastlio::requireDistinctFiles(inputs, outputs);
  fastlio::requirePictureName(command.svg_path);
}

/** Says on standard error which limits are not kept, with both numbers. */
int statusOf(const std::vector<NamedReport>& reports)
{
  int status = kExitOk;
  for (const NamedReport& named : reports)
    for (const fastlio::GateResult& gate : named.gates)
    {
      if (gate.passed) continue;
      std::cerr << "fastlio-eval: " << (reports.size() > 1 ? named.name + ": " : "")
                << "limit not kept: --" << gate.name << ": " << gate.measured << ' ' << gate.unit
                << ", limit " << gate.limit << '\n';
      status = kExitGate;
    }
  return status;
}

/** One that cannot be used does not keep the others from being compared.
 * \return whether all of several could be used \exception std::exception a single one, or all,
 * cannot be used */
bool evaluateAll(
    const EvalCommand& command, const std::vector<fastlio::EstimateFile>& estimates,
    std::vector<NamedReport>& reports)
{
  const fastlio::Trajectory reference = fastlio::readTrajectory(command.reference, command.kitti);
  for (std::size_t i = 0; i < estimates.size(); ++i)
  {
    try
    {
      NamedReport named{
          estimates[i].name, fastlio::evaluate(
                                 fastlio::readTrajectory(estimates[i].file, command.kitti),
                                 reference, command.evaluation)};
      named.gates = fastlio::checkGates(named.report, command.gates);
      reports.push_back(std::move(named));
    }
    catch (const std::exception& e)
    {
      if (reports.empty() && i + 1 == estimates.size()) throw;
      std::cerr << "fastlio-eval: " << estimates[i].name
                << " is left out: " << fastlio::failureText(e) << '\n';
    }
  }
  return reports.size() == estimates.size();
}

int run(const EvalCommand& command)
{
  const auto estimates = fastlio::estimateFiles(command.estimates);
  requireHarmlessOutputs(command, estimates);
  std::vector<NamedReport> reports;
  const bool complete = evaluateAll(command, estimates, reports);
  writeReports(command, reports);
  return complete ? statusOf(reports) : kExitInput;
}

}  // namespace

int main(int argc, char** argv)
{
  return fastlio::endOf(
      "fastlio-eval", kExitInput,
      [&]
      {
        CLI::App app{"Compares an estimated trajectory with the truth.", "fastlio-eval"};
        EvalCommand command;
        fastlio::addOptions(app, command);
        const auto end = fastlio::endAfterParsing(app, argc, argv, kExitInput, [] {});
        return end ? *end : run(command);
      });
}
