// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/plot/report_figure.h>

namespace fastlio
{
namespace
{
std::string idAttribute(const std::string& id)
{
  return id.empty() ? "" : " id=\"" + id + "\"";
}

/** \param element th or td */
std::string rowHtml(const std::string& element, const std::vector<std::string>& texts)
{
  std::string html = "<tr>";
  for (const std::string& text : texts)
    html += "<" + element + ">" + htmlText(text) + "</" + element + ">";
  return html + "</tr>\n";
}
}  // namespace

std::string htmlText(const std::string& text)
{
  constexpr std::size_t kLongest = 2000;  // a path or a message in full, and no page of it
  return escapeXml(printable(text, kLongest));
}

std::string countText(std::size_t count)
{
  std::string text = std::to_string(count);
  for (std::size_t digits = 3; digits < text.size(); digits += 4)
    text.insert(text.size() - digits, 1, ',');
  return text;
}

std::string figureHtml(
    const PlotPanel& panel, const PlotRectangle& place, const std::string& title,
    const std::vector<LegendEntry>& legend, const std::string& note)
{
  std::string html = "<figure>\n<figcaption><b>" + htmlText(title) + "</b>";
  for (const LegendEntry& entry : legend)
    html += R"( <span class="key"><i style="background:)" + entry.colour + R"("></i>)" +
            htmlText(entry.name) + "</span>";
  html +=
      "</figcaption>\n"
      R"(<svg viewBox="0 0 )" +
      fixedText(place.width, 0) + " " + fixedText(place.height, 0) +
      R"(" role="img" aria-label=")" + htmlText(title) + "\">\n" + drawPanel(panel, place) +
      "</svg>\n";
  if (!note.empty()) html += "<p>" + note + "</p>\n";
  return html + "</figure>\n";
}

std::string sectionHtml(const std::string& title, const std::string& content, const std::string& id)
{
  return "<section" + idAttribute(id) + ">\n<h2>" + htmlText(title) + "</h2>\n" + content +
         "</section>\n";
}

std::string tableHtml(
    const std::vector<std::string>& headings, const std::vector<std::vector<std::string>>& rows)
{
  std::string html = "<div class=\"wide\"><table>\n" + rowHtml("th", headings);
  for (const std::vector<std::string>& row : rows)
    html += rowHtml("td", row);
  return html + "</table></div>\n";
}

std::string figureGrid(const std::string& figures)
{
  return "<div class=\"grid-of\">\n" + figures + "</div>\n";
}

std::string notesHtml(const std::vector<std::string>& notes)
{
  std::string html;
  for (const std::string& note : notes)
    if (!note.empty()) html += "<p class=\"note\">" + htmlText(note) + "</p>\n";
  return html;
}

std::string pageBeginning(const std::string& title)
{
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
         htmlText(title);
}

std::string pageHtml(const Page& page)
{
  return pageBeginning(page.title) + "</title>\n<style>\n" + reportStyle() +
         "</style>\n</head>\n<body>\n<header class=\"" + page.tone + "\">\n<h1" +
         idAttribute(page.headline_id) + ">" + htmlText(page.headline) +
         "</h1>\n<p class=\"source\">" + htmlText(page.source) + "</p>\n" + page.details +
         "</header>\n<main>\n" + page.content + "</main>\n</body>\n</html>\n";
}

}  // namespace fastlio
