// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// report.html as a browser lays it out, in a wide and in a narrow window.

#include "process.h"
#include "report_test_support.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace fastlio
{
namespace
{
using testing::reportOf;
using testing::TemporaryFolder;
using testing::troubled;
using testing::walk;

// Lists what reaches beyond the window, unless it is in a box that scrolls; and texts of drawings
// that meet.
constexpr const char* kCheck = R"(<script>
const found = [];
const width = document.documentElement.clientWidth;
if (document.documentElement.scrollWidth > width) found.push('the page scrolls sideways');
for (const e of document.body.querySelectorAll('*')) {
  const r = e.getBoundingClientRect();
  if (e.closest('svg') && e.tagName != 'svg') continue;
  if (r.right > width + 1 && !e.closest('.wide')) found.push(e.tagName + ' ' + e.textContent.slice(0, 60));
}
for (const svg of document.querySelectorAll('svg')) {
  const box = svg.getBoundingClientRect();
  const texts = [...svg.querySelectorAll('text')].filter(t => !t.getAttribute('transform') && t.textContent);
  for (const t of texts) {
    const a = t.getBoundingClientRect();
    if (a.left < box.left - 1 || a.right > box.right + 1 || a.top < box.top - 1 || a.bottom > box.bottom + 1)
      found.push('outside of its drawing: ' + t.textContent);
    for (const u of texts) {
      if (u === t || t.getAttribute('style') || u.getAttribute('style')) continue;
      const b = u.getBoundingClientRect();
      if (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 4 && b.top < a.bottom - 4)
        found.push('on each other: ' + t.textContent + ' | ' + u.textContent);
    }
  }
  if (box.height < 60) found.push('a flat drawing');
}
parent.postMessage('WIDTH ' + width + '\nFOUND ' + found.length + '\n' + found.slice(0, 20).join('\n'), '*');
</script>)";

// A window has a least width; a frame in it has none.
constexpr const char* kFrameBegin = R"(<!DOCTYPE html><html><body><pre id="result"></pre><script>
addEventListener('message', e => { document.getElementById('result').textContent = e.data; });
</script><iframe src="page.html" style="border:0;height:3000px;width:)";
constexpr const char* kFrameEnd = R"(px"></iframe></body></html>)";

/** Empty: there is none. */
std::string chromium()
{
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (std::filesystem::exists(folder + "/chromium")) return folder + "/chromium";
  return {};
}

/** The output of the check for the page in a window so wide. */
std::string checked(std::string html, int width, const std::string& scheme)
{
  const TemporaryFolder folder;
  html.replace(html.find("</body>"), 0, kCheck);
  std::ofstream(folder.file("page.html")) << html;
  std::ofstream(folder.file("frame.html")) << kFrameBegin << width << kFrameEnd;
  testing::Process browser(
      {chromium(), "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
       "--user-data-dir=" + folder.file("profile"),
       "--blink-settings=preferredColorScheme=" + scheme, "--window-size=1600,3000",
       "--virtual-time-budget=10000", "--dump-dom", "file://" + folder.file("frame.html")},
      folder.file("log"));
  const std::string output = browser.wait().output;
  const auto begin = output.find("WIDTH ");
  return begin == std::string::npos ? output : output.substr(begin, output.find("</pre>") - begin);
}

/** Long names, many digits, every kind of table and figure. */
std::string fullPage()
{
  auto scans = walk(60);
  for (int i = 60; i < 70; ++i)
    scans.push_back(troubled(i, HealthCause::MotionDisagreement, std::string(300, 'w')));
  for (std::size_t i = 0; i < scans.size(); ++i)
    scans[i].filter.x.gyro_bias.x() = 1e-7 * static_cast<double>(i);
  RunSummary run;
  run.inputs = {{"/" + std::string(300, 'p') + ".rawlog", 123456789}};
  run.sensors = {"label '" + std::string(200, 'l') + "'"};
  run.input_counts = {{"scans_with_unusable_point_times", 1234567}};
  run.options = {{"calibration.extrinsic_translation_std", std::string(200, '7'), false}};
  run.defaults = {{"calibration.extrinsic_translation_std", "0.01", false}};
  run.diagnostics = {{0, std::string(500, 'd')}};
  return reportOf(scans, run);
}

TEST(ReportPage, FitsIntoWideAndNarrowWindows)
{
  if (chromium().empty()) GTEST_SKIP() << "there is no chromium (apt-get install chromium)";
  const std::string html = fullPage();
  for (const int width : {1400, 800, 400})
    for (const char* scheme : {"0", "1"})
    {
      const std::string found = checked(html, width, scheme);
      EXPECT_NE(found.find("FOUND 0\n"), std::string::npos) << width << " px: " << found;
      EXPECT_EQ(found.rfind("WIDTH " + std::to_string(width) + "\n", 0), 0U) << found;
    }
}

TEST(ReportPage, OfAnEmptyRunFits)
{
  if (chromium().empty()) GTEST_SKIP() << "there is no chromium (apt-get install chromium)";
  const std::string found = checked(reportOf({}), 400, "0");
  EXPECT_NE(found.find("FOUND 0\n"), std::string::npos) << found;
}

/** The check itself can fail. */
TEST(ReportPage, WhatIsTooWideIsFound)
{
  if (chromium().empty()) GTEST_SKIP() << "there is no chromium (apt-get install chromium)";
  std::string html = reportOf(walk(3));
  html.replace(html.find("<main>"), 0, "<div style=\"width:900px\">too wide</div>");
  const std::string found = checked(html, 400, "0");
  EXPECT_EQ(found.find("FOUND 0\n"), std::string::npos) << found;
  EXPECT_NE(found.find("too wide"), std::string::npos) << found;
}

}  // namespace
}  // namespace fastlio
