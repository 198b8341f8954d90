// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "temporary_folder.h"
#include <fastlio/mapping/georeference.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fastlio
{
namespace
{
using testing::contentOf;
using testing::TemporaryFolder;

GnssOutcome gnssAt(double latitude_deg, double longitude_deg)
{
  GnssOutcome gnss;
  gnss.used = true;
  gnss.datum = {latitude_deg, longitude_deg, 500.0};
  return gnss;
}

/** What a map by GNSS is given in; empty: it has no place. */
std::string systemOf(const GnssOutcome& gnss, const std::string& crs)
{
  const auto place = georeference(gnss, "", crs);
  return place ? place->crs : "";
}

TEST(Georeference, UtmIsTheZoneOfThePlace)
{
  for (const char* crs : {"", "utm", "UTM"})
  {
    EXPECT_EQ(systemOf(gnssAt(48.1, 11.6), crs), "EPSG:32632") << crs;
    EXPECT_EQ(systemOf({}, crs), "") << crs;
    EXPECT_EQ(unplacedReason(gnssAt(48.1, 11.6), crs), "") << crs;
  }
  EXPECT_EQ(systemOf(gnssAt(48.1, 11.6), "EPSG:25833"), "EPSG:25833");
  EXPECT_THROW((void)georeference({}, "", "EPSG:1"), std::invalid_argument);
}

/** After hours of work, such a place must not be the end of it. */
TEST(Georeference, BeyondTheZonesOfUtmTheMapHasNoPlace)
{
  for (const double latitude : {84.5, -80.5})
  {
    EXPECT_EQ(systemOf(gnssAt(latitude, 15.0), ""), "");
    const std::string reason = unplacedReason(gnssAt(latitude, 15.0), "utm");
    EXPECT_NE(reason.find("84 N"), std::string::npos) << reason;
    EXPECT_NE(reason.find("--crs"), std::string::npos) << reason;
  }
  EXPECT_EQ(unplacedReason({}, ""), "");
}

/** The owner of the map asks for coordinates, and would not see that they are missing. */
TEST(Georeference, SaysThatASystemIsOfNoUseWithoutAPlace)
{
  for (const char* crs : {"EPSG:25832", "utm"})
    EXPECT_NE(unplacedReason({}, crs).find("--control-points"), std::string::npos) << crs;
  EXPECT_EQ(unplacedReason(gnssAt(48.1, 11.6), "EPSG:25832"), "");
}

/** One height is wrong by what the geoid differs from the ellipsoid. */
TEST(Georeference, SaysWhichControlPointsWereLeftOut)
{
  const TemporaryFolder folder;
  std::ofstream(folder.file("points.csv")) << "name,map_x,map_y,map_z,latitude,longitude,height\n"
                                              "church,0,0,0,48.1,11.6,500\n"
                                              "bridge,0,111.195,0,48.101,11.6,500\n"
                                              "gate,0,222.39,0,48.102,11.6,500\n"
                                              "tower,0,333.585,0,48.103,11.6,546\n";
  const auto place = georeference({}, folder.file("points.csv"), "");
  ASSERT_TRUE(place);
  const std::string text = controlPointSentence(*place);
  EXPECT_EQ(text.find("control points: 3 of 4 agree, to 0."), 0U) << text;
  EXPECT_NE(text.find("; left out: tower (45.9"), std::string::npos) << text;
  EXPECT_EQ(controlPointSentence(Georeference{}), "");
}

template <typename T>
T valueAt(const std::string& bytes, std::size_t at)
{
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/** Coordinates of the points of a LAS 1.4 file, by the offsets of the standard. */
std::vector<Vec3> positionsIn(const std::string& las)
{
  constexpr std::size_t kPointsAt = 96, kRecordLength = 105, kScale = 131, kOffset = 155,
                        kCount = 247;
  std::vector<Vec3> positions(valueAt<std::uint64_t>(las, kCount));
  std::size_t at = valueAt<std::uint32_t>(las, kPointsAt);
  for (Vec3& position : positions)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto i = static_cast<std::size_t>(axis);
      position[axis] = valueAt<double>(las, kScale + 8 * i) *
                           static_cast<double>(valueAt<std::int32_t>(las, at + 4 * i)) +
                       valueAt<double>(las, kOffset + 8 * i);
    }
    at += valueAt<std::uint16_t>(las, kRecordLength);
  }
  return positions;
}

/** A linear projection of the whole tile would be off by 0.16 m in its corners. */
TEST(LasMap, IsProjectedExactlyWhateverTheSizeOfItsTiles)
{
  const TemporaryFolder folder;
  OutputMapOptions options;
  options.tile_size = 2000.0;
  options.directory = folder.path();
  OutputMap map(options);
  OutputPoints points;
  const std::vector<float> steps = {1.0F, 690.5F, 1380.25F, 1999.0F};
  for (const float x : steps)
    for (const float y : steps)
    {
      points.x.push_back(x);
      points.y.push_back(y);
      points.z.push_back(0.1F * x);
      points.intensity.push_back(1.0F);
      points.stamp_ns.push_back(1'700'000'000'000'000'000);
    }
  map.insert(points);
  ASSERT_EQ(map.size(), 16U);
  Georeference place;
  place.source = "GNSS";
  place.datum = {48.1, 11.6, 500.0};
  place.T_enu_map = {expSO3({0.01, -0.02, 0.7}), {100.0, -50.0, 3.0}};
  place.crs = "EPSG:32632";
  writeLasMap(folder.file("map.las"), map, place);

  const auto positions = positionsIn(contentOf(folder.file("map.las")));
  ASSERT_EQ(positions.size(), points.size());
  const ReferenceSystem system(place.crs);
  const LocalFrame frame(place.datum);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p(
        static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
        static_cast<double>(points.z[i]));
    const Vec3 expected = system.projectedOf(frame, place.T_enu_map * p);
    // Coordinates of the file are in millimetres.
    EXPECT_LT((positions[i] - expected).norm(), 1.5e-3) << i;
  }
}

}  // namespace
}  // namespace fastlio
