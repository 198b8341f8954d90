// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// LAS files as another program reads them.

#include "process.h"
#include "temporary_folder.h"
#include <fastlio/earth/gps_time.h>
#include <fastlio/earth/las_writer.h>
#include <fastlio/earth/reference_system.h>
#include <fastlio/options/number_text.h>

#include <cmath>
#include <cstdlib>
#include <vector>

namespace fastlio
{
namespace
{
using testing::TemporaryFolder;
constexpr std::int64_t kReadStamp = 1'700'000'000'123'456'789;  // 2023-11-14 22:13:20.123 UTC

class LasReadBack : public ::testing::Test
{
 protected:
  void SetUp() override
  {
    if (std::getenv("FASTLIO_NODE_MODULES") == nullptr ||
        run({"/usr/bin/env", "node", "--version"}).exit_status != 0)
      GTEST_SKIP() << "needs node, and FASTLIO_NODE_MODULES: a folder with npm's copc";
  }
  std::string read(const std::string& path)
  {
    const auto result =
        run({"/usr/bin/env", "node", FASTLIO_EARTH_TESTS_DIR "/read_las.cjs", path});
    EXPECT_EQ(result.exit_status, 0) << result.output;
    return result.output;
  }
  testing::ProcessResult run(const std::vector<std::string>& command)
  {
    return testing::Process(command, folder_.file("log")).wait();
  }
  /** The fields of a point that read_las.cjs prints. */
  static std::string row(const LasPoint& p)
  {
    return fixedText(p.position.x(), 4) + " " + fixedText(p.position.y(), 4) + " " +
           fixedText(p.position.z(), 4) + " " + fixedText(std::round(p.intensity), 0) +
           " 1 1 0 0 " + fixedText(adjustedGpsTime(p.stamp_ns), 7) + "\n";
  }

  TemporaryFolder folder_;
};

TEST_F(LasReadBack, AGeoreferencedMapByCopc)
{
  const GeodeticPoint munich{48.137, 11.575, 520};
  const LocalFrame frame(munich);
  const ReferenceSystem utm(utmCodeAt(munich));
  LasOptions options;
  options.wkt = utm.wkt();
  LasWriter writer(folder_.file("map.las"), options);
  std::string rows;
  Vec3 least = Vec3::Constant(1e9), most = -least;
  for (int i = 0; i < 1000; ++i)
  {
    LasPoint p;
    p.position = utm.projectedOf(frame, {i * 0.37, 200.0 - i, std::sin(i)});
    p.position = (p.position * 1e3).array().round() / 1e3;
    p.intensity = static_cast<float>(i % 256);
    p.stamp_ns = kReadStamp + i * 12'345'678LL;
    writer.add(p);
    rows += row(p);
    least = least.cwiseMin(p.position);
    most = most.cwiseMax(p.position);
  }
  writer.commit();
  const auto three = [](const Vec3& v)
  { return fixedText(v.x(), 4) + " " + fixedText(v.y(), 4) + " " + fixedText(v.z(), 4); };
  EXPECT_EQ(
      read(folder_.file("map.las")),
      "version 1.4 format 6 record 30 encoding 17\nsoftware mrpt_fastlio\ncreated 318 2023\n"
      "points 1000 returns 1000 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
      "scale 0.001 0.001 0.001 offset 691000 5334000 0\nmin " +
          three(least) + " max " + three(most) + "\nrecords 1\nwkt " + options.wkt + "\n" + rows);
}

TEST_F(LasReadBack, AMapWithoutAPlaceByCopc)
{
  LasWriter writer(folder_.file("map.las"), {});
  const std::vector<LasPoint> points = {
      {{-12.5, 3.25, -0.125}, 7, 2'000'000'000}, {{999.999, -999.999, 0}, 65535, 0}};
  for (const LasPoint& p : points)
    writer.add(p);
  writer.commit();
  const std::string text = read(folder_.file("map.las"));
  EXPECT_NE(text.find("created 1 1970\n"), std::string::npos) << text;
  EXPECT_NE(text.find("records 0\nwkt none\n" + row(points[0]) + row(points[1])), std::string::npos)
      << text;
}
}  // namespace
}  // namespace fastlio
