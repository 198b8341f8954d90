// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "temporary_folder.h"
#include <fastlio/submaps/submap_store.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;
using testing::TemporaryFolder;

constexpr std::size_t kPlanes = 100;  // of each submap

SubmapSurfaces surfacesOf(unsigned submap)
{
  std::mt19937 random(submap);
  std::uniform_real_distribution<float> number(-50.0F, 50.0F);
  SubmapSurfaces surfaces;
  for (std::size_t i = 0; i < kPlanes; ++i)
  {
    VoxelPlane plane;
    plane.nx = number(random);
    plane.qz = number(random);
    plane.leverage[5] = number(random);
    plane.created_insertion = static_cast<std::uint32_t>(random());
    surfaces.planes.push_back(plane);
    surfaces.spreads.push_back(number(random));
  }
  return surfaces;
}

bool isOf(unsigned submap, const SubmapSurfaces& surfaces)
{
  const SubmapSurfaces expected = surfacesOf(submap);
  const auto same = [](const VoxelPlane& a, const VoxelPlane& b)
  {
    return a.nx == b.nx && a.qz == b.qz && a.leverage == b.leverage &&
           a.created_insertion == b.created_insertion;
  };
  return surfaces.spreads == expected.spreads &&
         std::equal(
             surfaces.planes.begin(), surfaces.planes.end(), expected.planes.begin(),
             expected.planes.end(), same);
}

/** All files below a folder. */
std::vector<fs::path> filesIn(const TemporaryFolder& folder)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    if (entry.is_regular_file()) files.push_back(entry.path());
  return files;
}

/** So many submaps, of which three may stay in memory. */
class ThreeInMemory : public ::testing::Test
{
 protected:
  static constexpr unsigned kSubmaps = 10;

  void fill()
  {
    for (unsigned i = 0; i < kSubmaps; ++i)
    {
      submaps_.emplace_back(store_, surfacesOf(i));
      most_ = std::max(most_, store_->planesInMemory());
    }
  }

  TemporaryFolder folder_;
  std::shared_ptr<SubmapStore> store_ =
      std::make_shared<SubmapStore>(SubmapStoreOptions{3 * kPlanes + 1, folder_.path()});
  std::vector<StoredSurfaces> submaps_;
  std::size_t most_ = 0;
};

TEST_F(ThreeInMemory, AllComeBackAndTheBoundIsKept)
{
  fill();
  EXPECT_EQ(filesIn(folder_).size(), kSubmaps - 3);
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i)
  {
    const auto submap = static_cast<unsigned>(random() % kSubmaps);
    EXPECT_TRUE(isOf(submap, *submaps_[submap].get())) << submap;
    EXPECT_EQ(submaps_[submap].planes(), kPlanes);
    most_ = std::max(most_, store_->planesInMemory());
  }
  EXPECT_EQ(most_, 3 * kPlanes);
  EXPECT_TRUE(store_->troubles().not_written.empty());
  EXPECT_TRUE(store_->troubles().not_read.empty());
}

TEST_F(ThreeInMemory, ThoseThatAreUsedStay)
{
  fill();
  (void)submaps_[0].get();
  for (unsigned i = 1; i < kSubmaps; ++i)
  {
    (void)submaps_[i].get();
    (void)submaps_[0].get();
  }
  // Whatever happens to their files.
  for (const fs::path& file : filesIn(folder_))
    fs::remove(file);
  EXPECT_TRUE(isOf(0, *submaps_[0].get()));
  EXPECT_TRUE(isOf(kSubmaps - 1, *submaps_[kSubmaps - 1].get()));
  EXPECT_EQ(store_->troubles().lost, 0U);
}

TEST_F(ThreeInMemory, WhatIsHeldStaysValid)
{
  fill();
  const auto held = submaps_[4].get();
  for (const StoredSurfaces& submap : submaps_)
    (void)submap.get();
  EXPECT_TRUE(isOf(4, *held));
}

TEST_F(ThreeInMemory, NothingIsLeft)
{
  fill();
  const StoredSurfaces copy = submaps_.front();
  const std::size_t files = filesIn(folder_).size();
  submaps_.erase(submaps_.begin(), submaps_.begin() + 4);
  EXPECT_EQ(filesIn(folder_).size(), files - 3) << "the first one has a copy";
  EXPECT_TRUE(isOf(0, *copy.get()));
  submaps_.clear();
  EXPECT_EQ(store_->planesInMemory(), kPlanes);
  store_.reset();
  EXPECT_TRUE(isOf(0, *copy.get())) << "the store lives as long as its surfaces";
}

TEST(SubmapStore, RemovesItsFolder)
{
  const TemporaryFolder folder;
  {
    const auto store = std::make_shared<SubmapStore>(SubmapStoreOptions{1, folder.path()});
    const StoredSurfaces a(store, surfacesOf(1)), b(store, surfacesOf(2));
    EXPECT_EQ(filesIn(folder).size(), 1U);
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(SubmapStore, WithoutABoundThereAreNoFiles)
{
  SubmapStoreOptions options;
  options.directory = "/is/not/there";
  const auto unbounded = std::make_shared<SubmapStore>(options);
  std::vector<StoredSurfaces> submaps;
  for (unsigned i = 0; i < 20; ++i)
    submaps.emplace_back(unbounded, surfacesOf(i));
  EXPECT_EQ(unbounded->planesInMemory(), 20 * kPlanes);
  EXPECT_EQ(unbounded->troubles().not_written, "");
}

/** Nothing is lost when the disk refuses them: they stay in memory. */
TEST(SubmapStore, WhatCannotBeWrittenStaysInMemory)
{
  const TemporaryFolder folder;
  const auto store =
      std::make_shared<SubmapStore>(SubmapStoreOptions{kPlanes, folder.file("is/not/there")});
  std::vector<StoredSurfaces> submaps;
  for (unsigned i = 0; i < 5; ++i)
    submaps.emplace_back(store, surfacesOf(i));
  for (unsigned i = 0; i < 5; ++i)
    EXPECT_TRUE(isOf(i, *submaps[i].get())) << i;
  EXPECT_EQ(store->planesInMemory(), 5 * kPlanes);
  const SubmapStoreTroubles troubles = store->troubles();
  EXPECT_NE(troubles.not_written.find(folder.file("is/not/there")), std::string::npos)
      << troubles.not_written;
  EXPECT_EQ(troubles.lost, 0U);
}

/** What somebody does to the files is seen, said once, and does not end the run. */
TEST_F(ThreeInMemory, DamagedFilesAreSurfacesThatAreLost)
{
  fill();
  const std::vector<fs::path> files = filesIn(folder_);
  fs::resize_file(files[0], fs::file_size(files[0]) - 1);
  std::fstream(files[1], std::ios::in | std::ios::out | std::ios::binary).seekp(99).put('x');
  fs::remove(files[2]);
  std::size_t lost = 0;
  for (int round = 0; round < 2; ++round)
    for (unsigned i = 0; i < kSubmaps; ++i)
    {
      const auto surfaces = submaps_[i].get();
      if (surfaces->planes.empty())
        ++lost;
      else
        EXPECT_TRUE(isOf(i, *surfaces)) << i;
    }
  EXPECT_EQ(lost, 2 * 3U);
  EXPECT_EQ(store_->troubles().lost, 3U);
  EXPECT_NE(store_->troubles().not_read.find(folder_.path()), std::string::npos);
  EXPECT_LE(store_->planesInMemory(), 3 * kPlanes);
}

TEST_F(ThreeInMemory, ServesSeveralThreads)
{
  fill();
  const auto read = [this](unsigned seed)
  {
    std::mt19937 random(seed);
    for (int i = 0; i < 100; ++i)
    {
      const auto submap = static_cast<unsigned>(random() % kSubmaps);
      EXPECT_TRUE(isOf(submap, *submaps_[submap].get()));
    }
  };
  std::thread other(read, 1);
  read(2);
  other.join();
  EXPECT_LE(store_->planesInMemory(), 3 * kPlanes);
}

TEST(StoredSurfaces, NoneHaveNoPlanes)
{
  const StoredSurfaces none;
  EXPECT_EQ(none.planes(), 0U);
  EXPECT_TRUE(none.get()->planes.empty());
}

TEST(StoredSurfaces, EachPlaneHasASpread)
{
  SubmapSurfaces surfaces = surfacesOf(1);
  surfaces.spreads.pop_back();
  EXPECT_THROW(
      StoredSurfaces(std::make_shared<SubmapStore>(), std::move(surfaces)), std::invalid_argument);
}

}  // namespace
}  // namespace fastlio
