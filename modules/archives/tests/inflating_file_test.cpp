// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "test_files.h"
#include <fastlio/archives/inflating_file.h>

#include <gtest/gtest.h>

#include <random>
#include <zlib.h>

namespace
{
using namespace fastlio::testing;
using fastlio::FileEnd;
using fastlio::InflatingFile;

constexpr std::size_t kTrailer = 8;  // checksum and length behind each member

/** Runs and noise in turns: long matches, short ones, literals. */
std::string sampleBytes(std::size_t size, unsigned seed = 1)
{
  std::mt19937 random(seed);
  std::string bytes;
  while (bytes.size() < size)
  {
    const std::size_t run = 1 + random() % 300;
    const auto value = static_cast<char>(random());
    if (random() % 2 == 0)
      bytes.append(run, value);
    else
      for (std::size_t i = 0; i < run; ++i)
        bytes.push_back(static_cast<char>(random() % 256));
  }
  bytes.resize(size);
  return bytes;
}

struct Library
{
  const char* name;
  std::unique_ptr<fastlio::Inflater> (*make)();
};

struct Contents
{
  std::string bytes;
  FileEnd end = FileEnd::NotYet;
  std::uint64_t compressed = 0;
};

class InflatingFileWith : public ::testing::TestWithParam<Library>
{
 protected:
  void SetUp() override
  {
    if (!GetParam().make()) GTEST_SKIP() << GetParam().name << " is not built in";
  }

  Contents contentsOf(const std::string& file_bytes, std::size_t at_once = 10000)
  {
    const std::string name = folder_.file("file");
    write(name, file_bytes);
    InflatingFile file(name, GetParam().make());
    Contents contents;
    std::string part(at_once, '\0');
    while (file.end() == FileEnd::NotYet)
      contents.bytes.append(part, 0, file.read(part.data(), part.size()));
    contents.end = file.end();
    contents.compressed = file.compressedPosition();
    return contents;
  }

  void expectWhole(const std::string& file_bytes, const std::string& bytes)
  {
    const Contents contents = contentsOf(file_bytes);
    EXPECT_TRUE(contents.bytes == bytes);
    EXPECT_EQ(contents.end, FileEnd::Clean);
    EXPECT_EQ(contents.compressed, file_bytes.size());
  }

  TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(
    Libraries, InflatingFileWith,
    ::testing::Values(
        Library{"zlib", fastlio::makeZlibInflater}, Library{"ISAL", fastlio::makeIsalInflater}),
    [](const ::testing::TestParamInfo<Library>& library)
    { return std::string(library.param.name); });

TEST_P(InflatingFileWith, ReadsEveryKindOfBlock)
{
  for (const std::size_t size : {0, 1, 2, 1000, 70000, 1000000})
  {
    const std::string bytes = sampleBytes(size);
    for (const int level : {0, 1, 6, 9})
      expectWhole(gzip(bytes, level), bytes);
    for (const int strategy : {Z_FIXED, Z_HUFFMAN_ONLY, Z_RLE})
      expectWhole(gzip(bytes, 6, strategy), bytes);
  }
}

TEST_P(InflatingFileWith, GivesTheSameBytesHoweverManyAtOnce)
{
  const std::string bytes = sampleBytes(200000), file = gzip(bytes);
  for (const std::size_t at_once : {1, 7, 4096, 300000})
    EXPECT_TRUE(contentsOf(file, at_once).bytes == bytes) << at_once;
}

TEST_P(InflatingFileWith, SkipsAllThatAHeaderMayHold)
{
  const std::string bytes = sampleBytes(1000);
  std::string extra(300, 'x'), name = "log.rawlog", comment = "of a test";
  gz_header header = {};
  header.extra = reinterpret_cast<Bytef*>(extra.data());
  header.extra_len = static_cast<uInt>(extra.size());
  header.name = reinterpret_cast<Bytef*>(name.data());
  header.comment = reinterpret_cast<Bytef*>(comment.data());
  header.hcrc = 1;
  expectWhole(gzip(bytes, 6, Z_DEFAULT_STRATEGY, &header), bytes);
}

TEST_P(InflatingFileWith, ReadsMembersOneAfterTheOther)
{
  const std::string a = sampleBytes(3000, 1), b = sampleBytes(100000, 2);
  expectWhole(gzip(a) + gzip("") + gzip(b), a + b);
}

TEST_P(InflatingFileWith, ReadsAMemberThatBeginsAnywhereInTheBuffer)
{
  // Stored blocks: a byte more of data is a byte more of file. The first member ends about 65536.
  for (std::size_t size = 65470; size < 65530; ++size)
  {
    const std::string a = sampleBytes(size), b = "the second one";
    expectWhole(gzip(a, 0) + gzip(b), a + b);
  }
}

TEST_P(InflatingFileWith, LeavesAloneWhatFollowsAndIsNoMember)
{
  const std::string bytes = sampleBytes(3000);
  for (const std::string& rest : {std::string(512, '\0'), std::string("x"), std::string("\x1F")})
  {
    const Contents contents = contentsOf(gzip(bytes) + rest);
    EXPECT_TRUE(contents.bytes == bytes);
    EXPECT_EQ(contents.end, FileEnd::Clean);
  }
}

TEST_P(InflatingFileWith, ReadsPlainFiles)
{
  for (const std::size_t size : {0, 1, 2, 65536, 100000})
    expectWhole('p' + sampleBytes(size), 'p' + sampleBytes(size));
  expectWhole("\x1F", "\x1F");  // half of gzip's magic number
}

TEST_P(InflatingFileWith, ReportsAFileThatWasCut)
{
  const std::string bytes = sampleBytes(1500), whole = gzip(bytes);
  for (std::size_t length = 2; length < whole.size(); ++length)
  {
    const Contents contents = contentsOf(whole.substr(0, length));
    EXPECT_EQ(contents.end, FileEnd::Truncated) << length;
    EXPECT_EQ(contents.bytes, bytes.substr(0, contents.bytes.size())) << length;
    if (length + kTrailer >= whole.size())
    {
      EXPECT_EQ(contents.bytes.size(), bytes.size()) << length;
    }
  }
}

TEST_P(InflatingFileWith, ReportsAWrongChecksumAndGivesTheData)
{
  const std::string bytes = sampleBytes(1500);
  std::string wrong = gzip(bytes);
  wrong[wrong.size() - kTrailer] ^= 1;
  const Contents contents = contentsOf(wrong);
  EXPECT_EQ(contents.end, FileEnd::Corrupt);
  EXPECT_EQ(contents.bytes, bytes);
}

TEST_P(InflatingFileWith, ReportsDamageAndGivesWhatCameBefore)
{
  const std::string bytes = sampleBytes(300000), whole = gzip(bytes);
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i)
  {
    std::string wrong = whole;
    const std::size_t at = wrong.size() / 2 + random() % (wrong.size() / 2 - kTrailer);
    wrong[at] = static_cast<char>(wrong[at] ^ static_cast<char>(1U << (random() % 8)));
    const Contents contents = contentsOf(wrong);
    EXPECT_NE(contents.end, FileEnd::Clean) << at;
    // A quarter of the data lies safely before the middle of the file.
    EXPECT_EQ(contents.bytes.substr(0, bytes.size() / 4), bytes.substr(0, bytes.size() / 4)) << at;
  }
}

TEST(InflatingFile, ReportsAFileThatIsNotThere)
{
  EXPECT_THROW(InflatingFile("/nowhere/file"), std::runtime_error);
}

TEST(InflatingFile, ReportsAFolder)
{
  const TemporaryFolder folder;
  EXPECT_THROW(InflatingFile{folder.path()}, std::runtime_error);
}

}  // namespace
