// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The cloud class with per-point time: its bytes, what it refuses, how columns go in and out.

#include "test_files.h"
#include <fastlio/compat/register_classes.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>

#include <cstring>
#include <string>

namespace
{
using fastlio::CloudColumns;
using fastlio::testing::serialize;
using mrpt::maps::CPointsMapXYZIRT;

CloudColumns threePoints()
{
  return {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, {0, 5, 65535}, {-0.05F, 0.0F, 0.05F},
          true};
}

void append(std::string& bytes, const void* data, std::size_t size)
{
  bytes.append(static_cast<const char*>(data), size);
}

template <typename T>
void appendValue(std::string& bytes, T value)
{
  append(bytes, &value, sizeof value);
}

template <typename T>
void appendColumn(std::string& bytes, const std::vector<T>& values)
{
  append(bytes, values.data(), values.size() * sizeof(T));
}

// The stream format, written out field by field.
std::string expectedBytes(const CloudColumns& c, std::int8_t options_version)
{
  std::string bytes;
  const std::string name = "mrpt::maps::CPointsMapXYZIRT";
  appendValue<std::uint8_t>(bytes, static_cast<std::uint8_t>(0x80U | name.size()));
  bytes += name;
  appendValue<std::uint8_t>(bytes, 0);
  appendValue<std::uint32_t>(bytes, static_cast<std::uint32_t>(c.size()));
  appendColumn(bytes, c.x);
  appendColumn(bytes, c.y);
  appendColumn(bytes, c.z);
  appendValue<std::uint32_t>(bytes, static_cast<std::uint32_t>(c.intensity.size()));
  appendColumn(bytes, c.intensity);
  appendValue<std::uint32_t>(bytes, static_cast<std::uint32_t>(c.ring.size()));
  appendColumn(bytes, c.ring);
  appendValue<std::uint32_t>(bytes, static_cast<std::uint32_t>(c.time.size()));
  appendColumn(bytes, std::vector<float>(c.time.begin(), c.time.end()));
  const CPointsMapXYZIRT defaults;
  const auto& insertion = defaults.insertionOptions;
  appendValue(bytes, options_version);
  appendValue(bytes, insertion.minDistBetweenLaserPoints);
  appendValue(bytes, insertion.addToExistingPointsMap);
  appendValue(bytes, insertion.also_interpolate);
  if (options_version == 0) appendValue(bytes, insertion.disableDeletion);
  appendValue(bytes, insertion.fuseWithExisting);
  appendValue(bytes, insertion.isPlanarMap);
  appendValue(bytes, insertion.horizontalTolerance);
  appendValue(bytes, insertion.maxDistForInterpolatePoints);
  appendValue(bytes, insertion.insertInvalidPoints);
  appendValue<std::int8_t>(bytes, 0);
  appendValue(bytes, defaults.likelihoodOptions.sigma_dist);
  appendValue(bytes, defaults.likelihoodOptions.max_corr_distance);
  appendValue(bytes, defaults.likelihoodOptions.decimation);
  appendValue<std::uint8_t>(bytes, 0x88);
  return bytes;
}

mrpt::serialization::CSerializable::Ptr objectFrom(const std::string& bytes)
{
  fastlio::registerBridgeClasses();
  mrpt::io::CMemoryStream stream;
  stream.assignMemoryNotOwn(bytes.data(), bytes.size());
  auto archive = mrpt::serialization::archiveFrom(stream);
  return archive.ReadObject();
}

void expectEqual(const CloudColumns& a, const CloudColumns& b)
{
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.z, b.z);
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.ring, b.ring);
  EXPECT_EQ(a.time, b.time);
}

CloudColumns readBack(const std::string& bytes)
{
  const auto cloud = std::dynamic_pointer_cast<CPointsMapXYZIRT>(objectFrom(bytes));
  EXPECT_TRUE(cloud);
  return cloud ? fastlio::readColumns(*cloud) : CloudColumns{};
}
}  // namespace

TEST(Xyzirt, BytesAreThoseOfTheFormat)
{
  EXPECT_EQ(serialize(*fastlio::makeXyzirt(threePoints())), expectedBytes(threePoints(), 0));
  EXPECT_EQ(serialize(*fastlio::makeXyzirt(CloudColumns{})), expectedBytes(CloudColumns{}, 0));
}

TEST(Xyzirt, ReadsBothVersionsOfTheInsertionOptions)
{
#if FASTLIO_MRPT_HAS_XYZIRT && !FASTLIO_MRPT_READS_NEWER_POINTS
  GTEST_SKIP() << "the native reader of this MRPT knows version 0 only";
#endif
  expectEqual(readBack(expectedBytes(threePoints(), 0)), threePoints());
  expectEqual(readBack(expectedBytes(threePoints(), 1)), threePoints());
}

TEST(Xyzirt, FieldsMayBeAbsent)
{
  CloudColumns columns = threePoints();
  columns.intensity.clear();
  columns.ring.clear();
  expectEqual(readBack(serialize(*fastlio::makeXyzirt(columns))), columns);
  columns.time.clear();
  expectEqual(readBack(serialize(*fastlio::makeXyzirt(columns))), columns);
}

TEST(Xyzirt, SurvivesInsideAnObservation)
{
  mrpt::obs::CObservationPointCloud observation;
  observation.sensorLabel = "lidar";
  observation.pointcloud = fastlio::makeXyzirt(threePoints());
  const auto read = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(
      objectFrom(serialize(observation)));
  ASSERT_TRUE(read && read->pointcloud);
  expectEqual(fastlio::readColumns(*read->pointcloud), threePoints());
}

TEST(Xyzirt, EveryTruncationThrows)
{
  const std::string bytes = serialize(*fastlio::makeXyzirt(threePoints()));
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_ANY_THROW(objectFrom(bytes.substr(0, length))) << "length " << length;
}

#if !FASTLIO_MRPT_HAS_XYZIRT
TEST(Xyzirt, HostileLengthsThrowWithoutAllocatingThem)
{
  const std::size_t header = 1 + std::strlen("mrpt::maps::CPointsMapXYZIRT") + 1;
  std::string bytes = serialize(*fastlio::makeXyzirt(threePoints()));
  const std::uint32_t hostile = 0xFFFFFFFFU;
  std::memcpy(bytes.data() + header, &hostile, sizeof hostile);
  EXPECT_THROW(objectFrom(bytes), std::exception);

  bytes = serialize(*fastlio::makeXyzirt(threePoints()));
  std::memcpy(bytes.data() + header + 4 + 3 * 3 * 4, &hostile, sizeof hostile);
  EXPECT_THROW(objectFrom(bytes), std::exception);
}
#endif

TEST(Xyzirt, PointColumnsBecomeSeconds)
{
  fastlio::PointColumns points;
  points.push_back(1, 2, 3, 4, 50'000'000, 7);
  points.push_back(1, 2, 3, 4, -50'000'000, 8);
  const CloudColumns columns = fastlio::readColumns(*fastlio::makeXyzirt(points));
  ASSERT_EQ(columns.time.size(), 2U);
  EXPECT_FLOAT_EQ(static_cast<float>(columns.time[0]), 0.05F);
  EXPECT_FLOAT_EQ(static_cast<float>(columns.time[1]), -0.05F);
  EXPECT_EQ(columns.ring, (std::vector<std::uint16_t>{7, 8}));
}

TEST(Xyzirt, UnequalColumnsAreRefused)
{
  CloudColumns columns = threePoints();
  columns.ring.pop_back();
  EXPECT_THROW((void)fastlio::makeXyzirt(columns), std::invalid_argument);
  columns = threePoints();
  columns.y.clear();
  EXPECT_THROW((void)fastlio::makeXyzirt(columns), std::invalid_argument);
}

TEST(Xyzirt, CopiesAndAppendsKeepTheFields)
{
  const auto cloud = fastlio::makeXyzirt(threePoints());
  const CPointsMapXYZIRT copy(*cloud);
  expectEqual(fastlio::readColumns(copy), threePoints());

  auto sum = CPointsMapXYZIRT::Create(*cloud);
  sum->insertAnotherMap(cloud.get(), mrpt::poses::CPose3D());
  const CloudColumns doubled = fastlio::readColumns(*sum);
  ASSERT_EQ(doubled.time.size(), 6U);
  EXPECT_EQ(doubled.time[5], 0.05F);
  EXPECT_EQ(doubled.ring[4], 5);
}

TEST(Xyzirt, ReadsTheFieldsOfOtherMaps)
{
  mrpt::maps::CPointsMapXYZI bright;
  bright.resize(1);
  bright.setPointFast(0, 1, 2, 3);
  bright.setPointIntensity(0, 0.5F);
  const CloudColumns columns = fastlio::readColumns(bright);
  EXPECT_EQ(columns.intensity, std::vector<float>{0.5F});
  EXPECT_TRUE(columns.time.empty());

  mrpt::maps::CSimplePointsMap plain;
  plain.insertPoint(1, 2, 3);
  EXPECT_EQ(fastlio::readColumns(plain).z, std::vector<float>{3});
}
