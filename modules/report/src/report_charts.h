// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file report_charts.h The figures of a report over time, as HTML (internal). */
#pragma once

#include <fastlio/report/report_map.h>
#include <fastlio/report/report_reference.h>
#include <fastlio/report/report_series.h>

#include <string>

namespace fastlio
{
/** A part of the run in trouble, of one cause. */
struct TroubledStretch
{
  double begin_s = 0.0, end_s = 0.0;
  HealthCause cause = HealthCause::None;
};

/** Place of a chart over time on the page [px]. */
constexpr PlotRectangle kChartPlace{0.0, 0.0, 480.0, 220.0};

/** So many standard deviations are drawn. */
constexpr double kSigmas = 3.0;

/** The parts of the run in trouble, as fine as the bins of the series. */
[[nodiscard]] std::vector<TroubledStretch> troubledStretches(const ReportSeries& series);

/** An empty panel over the time of the run, with the troubled stretches. */
[[nodiscard]] PlotPanel timePanel(const ReportSeries& series, const char* unit);

/** Motion, uncertainty, biases, health and evidence. */
[[nodiscard]] std::string timeCharts(const ReportSeries& series);

/** Quantities of the machine: time per stage, memory. */
[[nodiscard]] std::string measuredCharts(const ReportSeries& series);

/** Errors with three standard deviations, and NEES. */
[[nodiscard]] std::string errorCharts(
    const ReferenceFindings& findings, const ReportSeries& series);

/** The colour of a cause as CSS: a variable of the page. */
[[nodiscard]] std::string causeColour(HealthCause cause);

}  // namespace fastlio
