// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "folder_listing.h"
#include <fastlio/files/gzip_file.h>

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <zlib.h>

namespace fastlio
{
namespace
{
using testing::TemporaryFolder;

std::string inflated(const std::string& path)
{
  gzFile file = gzopen(path.c_str(), "rb");
  std::string bytes, piece(10000, '\0');
  for (int size = 0; (size = gzread(file, piece.data(), 10000)) > 0;)
    bytes.append(piece, 0, static_cast<std::size_t>(size));
  EXPECT_EQ(gzclose(file), Z_OK) << "the file ends in the middle, or its checksum is wrong";
  return bytes;
}

/** Half of it is noise, which cannot be compressed, half of it repeats. */
std::string mixedBytes(std::size_t size)
{
  std::mt19937 generator(static_cast<std::mt19937::result_type>(size));
  std::string bytes(size, 'a');
  for (std::size_t i = 0; i < size; ++i)
    if (i % 2000 < 1000) bytes[i] = static_cast<char>(generator());
  return bytes;
}

// The lengths around that of the buffer, 64 KiB, end where the buffer ends.
TEST(GzipFile, InflatesToWhatWasWritten)
{
  const TemporaryFolder folder;
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{65535}, std::size_t{65536}, std::size_t{131072},
        std::size_t{3000000}})
    for (const std::size_t piece : {std::size_t{7919}, std::size_t{5000000}})
    {
      const std::string bytes = mixedBytes(size), path = folder.file("bytes.gz");
      GzipFile file(path);
      for (std::size_t done = 0; done < size; done += piece)
        file.write(std::string_view(bytes).substr(done, piece));
      const OutputFile written = file.commit();
      EXPECT_TRUE(inflated(path) == bytes) << size << " bytes in pieces of " << piece;
      EXPECT_EQ(written.bytes, testing::contentOf(path).size());
    }
}

TEST(GzipFile, IsMuchSmallerThanWhatRepeats)
{
  const TemporaryFolder folder;
  GzipFile file(folder.file("bytes.gz"));
  file.write(std::string(1000000, 'a'));
  EXPECT_LT(file.commit().bytes, 20000U);
}

// Noise stays as long as it is, so one of these files ends where the buffer ends.
TEST(GzipFile, EndsWhereTheBufferEnds)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("bytes.gz");
  std::mt19937 generator(5);
  std::string noise(65536, '\0');
  for (char& byte : noise)
    byte = static_cast<char>(generator());
  int ends = 0;
  for (std::size_t size = noise.size() - 120; size < noise.size(); ++size)
  {
    GzipFile file(path);
    file.write(std::string_view(noise).substr(0, size));
    ends += file.commit().bytes == 65536U ? 1 : 0;
    ASSERT_TRUE(inflated(path) == noise.substr(0, size)) << size << " bytes";
  }
  EXPECT_EQ(ends, 1);
}
}  // namespace
}  // namespace fastlio
