// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/earth/control_points.h>
#include <fastlio/files/bounded_line.h>
#include <fastlio/files/input_file.h>
#include <fastlio/options/nearest_name.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>
#include <string_view>

namespace fastlio
{
namespace
{
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr double kFarthest = 1e8;  // of a coordinate [m]: none on the earth is that large

enum Column
{
  kName,
  kMapX,
  kMapY,
  kMapZ,
  kLatitude,
  kLongitude,
  kEast,
  kNorth,
  kHeight,
  kStd,
  kColumns
};
constexpr std::array<std::string_view, kColumns> kColumnNames = {
    "name", "map_x", "map_y", "map_z", "latitude", "longitude", "east", "north", "height", "std"};
constexpr std::size_t kMissing = std::numeric_limits<std::size_t>::max();

/** A table and how far it is read. */
class ControlPointFile
{
 public:
  ControlPointFile(const std::string& path, const ReferenceSystem* system)
      : path_(path), system_(system)
  {
    if (const auto problem = inputFileProblem(path))
      throw std::runtime_error("control points: '" + printable(path) + "' " + *problem);
    in_.open(path, std::ios::binary);  // what is no file could have blocked
    if (!in_) throw std::runtime_error("control points: '" + printable(path) + "' cannot be read");
    columns_.fill(kMissing);
    readHeader();
  }

  std::vector<ControlPoint> read()
  {
    std::vector<ControlPoint> points;
    std::set<std::string> names;
    while (nextRow())
    {
      if (points.size() == kMostControlPoints)
        fail("more than " + std::to_string(kMostControlPoints) + " control points; give fewer");
      points.push_back(point());
      if (!names.insert(points.back().name).second)
        fail(
            "the name " + quoted(points.back().name) + " is there twice; names distinguish points");
    }
    return points;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const
  {
    throw std::runtime_error(
        printable(path_) + ":" + std::to_string(std::max<std::size_t>(line_, 1)) + ": " + what);
  }
  static std::string quoted(std::string_view text) { return "'" + printable(text) + "'"; }
  [[nodiscard]] bool has(Column column) const { return columns_[column] != kMissing; }

  /** The next line that says something, as fields. */
  bool nextRow()
  {
    while (readBoundedLine(in_, text_))
    {
      if (++line_ == 1 && text_.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0)
        text_.erase(0, kByteOrderMark.size());
      if (text_.size() >= kLongestLine) fail("the line is too long for a row of control points");
      const std::string_view row = trimmed(text_);
      if (row.empty() || row.front() == '#') continue;
      fields_ = splitAtCommas(row);
      return true;
    }
    return false;
  }

  void readHeader()
  {
    if (!nextRow()) fail("the file is empty; its first row names columns: " + usual());
    width_ = fields_.size();
    for (std::size_t i = 0; i < width_; ++i)
      takeColumn(fields_[i], i);
    for (const Column needed : {kName, kMapX, kMapY, kMapZ, kHeight})
      if (!has(needed))
        fail(
            "no column " + quoted(kColumnNames[needed]) +
            " in the first row; it names columns: " + usual());
    const bool geodetic = has(kLatitude) && has(kLongitude), projected = has(kEast) && has(kNorth);
    const bool mixed = (has(kLatitude) || has(kLongitude)) && (has(kEast) || has(kNorth));
    if (mixed || (!geodetic && !projected))
      fail(
          "the first row names either latitude and longitude, or east and north; not part of both");
    if (projected && system_ == nullptr)
      fail(
          "eastings and northings need their coordinate reference system; give it, like "
          "EPSG:32632");
  }

  static std::string usual() { return "name,map_x,map_y,map_z,latitude,longitude,height"; }

  void takeColumn(std::string_view name, std::size_t index)
  {
    const auto* const found = std::find(kColumnNames.begin(), kColumnNames.end(), name);
    if (found == kColumnNames.end())
      fail(
          "unknown column " + quoted(name) + "; did you mean '" +
          std::string(nearestName(name, {kColumnNames.begin(), kColumnNames.end()})) +
          "'? Columns are separated by commas");
    std::size_t& column = columns_[static_cast<std::size_t>(found - kColumnNames.begin())];
    if (column != kMissing) fail("the column " + quoted(name) + " is there twice");
    column = index;
  }

  [[nodiscard]] double number(Column column, double farthest = kFarthest) const
  {
    const std::string_view field = fields_[columns_[column]];
    const auto value = parsed<double>(field);
    if (!value || !(std::abs(*value) <= farthest))
      fail(
          std::string(kColumnNames[column]) + " " + quoted(field) + " is no number" +
          (value ? " of at most " + shortestText(farthest) : "") +
          "; numbers have a point, not a comma, and no unit");
    return *value;
  }

  [[nodiscard]] ControlPoint point() const
  {
    if (fields_.size() != width_)
      fail(
          std::to_string(fields_.size()) + " fields, but the first row names " +
          std::to_string(width_) +
          " columns; fields are separated by commas, numbers have a point");
    ControlPoint point;
    point.name = std::string(fields_[columns_[kName]]);
    if (point.name.empty()) fail("the point has no name; give it one for the report");
    point.map = {number(kMapX), number(kMapY), number(kMapZ)};
    if (has(kStd) && !fields_[columns_[kStd]].empty()) point.std_m = number(kStd);
    if (!(point.std_m > 0))
      fail("a standard deviation of " + shortestText(point.std_m) + " m; it is above 0");
    point.place = place();
    return point;
  }

  [[nodiscard]] GeodeticPoint place() const
  {
    GeodeticPoint place;
    if (has(kLatitude))
      place = {number(kLatitude), number(kLongitude), number(kHeight)};
    else
      place = placeOf({number(kEast), number(kNorth), number(kHeight)});
    if (const char* problem = problemOf(place)) fail(problem);
    return place;
  }

  [[nodiscard]] GeodeticPoint placeOf(const Vec3& projected) const
  {
    try
    {
      return system_->geodeticOf(projected);
    }
    catch (const std::runtime_error& error)
    {
      fail(error.what());
    }
  }

  std::string path_;
  const ReferenceSystem* system_;
  std::ifstream in_;
  std::array<std::size_t, kColumns> columns_ = {};
  std::size_t width_ = 0, line_ = 0;
  std::string text_;
  std::vector<std::string_view> fields_;  //!< of text_
};
}  // namespace

std::vector<ControlPoint> readControlPoints(const std::string& path, const ReferenceSystem* system)
{
  return ControlPointFile(path, system).read();
}

std::vector<Correspondence> correspondencesIn(
    const LocalFrame& frame, const std::vector<ControlPoint>& points)
{
  std::vector<Correspondence> correspondences;
  correspondences.reserve(points.size());
  for (const ControlPoint& point : points)
    correspondences.push_back({point.map, frame.enuOf(point.place), point.std_m, point.name});
  return correspondences;
}

}  // namespace fastlio
