// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "units.h"
#include <fastlio/evaluation/report.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr std::size_t kCellWidth = 10;

std::string cell(const std::string& text)
{
  return std::string(kCellWidth - std::min(kCellWidth, text.size()), ' ') + text;
}

std::string cell(double value, int decimals)
{
  return cell(fixedText(value, decimals));
}

/** Something that not every estimate has. */
std::string cell(bool has, double value, int decimals)
{
  return has ? cell(value, decimals) : cell("-");
}

std::string rowOf(const EvaluationReport& r)
{
  const auto drift = r.drift.ratio();
  const bool nees = r.nees.has_value();
  const auto& second = r.rpe_second.translation;
  return cell(std::to_string(r.association.used)) + cell(toPercent(r.association.coverage), 1) +
         cell(r.ape.translation.rmse, 4) + cell(r.ape.translation.max, 4) +
         cell(toDegrees(r.ape.rotation.rmse), 3) + cell(second.count > 0, second.rmse, 4) +
         cell(drift.has_value(), drift ? toPercent(*drift) : 0.0, 3) +
         cell(nees, nees ? r.nees->pose.mean : 0.0, 2);
}
}  // namespace

std::string toTable(const std::vector<NamedReport>& reports)
{
  if (reports.empty()) return {};
  if (reports.size() == 1) return toTable(reports.front().report, reports.front().gates);
  std::size_t width = std::string("estimate").size();
  for (const NamedReport& named : reports)
    width = std::max(width, printable(named.name).size());
  std::string text = "reference   " + printable(reports.front().report.reference_source) +
                     "\nalignment   " + toString(reports.front().report.options.alignment) + "\n\n";
  text += padded("estimate", width) + cell("poses") + cell("time") + cell("APE") + cell("APE max") +
          cell("APE rot.") + cell("RPE") + cell("drift") + cell("NEES") + "\n" + padded("", width) +
          cell("") + cell("%") + cell("m") + cell("m") + cell("deg") + cell("m/s") + cell("%") +
          cell("(6)") + "\n";
  for (const NamedReport& named : reports)
    text += padded(printable(named.name), width) + rowOf(named.report) + "\n";
  const bool is_turned = std::any_of(
      reports.begin(), reports.end(),
      [](const NamedReport& named) { return named.report.uncertain_turn.has_value(); });
  if (is_turned)
    text +=
        "\nThe path is nearly straight: its positions leave the turn about it open, which is in "
        "the APE\nof the rotation. Use --align yaw or first.\n";
  return text;
}

}  // namespace fastlio
