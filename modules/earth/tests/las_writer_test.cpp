// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "las_bytes.h"
#include "las_points.h"

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace fastlio
{
namespace
{
using testing::contentOf;
using testing::kStamp;
using testing::point;
using testing::TemporaryFolder;
using testing::written;

template <typename Number>
Number numberAt(const std::string& bytes, std::size_t offset)
{
  Number number{};
  std::memcpy(&number, bytes.data() + offset, sizeof number);  // the tests run on little-endian
  return number;
}

TEST(LasWriter, HeaderHoldsWhatTheFormatWants)
{
  const TemporaryFolder folder;
  const std::string wkt = "PROJCS[\"x\"]";
  LasOptions options;
  options.wkt = wkt;
  const std::string bytes = written(folder, options, 100);
  const std::size_t points_at = 375 + 54 + wkt.size() + 1;
  ASSERT_EQ(bytes.size(), points_at + std::size_t{100} * 30);
  EXPECT_EQ(bytes.substr(0, 4), "LASF");
  EXPECT_EQ(numberAt<std::uint16_t>(bytes, 6), 0b10001);
  EXPECT_EQ(bytes.substr(24, 2), std::string("\x01\x04"));
  EXPECT_EQ(numberAt<std::uint16_t>(bytes, 90), 318);
  EXPECT_EQ(numberAt<std::uint16_t>(bytes, 92), 2023);
  EXPECT_EQ(numberAt<std::uint16_t>(bytes, 94), 375);
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 96), points_at);
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 100), 1U);
  EXPECT_EQ(numberAt<std::uint8_t>(bytes, 104), 6);
  EXPECT_EQ(numberAt<std::uint16_t>(bytes, 105), 30);
  EXPECT_EQ(bytes.substr(107, 24), std::string(24, '\0'));
  EXPECT_EQ(numberAt<double>(bytes, 155), 691'000);
  EXPECT_EQ(numberAt<double>(bytes, 163), 5'334'000);
  EXPECT_EQ(numberAt<double>(bytes, 171), 0);
  EXPECT_NEAR(numberAt<double>(bytes, 179), 691'099, 1e-9);
  EXPECT_NEAR(numberAt<double>(bytes, 187), 691'000, 1e-9);
  EXPECT_NEAR(numberAt<double>(bytes, 195), 5'334'000.25, 1e-9);
  EXPECT_EQ(numberAt<std::uint64_t>(bytes, 247), 100U);
  EXPECT_EQ(numberAt<std::uint64_t>(bytes, 255), 100U);
  EXPECT_EQ(numberAt<std::uint64_t>(bytes, 263), 0U);
  EXPECT_EQ(bytes.substr(375 + 2, 16), std::string("LASF_Projection") + '\0');
  EXPECT_EQ(bytes.substr(375 + 54, wkt.size() + 1), wkt + '\0');
}

TEST(LasWriter, CountsPassThirtyTwoBits)
{
  LasHeader header;
  header.points = (std::uint64_t{1} << 33U) + 5;
  const std::string bytes = lasHeaderBytes(header);
  ASSERT_EQ(bytes.size(), 375U);
  EXPECT_EQ(numberAt<std::uint64_t>(bytes, 247), header.points);
  EXPECT_EQ(numberAt<std::uint64_t>(bytes, 255), header.points);
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 107), 0U);
}

TEST(LasWriter, BoundsAreThoseOfThePointsAsTheyAreStored)
{
  const TemporaryFolder folder;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> metres(-300, 300);
  LasWriter writer(folder.file("map.las"), {});
  std::vector<LasPoint> points;
  points.reserve(5000);
  for (int i = 0; i < 5000; ++i)
  {
    points.push_back(point(691e3 + metres(random), 5334e3 + metres(random), metres(random)));
    writer.add(points.back());
  }
  writer.commit();
  const std::string bytes = contentOf(folder.file("map.las"));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto scale = numberAt<double>(bytes, 131 + 8 * axis);
    const auto offset = numberAt<double>(bytes, 155 + 8 * axis);
    double least = 1e9, most = -1e9;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto steps = numberAt<std::int32_t>(bytes, 375 + 30 * i + 4 * axis);
      const double stored = steps * scale + offset;
      EXPECT_NEAR(stored, points[i].position[static_cast<int>(axis)], 0.0005 + 1e-9);
      least = std::min(least, stored);
      most = std::max(most, stored);
    }
    EXPECT_EQ(numberAt<double>(bytes, 179 + 16 * axis), most);
    EXPECT_EQ(numberAt<double>(bytes, 187 + 16 * axis), least);
  }
}

TEST(LasWriter, IntensitiesAreScaledAndLimited)
{
  const TemporaryFolder folder;
  LasOptions options;
  options.intensity_scale = 256;
  LasWriter writer(folder.file("map.las"), options);
  const std::vector<std::pair<float, int>> cases = {
      {0.0F, 0}, {1.0F, 256}, {255.0F, 65280}, {300.0F, 65535}, {-5.0F, 0}, {NAN, 0}, {0.01F, 3}};
  for (const auto& one : cases)
    writer.add({{1, 2, 3}, one.first, kStamp});
  writer.commit();
  const std::string bytes = contentOf(folder.file("map.las"));
  for (std::size_t i = 0; i < cases.size(); ++i)
    EXPECT_EQ(numberAt<std::uint16_t>(bytes, 375 + 30 * i + 12), cases[i].second) << i;
}

TEST(LasWriter, AnEmptyMapIsAFile)
{
  const TemporaryFolder folder;
  const std::string bytes = written(folder, {}, 0);
  ASSERT_EQ(bytes.size(), 375U);
  EXPECT_EQ(numberAt<std::uint64_t>(bytes, 247), 0U);
  EXPECT_EQ(numberAt<double>(bytes, 179), 0.0);
  EXPECT_EQ(numberAt<std::uint16_t>(bytes, 92), 0);
}

TEST(LasWriter, SamePointsMakeTheSameBytes)
{
  const TemporaryFolder folder;
  const std::string once = written(folder, {}, 1000);
  EXPECT_EQ(written(folder, {}, 1000), once);
}
}  // namespace
}  // namespace fastlio
