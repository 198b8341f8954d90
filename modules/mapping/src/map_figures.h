// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_figures.h Figures of the page about a map, as HTML (internal). */
#pragma once

#include <fastlio/mapping/map_report.h>
#include <fastlio/plot/report_figure.h>

#include <string>

namespace fastlio
{
/** Place of a figure on the page [px]. Wider ones would have text that is too small on a phone. */
constexpr PlotRectangle kWideFigure{0.0, 0.0, 480.0, 340.0};

/** The map with the corrected paths; empty without points. */
[[nodiscard]] std::string mapSectionHtml(const MapAccount& account);

/** The walls around the closure that moved most, before and after; empty without closures. */
[[nodiscard]] std::string wallFigures(const MapAccount& account);

/** What the corrections changed. */
[[nodiscard]] std::string beforeAndAfterHtml(const MapAccount& account);

}  // namespace fastlio
