// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file report_page.h The parts of a report's page, as HTML (internal). */
#pragma once

#include <fastlio/plot/report_figure.h>
#include <fastlio/report/report_map.h>
#include <fastlio/report/report_reference.h>
#include <fastlio/report/report_series.h>
#include <fastlio/run/run_summary.h>

#include <string>

namespace fastlio
{
/** The content of a report. */
struct ReportContent
{
  const RunSummary& run;
  const ReportSeries& series;
  MapViews map;
  ReferenceFindings reference;
};

/** Whether the run is to be trusted. */
struct RunVerdict
{
  std::string tone;      //!< "good", "warn" or "bad"
  std::string headline;  //!< a sentence
  std::string details;   //!< HTML paragraphs
};

[[nodiscard]] RunVerdict verdictOf(const RunSummary& run);

/** The sentence on the reference, and the table of errors. */
[[nodiscard]] std::string referenceHtml(const ReferenceFindings& findings);

/** Tables: scans, losses, sensors, calibration, parameters; the advice on each cause. */
[[nodiscard]] std::string factsHtml(const RunSummary& run);
[[nodiscard]] std::string untrustedHtml(const RunHealth& health);
[[nodiscard]] std::string lossesHtml(const RunSummary& run);
[[nodiscard]] std::string sensorsHtml(const RunSummary& run);
[[nodiscard]] std::string calibrationHtml(const RunSummary& run);
[[nodiscard]] std::string parametersHtml(const RunSummary& run);
[[nodiscard]] std::string diagnosticsHtml(const RunSummary& run);
[[nodiscard]] std::string adviceHtml();
/** Quantities that differ from run to run of the same input: times and memory. */
[[nodiscard]] std::string measuredFactsHtml(const RunSummary& run);

/** The whole page. */
[[nodiscard]] std::string reportPage(const ReportContent& content);

}  // namespace fastlio
