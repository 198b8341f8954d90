// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failure_message.h"
#include "temporary_folder.h"
#include <fastlio/earth/control_points.h>
#include <fastlio/options/number_text.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <sys/stat.h>

namespace fastlio
{
namespace
{
using testing::TemporaryFolder;
const GeodeticPoint kMunich{48.137, 11.575, 520};
constexpr const char* kHeader = "name,map_x,map_y,map_z,latitude,longitude,height\n";

std::string fileOf(const TemporaryFolder& folder, const std::string& content)
{
  std::ofstream(folder.file("c.csv"), std::ios::binary) << content;
  return folder.file("c.csv");
}

/** The message about a file, without its name. */
std::string refusalOf(const std::string& content, const ReferenceSystem* system = nullptr)
{
  const TemporaryFolder folder;
  const std::string path = fileOf(folder, content);
  const std::string begin = path + ":";
  const auto text =
      testing::failureOf<std::runtime_error>([&] { (void)readControlPoints(path, system); });
  return text.compare(0, begin.size(), begin) == 0 ? text.substr(begin.size()) : text;
}

TEST(ControlPoints, ColumnsComeInAnyOrder)
{
  const TemporaryFolder folder;
  const auto points = readControlPoints(fileOf(
      folder,
      "\xEF\xBB\xBF# surveyed in May\r\n\r\nheight, "
      "std,longitude,latitude,map_z,map_y,map_x,name\r\n"
      "520.5,0.02,11.575,48.137,3,2,1,church tower\r\n  # a remark\r\n"
      "521,,+11.6,-48.2,-3.5,1e2,-1,B"));
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].name, "church tower");
  EXPECT_EQ(points[0].map, Vec3(1, 2, 3));
  EXPECT_EQ(points[0].place.latitude_deg, 48.137);
  EXPECT_EQ(points[0].place.longitude_deg, 11.575);
  EXPECT_EQ(points[0].place.height_m, 520.5);
  EXPECT_EQ(points[0].std_m, 0.02);
  EXPECT_EQ(points[1].map, Vec3(-1, 100, -3.5));
  EXPECT_EQ(points[1].place.latitude_deg, -48.2);
  EXPECT_EQ(points[1].std_m, 0.05);
}

TEST(ControlPoints, EastingsAreOfTheirSystem)
{
  const ReferenceSystem utm("EPSG:32632");
  const Vec3 there = utm.projectedOf(kMunich);
  const TemporaryFolder folder;
  const auto points = readControlPoints(
      fileOf(
          folder, "name,map_x,map_y,map_z,east,north,height\nA,1,2,3," + roundTripText(there.x()) +
                      "," + roundTripText(there.y()) + ",520\n"),
      &utm);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].place.latitude_deg, 48.137, 1e-9);
  EXPECT_NEAR(points[0].place.longitude_deg, 11.575, 1e-9);
  EXPECT_EQ(points[0].place.height_m, 520);
}

TEST(ControlPoints, AFileFindsThePlaceOfAMap)
{
  const LocalFrame frame(kMunich);
  const ReferenceSystem utm(utmCodeAt(kMunich));
  Pose truth;
  const double yaw = -0.7;
  truth.R << std::cos(yaw), -std::sin(yaw), 0, std::sin(yaw), std::cos(yaw), 0, 0, 0, 1;
  truth.p = Vec3(100, -50, 4);
  std::string table = "name,map_x,map_y,map_z,east,north,height\n";
  for (int i = 0; i < 8; ++i)
  {
    const Vec3 map(120.0 * std::cos(i), 120.0 * std::sin(i), i);
    Vec3 there = utm.projectedOf(frame, truth * map);
    if (i == 5) there.x() += 20;
    table += "P" + std::to_string(i);
    for (const Vec3& v : {map, there})
      for (int axis = 0; axis < 3; ++axis)
        table += "," + fixedText(v[axis], 4);
    table += "\n";
  }
  const TemporaryFolder folder;
  const auto points = readControlPoints(fileOf(folder, table), &utm);
  const EarthFit fit = fitToEarth(correspondencesIn(frame, points));
  EXPECT_LT((fit.T_enu_map.R - truth.R).norm(), 1e-5);
  EXPECT_LT((fit.T_enu_map.p - truth.p).norm(), 1e-3);
  EXPECT_EQ(fit.used(), 7U);
  EXPECT_FALSE(fit.residuals[5].is_used);
  EXPECT_EQ(fit.residuals[5].name, "P5");
  EXPECT_NEAR(fit.residuals[5].residual_m.x(), -20, 0.5);
  EXPECT_LT(fit.rms_m, 1e-3);
}

TEST(ControlPoints, WrongHeadersAreNamed)
{
  EXPECT_EQ(
      refusalOf(""),
      "1: the file is empty; its first row names columns: "
      "name,map_x,map_y,map_z,latitude,longitude,height");
  EXPECT_EQ(
      refusalOf("name,map_x,map_y,map_z,lattitude,longitude,height\n"),
      "1: unknown column 'lattitude'; did you mean 'latitude'? Columns are separated by "
      "commas");
  EXPECT_EQ(refusalOf("name,map_x,map_x,map_z\n"), "1: the column 'map_x' is there twice");
  EXPECT_EQ(
      refusalOf("\n#\nname,map_x,map_y,latitude,longitude,height\n"),
      "3: no column 'map_z' in the first row; it names columns: "
      "name,map_x,map_y,map_z,latitude,longitude,height");
  for (const char* part :
       {"latitude", "east", "latitude,north", "latitude,longitude,east,north", "std"})
    EXPECT_EQ(
        refusalOf(std::string("name,map_x,map_y,map_z,height,") + part + "\n"),
        "1: the first row names either latitude and longitude, or east and north; not part of "
        "both")
        << part;
  EXPECT_EQ(
      refusalOf("name,map_x,map_y,map_z,east,north,height\n"),
      "1: eastings and northings need their coordinate reference system; give it, like "
      "EPSG:32632");
  EXPECT_NE(refusalOf("name;map_x;map_y\n").find("separated by commas"), std::string::npos);
}

TEST(ControlPoints, WrongRowsAreNamed)
{
  const auto row = [](const std::string& text) { return refusalOf(kHeader + text); };
  EXPECT_EQ(
      row("A,1,2,3,48,11,500\nB,1,2x,3,48,11,500\n"),
      "3: map_y '2x' is no number; numbers have a point, not a comma, and no unit");
  EXPECT_EQ(
      row("A,nan,2,3,48,11,500\n"),
      "2: map_x 'nan' is no number of at most 100000000; numbers have a point, not a comma, "
      "and no unit");
  EXPECT_EQ(
      row("A,1,2,3,48,11\n"),
      "2: 6 fields, but the first row names 7 columns; fields are separated by commas, "
      "numbers "
      "have a point");
  EXPECT_EQ(row("A,1,2,3,91,11,500\n"), "2: the latitude is not within -90 to 90 degrees");
  EXPECT_EQ(row("A,1,2,3,48,11,1e7\n"), "2: the height is not within -12 km to 100 km");
  EXPECT_EQ(row(" ,1,2,3,48,11,500\n"), "2: the point has no name; give it one for the report");
  EXPECT_EQ(
      row("A,1,2,3,48,11,500\nA,1,2,3,48,11,500\n"),
      "3: the name 'A' is there twice; names distinguish points");
  EXPECT_EQ(
      refusalOf("name,map_x,map_y,map_z,latitude,longitude,height,std\nA,1,2,3,48,11,500,0\n"),
      "2: a standard deviation of 0 m; it is above 0");
  EXPECT_EQ(
      row(std::string(20'000, '7') + "\n"), "2: the line is too long for a row of control points");
  EXPECT_EQ(row("\x1b[31m,1,2,3,48,11,x\n").find('\x1b'), std::string::npos);
}

TEST(ControlPoints, PlacesOutsideOfTheSystemAreNamed)
{
  const ReferenceSystem utm("EPSG:32632");
  const std::string text =
      refusalOf("name,map_x,map_y,map_z,east,north,height\nA,1,2,3,9e7,9e7,500\n", &utm);
  EXPECT_EQ(text.find("2: no place on the earth has easting 90000000"), 0U) << text;
}

TEST(ControlPoints, NoMoreThanTheLimit)
{
  std::string table = kHeader;
  for (std::size_t i = 0; i < kMostControlPoints; ++i)
    table += "P" + std::to_string(i) + ",1,2,3,48,11,500\n";
  EXPECT_EQ(refusalOf(table), "");
  EXPECT_EQ(
      refusalOf(table + "one more,1,2,3,48,11,500\n"),
      "100002: more than 100000 control points; give fewer");
}

TEST(ControlPoints, DamagedFilesAreTakenOrRefusedInPrintableWords)
{
  const ReferenceSystem utm("EPSG:32632");
  const std::string valid =
      "\xEF\xBB\xBF# points\r\nname,map_x,map_y,map_z,east,north,height,std\n"
      "A,1,2,3,691523.25,5334771.5,520,0.02\nB,-1e2,+2,3.5,691600,5334700,521,\n";
  const std::string odd = std::string("\0\n\r,;#\"\x1b\xff\xef e+-.", 15) + "9";
  std::mt19937_64 random(1);
  const auto below = [&](std::size_t end) { return static_cast<std::size_t>(random() % end); };
  const TemporaryFolder folder;
  int taken = 0, refused = 0;
  for (int i = 0; i < 1000; ++i)
  {
    std::string text = valid;
    for (std::size_t edit = 0; edit <= below(4); ++edit)
      text.replace(below(text.size()), below(8), below(4), odd[below(odd.size())]);
    const std::string path =
        fileOf(folder, text.substr(0, below(5) == 0 ? below(text.size()) : text.size()));
    try
    {
      for (const ControlPoint& point : readControlPoints(path, &utm))
        EXPECT_TRUE(problemOf(point.place) == nullptr && point.map.allFinite() && point.std_m > 0);
      ++taken;
    }
    catch (const std::runtime_error& error)
    {
      for (const char c : std::string(error.what()))
        EXPECT_GE(static_cast<unsigned char>(c), 0x20) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(taken, 30);
  EXPECT_GT(refused, 300);
}

TEST(ControlPoints, WhatIsNoFileIsNamed)
{
  const TemporaryFolder folder;
  const auto refusal = [](const std::string& path)
  { return testing::failureOf<std::runtime_error>([&] { (void)readControlPoints(path); }); };
  EXPECT_EQ(
      refusal(folder.path()), "control points: '" + folder.path() + "' is a folder, not a file");
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  EXPECT_NE(refusal(folder.file("pipe")), "");
  EXPECT_NE(refusal(folder.file("none.csv")).find("none.csv' does not exist"), std::string::npos)
      << refusal(folder.file("none.csv"));
}
}  // namespace
}  // namespace fastlio
