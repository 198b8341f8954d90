// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file report_figure.h Parts of pages: style, text, figures. */
#pragma once

#include <fastlio/plot/svg_plot.h>

#include <cstddef>
#include <string>
#include <vector>

namespace fastlio
{
/** A name and its colour, as CSS. */
struct LegendEntry
{
  std::string name, colour;
};

/** Text of others as part of a page: printable, in full, and escaped. */
[[nodiscard]] std::string htmlText(const std::string& text);

/** A count with its thousands apart: 51527 -> "51,527". */
[[nodiscard]] std::string countText(std::size_t count);

/** A plot with its title, its legend and a note below. \param note is HTML */
[[nodiscard]] std::string figureHtml(
    const PlotPanel& panel, const PlotRectangle& place, const std::string& title,
    const std::vector<LegendEntry>& legend, const std::string& note);

/** The style of a page, for light and dark screens. */
[[nodiscard]] std::string reportStyle();

/** A heading with what belongs to it.
 * \param content is HTML
 * \param id for links to it; empty: none */
[[nodiscard]] std::string sectionHtml(
    const std::string& title, const std::string& content, const std::string& id = {});

/** A table of plain text; a wide one scrolls. */
[[nodiscard]] std::string tableHtml(
    const std::vector<std::string>& headings, const std::vector<std::vector<std::string>>& rows);

/** Figures beside each other, as many as there is room for. */
[[nodiscard]] std::string figureGrid(const std::string& figures);

/** Remarks, a paragraph each, of plain text; empty ones are left out. */
[[nodiscard]] std::string notesHtml(const std::vector<std::string>& notes);

/** A page: one file that needs no other. */
struct Page
{
  std::string title;
  std::string tone;              //!< "good", "warn" or "bad" colours the headline; empty: neither
  std::string headline;          //!< a sentence
  std::string source;            //!< program, version, input
  std::string content;           //!< HTML; all others but the details are plain text
  std::string details = {};      //!< HTML below the headline
  std::string headline_id = {};  //!< for links to it; empty: none
};

[[nodiscard]] std::string pageHtml(const Page& page);
/** How a page begins whose title begins like that: to recognise one that is there. */
[[nodiscard]] std::string pageBeginning(const std::string& title);

}  // namespace fastlio
