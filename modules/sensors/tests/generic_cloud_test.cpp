// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The cloud class with named fields: every version of its stream, what it refuses, what is read.

#include "bridge_recording.h"
#include "rawlog_reading.h"
#include <fastlio/compat/CGenericPointsMap.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <cmath>
#include <cstring>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;
using mrpt::maps::CGenericPointsMap;

template <typename T>
void append(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void putText(std::string& bytes, const std::string& text)
{
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

template <typename T>
void putField(std::string& bytes, const std::string& name, const std::vector<T>& values)
{
  append(bytes, std::uint32_t{1});
  putText(bytes, name);
  append(bytes, static_cast<std::uint32_t>(values.size()));
  for (const T value : values)
    append(bytes, value);
}

/** A cloud of two points as MRPT of the given stream version writes it. */
std::string cloudBytes(std::uint8_t version, std::int8_t options_version)
{
  const std::string name = "mrpt::maps::CGenericPointsMap";
  std::string bytes;
  append(bytes, static_cast<std::uint8_t>(0x80U | name.size()));
  bytes += name;
  append(bytes, version);
  append(bytes, std::uint32_t{2});
  for (const float coordinate : {1.F, 2.F, 3.F, 4.F, 5.F, 6.F})
    append(bytes, coordinate);
  putField<float>(bytes, "intensity", {0.5F, 1.0F});
  if (version >= 1) putField<double>(bytes, "timestamp", {1.7e9, 1.7e9 + 0.1});
  putField<std::uint16_t>(bytes, "ring", {7, 8});
  if (version >= 2) putField<std::uint8_t>(bytes, "tag", {1, 2});
  if (version >= 4) putField<std::uint32_t>(bytes, "t", {0, 99'000'000});
  const mrpt::maps::CSimplePointsMap defaults;
  const auto& o = defaults.insertionOptions;
  append(bytes, options_version);
  append(bytes, o.minDistBetweenLaserPoints);
  append(bytes, o.addToExistingPointsMap);
  append(bytes, o.also_interpolate);
  if (options_version == 0) append(bytes, false);
  append(bytes, o.fuseWithExisting);
  append(bytes, o.isPlanarMap);
  append(bytes, o.horizontalTolerance);
  append(bytes, o.maxDistForInterpolatePoints);
  append(bytes, o.insertInvalidPoints);
  append(bytes, std::int8_t{0});
  append(bytes, defaults.likelihoodOptions.sigma_dist);
  append(bytes, defaults.likelihoodOptions.max_corr_distance);
  append(bytes, defaults.likelihoodOptions.decimation);
  append(bytes, std::uint8_t{0x88});
  return bytes;
}

/** An observation with that cloud: a plain one whose cloud is exchanged. */
std::string observationBytes(const std::string& cloud)
{
  auto observation = cloudAt(0);
  const std::string inner = serialize({observation->pointcloud});
  std::string bytes = serialize({observation});
  const auto at = bytes.find(inner);
  EXPECT_NE(at, std::string::npos);
  return bytes.replace(at, inner.size(), cloud);
}

class GenericCloud : public BridgeTest
{
 protected:
  CloudColumns columnsOf(const std::string& cloud)
  {
    const std::string file = folder_.file("generic.rawlog");
    write(file, observationBytes(cloud));
    RawlogSource source({file});
    const auto observation =
        std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(source.next());
    problems_ = source.problems();
    return observation ? readColumns(*observation->pointcloud) : CloudColumns{};
  }

  std::vector<ReadProblem> problems_;
};
}  // namespace

TEST_F(GenericCloud, EveryVersionOfTheStreamIsRead)
{
#if FASTLIO_MRPT_HAS_GENERIC_MAP
  const int newest = 3;
#else
  const int newest = 4;
#endif
  for (int version = 0; version <= newest; ++version)
    for (const std::int8_t options : {std::int8_t{0}, std::int8_t{1}})
    {
      const CloudColumns columns =
          columnsOf(cloudBytes(static_cast<std::uint8_t>(version), options));
      EXPECT_TRUE(problems_.empty()) << problems_.front().message;
      EXPECT_EQ(columns.x, (std::vector<float>{1, 2}));
      EXPECT_EQ(columns.z, (std::vector<float>{5, 6}));
      EXPECT_EQ(columns.intensity, (std::vector<float>{0.5F, 1.0F}));
      EXPECT_EQ(columns.ring, (std::vector<std::uint16_t>{7, 8}));
      EXPECT_FALSE(columns.single_precision_time);
      const std::vector<double> dates{1.7e9, 1.7e9 + 0.1}, offsets{0, 99'000'000}, none;
      EXPECT_EQ(columns.time, version == 0 ? none : version == 4 ? offsets : dates) << version;
    }
}

TEST_F(GenericCloud, TruncationAndHostileLengthsAreProblems)
{
  const std::string whole = cloudBytes(3, 1);
  const std::size_t header = 1 + std::strlen("mrpt::maps::CGenericPointsMap") + 1;
  for (const std::size_t at : {header, header + 4 + 24, header + 4 + 24 + 4 + 4 + 9})
  {
    std::string hostile = whole;
    const std::uint32_t length = 0xFFFFFFF0U;
    std::memcpy(hostile.data() + at, &length, sizeof length);
    EXPECT_EQ(columnsOf(hostile).size(), 0U);
    EXPECT_EQ(problems_.size(), 1U) << at;
  }
  std::string unequal = whole;
  const std::uint32_t three = 3;
  std::memcpy(unequal.data() + header + 4 + 24 + 4 + 4 + 9, &three, sizeof three);
  EXPECT_EQ(columnsOf(unequal).size(), 0U);
  for (std::size_t length = header; length < whole.size(); length += 7)
  {
    const std::string file = folder_.file("cut.rawlog");
    const std::string bytes = observationBytes(whole);
    write(file, bytes.substr(0, bytes.size() - (whole.size() - length)));
    RawlogSource source({file});
    EXPECT_FALSE(source.next());
    EXPECT_FALSE(source.problems().empty());
  }
}

#if !FASTLIO_MRPT_HAS_GENERIC_MAP
TEST_F(GenericCloud, NumbersOfLinesThatAreNoneAreZero)
{
  CGenericPointsMap map;
  map.resize(4);
  map.float_fields["ring"] = {NAN, -1.0F, 70000.0F, 3.0F};
  map.double_fields["time_stamp"] = {1, 2, 3, 4};
  const CloudColumns columns = readColumns(map);
  EXPECT_EQ(columns.ring, (std::vector<std::uint16_t>{0, 0, 0, 3}));
  EXPECT_EQ(columns.time, (std::vector<double>{1, 2, 3, 4}));  // one of the usual names
}

TEST_F(GenericCloud, WritesWhatItReads)
{
  auto map = CGenericPointsMap::Create();
  map->resize(2);
  map->setPointFast(0, 1, 2, 3);
  map->setPointFast(1, 4, 5, 6);
  map->float_fields["t"] = {0.0F, 0.1F};
  map->uint16_fields["ring"] = {3, 4};
  const CloudColumns columns = columnsOf(serialize({map}));
  EXPECT_EQ(columns.y, (std::vector<float>{2, 5}));
  EXPECT_EQ(columns.time[1], static_cast<double>(0.1F));
  EXPECT_TRUE(columns.single_precision_time);

  const CGenericPointsMap copy(*map);
  EXPECT_EQ(readColumns(copy).ring, (std::vector<std::uint16_t>{3, 4}));
  map->insertAnotherMap(&copy, mrpt::poses::CPose3D());
  // Where MRPT copies points itself it leaves out what it does not know.
  const std::vector<std::uint16_t> appended = FASTLIO_MRPT_COPIES_POINTS_ITSELF
                                                  ? std::vector<std::uint16_t>{3, 4, 0, 0}
                                                  : std::vector<std::uint16_t>{3, 4, 3, 4};
  EXPECT_EQ(readColumns(*map).ring, appended);
  map->insertPoint(7, 8, 9);
  EXPECT_EQ(readColumns(*map).ring.back(), 0);
  map->uint32_fields["n"].resize(5);  // a type that only later versions have
  EXPECT_EQ(columnsOf(serialize({map})).size(), 5U);
}
#endif
