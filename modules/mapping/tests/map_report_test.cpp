// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mapping/map_report.h>

#include <gtest/gtest.h>

#include <memory>

namespace fastlio
{
namespace
{
/** Two submaps with a plane each, and a closure between them. */
MappingResult twoSubmaps()
{
  const auto store = std::make_shared<SubmapStore>();
  MappingResult result;
  result.submaps.resize(2);
  for (Submap& submap : result.submaps)
    submap.surfaces = StoredSurfaces(store, {{VoxelPlane{}}, {0.01F}});
  result.estimate.nodes.resize(2);
  Closure closure;
  closure.a = 0;
  closure.b = 1;
  closure.verdict = ClosureVerdict::Accepted;
  result.closures = {closure};
  return result;
}
}  // namespace

/** The odometries of two sessions have no world in common: there is no before. */
TEST(ClosureAgreement, BetweenSessionsHasNoBefore)
{
  MappingResult result = twoSubmaps();
  result.submaps[1].session = 1;
  ASSERT_EQ(agreements(result).size(), 1U);
  EXPECT_FALSE(agreements(result).front().before);
  result.submaps[1].session = 0;
  EXPECT_TRUE(agreements(result).front().before);
}

/** Surfaces that are lost are not 0 m apart. */
TEST(ClosureAgreement, IsNotKnownOfSurfacesThatAreLost)
{
  MappingResult result = twoSubmaps();
  result.submaps[0].surfaces = {};
  EXPECT_TRUE(agreements(result).empty());
}

/** Two sessions of a submap each; the second one lies 10 m further. Its loop moves it by 0.1 m. */
BuiltMap twoSessions()
{
  BuiltMap map;
  map.result = twoSubmaps();
  MappingResult& r = map.result;
  r.submaps[1].session = 1;
  r.anchors.resize(2);
  r.anchors[0].found = r.anchors[1].found = true;
  r.anchors[1].T_world_session.p = {10.0, 0.0, 0.0};
  r.estimate.nodes[1].p = {10.0, 0.1, 0.0};
  r.estimate.covariances.assign(2, Matrix6::Zero());
  r.corrected = true;
  map.sessions.resize(2);
  map.sessions[0].name = "monday";
  map.sessions[1].name = "tuesday";
  for (SessionOutcome& session : map.sessions)
    session.path = {{0, Pose{}}, {1, Pose{Mat3::Identity(), {1.0, 0.0, 0.0}}}};
  return map;
}

MapAccount accountOf(const BuiltMap& map)
{
  MapAccount account{"1", {"a.rawlog"}, "defaults",     map,     {}, {}, {}, 0, {}, {}, {},
                     {},  0.0,          ExitStatus::Ok, nullptr, {}};
  account.agreements = agreements(map.result);
  return account;
}

bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/** The part of a page that a figure takes. */
std::string figureOf(const std::string& html, const std::string& title)
{
  const auto begin = html.find("<b>" + title + "</b>");
  if (begin == std::string::npos) return {};
  return html.substr(begin, html.find("</figure>", begin) - begin);
}

/** The way from one session's world to the map is no correction. */
TEST(MapReport, ACorrectionIsCountedFromThePlaceOfTheSession)
{
  const BuiltMap map = twoSessions();
  EXPECT_NEAR(correctionOf(map.result, 1).norm(), 0.1, 1e-12);
  const MapAccount account = accountOf(map);
  EXPECT_TRUE(has(mapSentence(account), "moved by up to 0.100 m")) << mapSentence(account);
  const std::string figure = figureOf(mapReportHtml(account), "Correction");
  EXPECT_TRUE(has(figure, ">0.1<")) << figure;
  EXPECT_FALSE(has(figure, ">10<")) << figure;
}

TEST(MapReport, TheHeadlineIsShort)
{
  BuiltMap map = twoSessions();
  EXPECT_EQ(mapHeadline(accountOf(map)), "1 loop closed; the map is consistent to 0 mm.");
  EXPECT_TRUE(has(mapReportHtml(accountOf(map)), "<header class=\"good\">"));
  map.result.anchors[1].found = false;
  EXPECT_TRUE(has(mapHeadline(accountOf(map)), "A session is missing"));
  map.result.anchors[1].found = true;
  map.result.closures[0].verdict = ClosureVerdict::OutOfReach;
  map.result.corrected = false;
  const std::string html = mapReportHtml(accountOf(map));
  EXPECT_TRUE(has(html, "No loop found: the map is that of the odometry.")) << html;
  EXPECT_TRUE(has(html, "<header class=\"\">"));
}

TEST(MapReport, ClosuresAreToldInWords)
{
  BuiltMap map = twoSessions();
  map.result.closures[0].verdict = ClosureVerdict::OutOfReach;
  const std::string html = mapReportHtml(accountOf(map));
  EXPECT_TRUE(has(html, "<th>submap A</th><th>submap B</th>")) << html;
  EXPECT_TRUE(has(html, "<td>too far from the odometry</td>"));
  EXPECT_FALSE(has(html, "out_of_reach"));
}

TEST(MapReport, PlacesWhereTheOdometryWasLostAreToldInTheFirstSentence)
{
  BuiltMap map = twoSessions();
  EXPECT_FALSE(has(mapSentence(accountOf(map)), "lost"));
  map.result.closures[0].verdict = ClosureVerdict::Unpredicted;
  const std::string sentence = mapSentence(accountOf(map));
  EXPECT_TRUE(has(sentence, "closures (1 refused, as the odometry was lost): none")) << sentence;
}

/** Without them, nothing levels the map. */
TEST(MapReport, ReadingsOfGravityAreCounted)
{
  BuiltMap map = twoSessions();
  EXPECT_TRUE(has(mapSentence(accountOf(map)), "2 submaps (0 with a reading of gravity), "));
  map.result.submaps[1].gravity.emplace();
  EXPECT_TRUE(has(mapSentence(accountOf(map)), "2 submaps (1 with a reading of gravity), "));
  EXPECT_TRUE(has(mapSummaryJson(accountOf(map)), "\"gravity_readings\": 1"));
}

TEST(MapReport, SessionsAreToldApart)
{
  const std::string html = mapReportHtml(accountOf(twoSessions()));
  for (const char* title : {"Height", "Correction"})
    EXPECT_TRUE(has(figureOf(html, title), ">tuesday</text>")) << figureOf(html, title);
  EXPECT_TRUE(has(figureOf(html, "Paths from above"), ">start of tuesday</text>"));
  // Both sessions have nothing before.
  EXPECT_FALSE(has(figureOf(html, "Surfaces seen twice"), "odometry</span>"));
}

/** A phone is 400 pixels wide: the text of a figure of 640 would be 7 pixels high there. */
TEST(MapReport, FiguresCanBeReadOnAPhone)
{
  const std::string html = mapReportHtml(accountOf(twoSessions()));
  const std::string box = "viewBox=\"0 0 ";
  int figures = 0;
  for (auto at = html.find(box); at != std::string::npos; at = html.find(box, at + 1), ++figures)
    EXPECT_LE(std::stod(html.substr(at + box.size())), 480.0);
  EXPECT_GE(figures, 4);
}

/** Points of the map and all poses, not the places of the submaps alone. */
TEST(MapReport, ShowsTheMapWithTheWholePath)
{
  const BuiltMap map = twoSessions();
  OutputMap points;
  OutputPoints wall;
  for (int i = 0; i < 1000; ++i)
  {
    wall.x.push_back(0.02F * static_cast<float>(i));
    wall.y.push_back(5.0F);
    wall.z.push_back(0.002F * static_cast<float>(i));
    wall.intensity.push_back(0.0F);
    wall.stamp_ns.push_back(0);
  }
  points.insert(wall);
  MapAccount account = accountOf(map);
  EXPECT_FALSE(has(mapReportHtml(account), "Trajectory and map"));
  account.points_map = &points;
  const std::string html = mapReportHtml(account);
  const std::string figure = figureOf(html, "From above");
  EXPECT_TRUE(has(figure, "<path ")) << html;
  EXPECT_TRUE(has(figure, "path of tuesday")) << figure;
  EXPECT_TRUE(has(figure, "The saved map has ")) << figure;
  account.points_problem = "the disk is full";
  EXPECT_TRUE(has(mapReportHtml(account), "The map is not complete: the disk is full"));
}

}  // namespace fastlio
