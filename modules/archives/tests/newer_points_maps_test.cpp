// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "test_files.h"
#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/compat/register_classes.h>

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/serialization/CArchive.h>

namespace fastlio
{
namespace
{
/** As MRPT 2.15.3 writes the options of insertion: version 1, without one of the flags. */
std::string inNewerForm(std::string bytes)
{
  const std::string old("\x00\x0a\xd7\xa3\x3c\x01\x00\x01", 8);
  const std::string newer("\x01\x0a\xd7\xa3\x3c\x01\x00", 7);
  const auto at = bytes.find(old);
  EXPECT_NE(at, std::string::npos);
  return bytes.replace(at, old.size(), newer);
}

/** The object, and a comment behind it: nothing may be left of the object. */
template <typename Map>
typename Map::Ptr readBack(const std::string& bytes)
{
  mrpt::obs::CObservationComment comment;
  comment.text = "behind";
  std::string all = bytes + testing::serialize(comment);
  mrpt::io::CMemoryStream stream;
  stream.assignMemoryNotOwn(all.data(), all.size());
  auto archive = mrpt::serialization::archiveFrom(stream);
  const auto map = std::dynamic_pointer_cast<Map>(archive.ReadObject());
  const auto next = std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(archive.ReadObject());
  EXPECT_TRUE(next && next->text == "behind");
  return map;
}

template <typename Map>
void expectBothFormsAreRead(const Map& map)
{
  registerBridgeClasses();
  const std::string old_form = testing::serialize(map);
  std::vector<std::string> forms = {old_form};
  if (!FASTLIO_MRPT_READS_NEWER_POINTS) forms.push_back(inNewerForm(old_form));
  for (const std::string& form : forms)
  {
    const auto read = readBack<Map>(form);
    ASSERT_TRUE(read);
    ASSERT_EQ(read->size(), map.size());
    EXPECT_EQ(read->getPointsBufferRef_z(), map.getPointsBufferRef_z());
    EXPECT_EQ(read->likelihoodOptions.decimation, 7U);
    EXPECT_STREQ(read->GetRuntimeClass()->className, map.GetRuntimeClass()->className);
    EXPECT_EQ(testing::serialize(*read), old_form);  // saved as MRPT at hand saves it
  }
}

TEST(NewerPointsMaps, SimpleOnesAreReadInBothForms)
{
  mrpt::maps::CSimplePointsMap map;
  for (int i = 0; i < 1000; ++i)
    map.insertPointFast(static_cast<float>(i), 2.0F, -static_cast<float>(i));
  map.likelihoodOptions.decimation = 7;
  expectBothFormsAreRead(map);
}

TEST(NewerPointsMaps, ThoseWithIntensityToo)
{
  mrpt::maps::CPointsMapXYZI map;
  map.resize(10);
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    const auto x = static_cast<float>(i);
    map.setPointFast(i, x, 2.0F, -x);
    map.setPointIntensity(i, 0.5F * x);
  }
  map.likelihoodOptions.decimation = 7;
  expectBothFormsAreRead(map);
}

}  // namespace
}  // namespace fastlio
