// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Reading rawlogs: formats, order, progress.

#include "rawlog_reading.h"
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <filesystem>
#include <sys/stat.h>

namespace
{
using namespace fastlio::testing;
using fastlio::RawlogSource;
using fastlio::ReadProblemKind;

class RawlogSourceTest : public RawlogTest
{
};
}  // namespace

TEST_F(RawlogSourceTest, ReadsPlainGzipAndZstandard)
{
  const std::string bytes = serialize(samples(10));
  for (const std::string& content :
       {bytes, gzip(bytes), gzip(bytes.substr(0, 700)) + gzip(bytes.substr(700)), zstd(bytes),
        zstd(bytes.substr(0, 700)) + zstd(bytes.substr(700))})
  {
    const Reading reading = readAll({fileOf(content)});
    EXPECT_EQ(reading.seconds.size(), 10U);
    EXPECT_TRUE(reading.problems.empty()) << reading.problems.front().message;
  }
}

TEST_F(RawlogSourceTest, TakesSensoryFramesApartAndSkipsActions)
{
  std::vector<Object> objects;
  for (int i = 0; i < 3; ++i)
  {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(imuAt(i, "a"));
    frame->insert(imuAt(i, "b"));
    objects.push_back(mrpt::obs::CActionCollection::Create());
    objects.push_back(frame);
  }
  const Reading reading = readAll({fileOf(gzip(serialize(objects)))});
  EXPECT_EQ(reading.labels, (std::vector<std::string>{"a", "b", "a", "b", "a", "b"}));
  EXPECT_TRUE(reading.problems.empty());
}

TEST_F(RawlogSourceTest, ReadsFilesInTheOrderGiven)
{
  write(folder_.file("1"), serialize({imuAt(0), imuAt(1)}));
  write(folder_.file("2"), gzip(serialize({imuAt(2), imuAt(3)})));
  const Reading reading = readAll({folder_.file("1"), folder_.file("2")});
  EXPECT_EQ(reading.seconds, (std::vector<double>{0, 1, 2, 3}));
}

TEST_F(RawlogSourceTest, AMissingFileDoesNotStopTheNext)
{
  write(folder_.file("2"), serialize({imuAt(2)}));
  const Reading reading = readAll({folder_.file("1"), folder_.path(), folder_.file("2")});
  EXPECT_EQ(reading.seconds.size(), 1U);
  ASSERT_EQ(reading.problems.size(), 2U);
  EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::NotFound);
  EXPECT_EQ(reading.problems[0].file, folder_.file("1"));
  EXPECT_EQ(reading.problems[1].kind, ReadProblemKind::NotFound);
  const std::string& of_folder = reading.problems[1].message;
  for (const char* part : {"no recording was found", "rawlog", "bag", "pcap", "PCD"})
    EXPECT_NE(of_folder.find(part), std::string::npos) << part << " is not in " << of_folder;
}

TEST_F(RawlogSourceTest, ARecordingThatCannotBeOpenedDoesNotStopTheNext)
{
  write(folder_.file("1"), "#ROSBAG V1.2\n");
  write(folder_.file("2"), serialize({imuAt(2)}));
  const Reading reading = readAll({folder_.file("1"), folder_.file("2")});
  EXPECT_EQ(reading.seconds.size(), 1U);
  ASSERT_EQ(reading.problems.size(), 1U);
  EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::NotSupported);
  EXPECT_NE(reading.problems[0].message.find("another version"), std::string::npos);
}

TEST_F(RawlogSourceTest, SortsWithinTheWindow)
{
  const std::string file = fileOf(serialize(
      {imuAt(1.0, "a"), imuAt(1.1, "a"), imuAt(1.0, "b"), imuAt(0.95, "b"), imuAt(2.0, "a"),
       imuAt(0.5, "late"), imuAt(3.0, "a")}));
  EXPECT_EQ(readAll({file}).seconds, (std::vector<double>{0.95, 1.0, 1.0, 1.1, 0.5, 2.0, 3.0}));
  EXPECT_EQ(
      readAll({file}).labels, (std::vector<std::string>{"b", "a", "b", "a", "late", "a", "a"}));
  EXPECT_EQ(
      readAll({file}, {0.0}).seconds, (std::vector<double>{1.0, 1.1, 1.0, 0.95, 2.0, 0.5, 3.0}));
}

TEST_F(RawlogSourceTest, StampsThatJumpBackOrMakeNoSenseLoseNothing)
{
  auto objects = samples(50);
  for (int i = 0; i < 50; ++i)
    objects.push_back(imuAt(-3600 + 0.005 * i));
  objects.insert(objects.begin() + 20, imuAt(1e6));
  auto unset = imuAt(0);
  unset->timestamp = INVALID_TIMESTAMP;
  objects.insert(objects.begin() + 10, unset);
  auto absurd = imuAt(0);
  absurd->timestamp = mrpt::Clock::time_point::max();
  objects.push_back(absurd);
  EXPECT_EQ(readAll({fileOf(serialize(objects))}).seconds.size(), 103U);
}

TEST_F(RawlogSourceTest, MemoryIsBoundedWhereTimeStandsStill)
{
  std::vector<Object> objects(5000, imuAt(1.0));
  EXPECT_EQ(readAll({fileOf(gzip(serialize(objects)))}).seconds.size(), 5000U);
}

TEST_F(RawlogSourceTest, ExternalCloudsAreLoadedFromBesideTheFile)
{
  std::filesystem::create_directory(folder_.file("log_Images"));
  const auto points = fastlio::makeXyzirt(fastlio::CloudColumns{{1}, {2}, {3}, {4}, {5}, {0.5F}});
  write(folder_.file("log_Images/scan.bin"), gzip(serialize({points})));
  const auto cloudIn = [](const std::string& file)
  {
    auto cloud = mrpt::obs::CObservationPointCloud::Create();
    cloud->timestamp = fastlio::toMrptTime(kStart);
    cloud->setAsExternalStorage(
        file, mrpt::obs::CObservationPointCloud::ExternalStorageFormat::MRPT_Serialization);
    return cloud;
  };
  RawlogSource source({fileOf(serialize({cloudIn("scan.bin"), cloudIn("gone.bin")}))});
  const auto read = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(source.next());
  ASSERT_TRUE(read && read->pointcloud) << source.problems().front().message;
  EXPECT_EQ(fastlio::readColumns(*read->pointcloud).time, std::vector<double>{0.5});
  EXPECT_EQ(source.next(), nullptr);
  ASSERT_EQ(source.problems().size(), 1U);
  EXPECT_EQ(source.problems()[0].kind, ReadProblemKind::ExternalFile);
  EXPECT_NE(source.problems()[0].message.find("gone.bin"), std::string::npos);
}

namespace
{
Object cloudInFile(const std::string& file)
{
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  cloud->sensorLabel = "lidar";
  cloud->timestamp = fastlio::toMrptTime(kStart);
  cloud->setAsExternalStorage(
      file, mrpt::obs::CObservationPointCloud::ExternalStorageFormat::KittiBinFile);
  return cloud;
}
}  // namespace

/** A recording names files: of its own folder, and nothing that could block. */
TEST_F(RawlogSourceTest, ExternalFilesElsewhereAreNotTouched)
{
  namespace fs = std::filesystem;
  const fs::path own = fs::path(folder_.path()) / "log_Images";
  fs::create_directory(own);
  fs::create_directory(own / "folder");
  fs::create_directory(fs::path(folder_.path()) / "log_Images2");
  const std::vector<float> kitti{1, 2, 3, 0.5F};
  const std::string points(
      reinterpret_cast<const char*>(kitti.data()), kitti.size() * sizeof(float));
  for (const char* name : {"secret.bin", "log_Images/own.bin", "log_Images2/other.bin"})
    write(folder_.file(name), points);
  fs::create_symlink(folder_.file("secret.bin"), own / "link.bin");
  fs::create_symlink(folder_.path(), own / "up");
  fs::create_symlink("own.bin", own / "alias.bin");
  ASSERT_EQ(mkfifo((own / "pipe.bin").c_str(), 0600), 0);
  for (const std::string& name :
       {folder_.file("secret.bin"), std::string("../secret.bin"), std::string("/dev/zero"),
        std::string("/dev/stdin"), std::string("link.bin"), std::string("up/secret.bin"),
        std::string("pipe.bin"), std::string("../log_Images2/other.bin"), std::string("folder"),
        std::string("folder/../../secret.bin"), std::string("."), std::string("gone/own.bin"),
        std::string(2000, 'a'), std::string("own.bin\0.txt", 12), std::string("/proc/self/fd/0")})
  {
    RawlogSource source({fileOf(serialize({cloudInFile(name)}))});
    EXPECT_EQ(source.next(), nullptr) << name;
    ASSERT_EQ(source.problems().size(), 1U) << name;
    EXPECT_EQ(source.problems()[0].kind, ReadProblemKind::ExternalFile) << name;
    EXPECT_LT(source.problems()[0].message.size(), 2000U);
  }
  for (const std::string& name :
       {std::string("own.bin"), std::string("alias.bin"), std::string("folder/../own.bin"),
        (own / "own.bin").string()})
  {
    RawlogSource source({fileOf(serialize({cloudInFile(name)}))});
    EXPECT_NE(source.next(), nullptr) << name << source.problems().front().message;
  }
}

TEST_F(RawlogSourceTest, ExternalFilesOfAnySizeAreBounded)
{
  std::filesystem::create_directory(folder_.file("log_Images"));
  write(folder_.file("log_Images/hole.bin"), "");
  std::filesystem::resize_file(folder_.file("log_Images/hole.bin"), 20'000'000'000);
  const std::string zeros = gzip(std::string(std::size_t{64} << 20U, '\0'));
  std::string bomb;
  for (int i = 0; i < 20; ++i)
    bomb += zeros;
  write(folder_.file("log_Images/bomb.bin.gz"), bomb);
  for (const char* name : {"hole.bin", "bomb.bin.gz"})
  {
    RawlogSource source({fileOf(serialize({cloudInFile(name)}))});
    EXPECT_EQ(source.next(), nullptr);
    ASSERT_EQ(source.problems().size(), 1U);
    EXPECT_NE(source.problems()[0].message.find("larger than 256 MiB"), std::string::npos)
        << source.problems()[0].message;
  }
}

TEST_F(RawlogSourceTest, PipesAndDevicesAreRefusedAtOnce)
{
  ASSERT_EQ(mkfifo(folder_.file("pipe").c_str(), 0600), 0);
  for (const std::string& name : {folder_.file("pipe"), std::string("/dev/zero"), std::string("-")})
  {
    const Reading reading = readAll({name});
    ASSERT_EQ(reading.problems.size(), 1U) << name;
    EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::NotFound);
    EXPECT_NE(reading.problems[0].message.find("save it to a file first"), std::string::npos)
        << reading.problems[0].message;
  }
}

TEST_F(RawlogSourceTest, ExternalCloudsOfEveryFormatAreLoaded)
{
  using Format = mrpt::obs::CObservationPointCloud::ExternalStorageFormat;
  std::filesystem::create_directory(folder_.file("log_Images"));
  const auto file = [&](const std::string& name) { return folder_.file("log_Images/" + name); };
  const std::vector<float> kitti{1, 2, 3, 0.5F, 4, 5, 6, 0.25F};
  write(
      file("scan.bin"),
      {reinterpret_cast<const char*>(kitti.data()), kitti.size() * sizeof(float)});
  write(file("places.txt"), "1 2 3\n4 5 6\n");
  write(file("bright.txt"), "1 2 3 0.5\n4 5 6 0.25\n");
  std::vector<Object> objects;
  for (const auto& [name, format] :
       {std::pair{"scan.bin", Format::KittiBinFile},
        {"bright.txt", Format::PlainTextFile},
        {"places.txt", Format::PlainTextFile}})
  {
    auto cloud = mrpt::obs::CObservationPointCloud::Create();
    cloud->timestamp = fastlio::toMrptTime(kStart);
    cloud->setAsExternalStorage(name, format);
    objects.push_back(cloud);
  }
  RawlogSource source({fileOf(serialize(objects))});
  for (const bool bright : {true, true, false})
  {
    const auto read = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(source.next());
    ASSERT_TRUE(read && read->pointcloud) << source.problems().front().message;
    const fastlio::CloudColumns columns = fastlio::readColumns(*read->pointcloud);
    EXPECT_EQ(columns.x, (std::vector<float>{1, 4}));
    EXPECT_EQ(columns.z, (std::vector<float>{3, 6}));
    if (bright)
    {
      EXPECT_EQ(columns.intensity, (std::vector<float>{0.5F, 0.25F}));
    }
    EXPECT_TRUE(columns.time.empty());
  }
}

TEST_F(RawlogSourceTest, ExternalTextsOfTwoNumbersPerRowAreNoPlaces)
{
  std::filesystem::create_directory(folder_.file("log_Images"));
  write(folder_.file("log_Images/flat.txt"), "1 2\n3 4\n");
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  cloud->timestamp = fastlio::toMrptTime(kStart);
  cloud->setAsExternalStorage(
      "flat.txt", mrpt::obs::CObservationPointCloud::ExternalStorageFormat::PlainTextFile);
  RawlogSource source({fileOf(serialize({cloud}))});
  EXPECT_EQ(source.next(), nullptr);
  ASSERT_EQ(source.problems().size(), 1U);
  EXPECT_NE(source.problems()[0].message.find("rows of 2 numbers"), std::string::npos)
      << source.problems()[0].message;
}

TEST_F(RawlogSourceTest, ProgressReachesTheSizeOfTheFiles)
{
  const std::string content = gzip(serialize(samples(1000)));
  RawlogSource source({fileOf(content)});
  EXPECT_EQ(source.progress().bytes_total, content.size());
  while (source.next())
  {
    EXPECT_LE(source.progress().bytes_read, content.size());
  }
  EXPECT_EQ(source.progress().bytes_read, content.size());
}

TEST(RawlogSourceOptions, AreChecked)
{
  EXPECT_THROW(RawlogSource({}), std::invalid_argument);
  EXPECT_THROW(RawlogSource({"a"}, {-1.0}), std::invalid_argument);
}
