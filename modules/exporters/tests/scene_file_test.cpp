// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "output_test_support.h"
#include <fastlio/compat/mrpt_scene.h>
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/run/bounded_path.h>

#include <mrpt/opengl/CEllipsoid3D.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
using testing::kPeriod;
using testing::kRunStart;
using testing::resultAt;
using testing::smallMap;
using testing::TemporaryFolder;

ExportTarget targetIn(const TemporaryFolder& folder)
{
  ExportTarget target;
  target.directory = folder.path();
  target.parameters.exporters = "scene";
  return target;
}

/** The scene of scans, as MRPT's viewer loads it. */
void loadScene(const std::vector<ScanResult>& scans, MrptScene& scene)
{
  const TemporaryFolder folder;
  ExporterSet set = makeExporters(targetIn(folder));
  EXPECT_TRUE(set.needMap());
  for (const ScanResult& scan : scans)
    set.onScan(scan);
  EXPECT_TRUE(set.finish({}, *smallMap()).output_problems.empty());
  ASSERT_TRUE(scene.loadFromFile(folder.file("scene.3Dscene")));
}

template <typename T>
std::shared_ptr<T> objectOf(MrptScene& scene, const std::string& name)
{
  return std::dynamic_pointer_cast<T>(scene.getByName(name));
}

std::size_t sizeOf(const mrpt::opengl::CSetOfObjects& set)
{
  return static_cast<std::size_t>(std::distance(set.begin(), set.end()));
}

TEST(Scene, HoldsMapTrajectoryKeyFramesAndCovariances)
{
  std::vector<ScanResult> scans;
  scans.reserve(101);
  for (int i = 0; i < 101; ++i)
    scans.push_back(resultAt(i, ScanStatus::Tracking, 0.1 * i, 1.0));
  scans[50].status = ScanStatus::Diverged;
  MrptScene scene;
  ASSERT_NO_FATAL_FAILURE(loadScene(scans, scene));
  const auto cloud = objectOf<mrpt::opengl::CPointCloudColoured>(scene, "map");
  const auto lines = objectOf<mrpt::opengl::CSetOfLines>(scene, "trajectory");
  const auto frames = objectOf<mrpt::opengl::CSetOfObjects>(scene, "keyframes");
  const auto covariances = objectOf<mrpt::opengl::CSetOfObjects>(scene, "covariances");
  ASSERT_TRUE(cloud && lines && frames && covariances);
  EXPECT_EQ(cloud->size(), 5000U);
  EXPECT_EQ(lines->size(), 99U);
  // One per metre; that at 5 m has no pose, so the next ones come later, at 5.1 m and on.
  EXPECT_EQ(sizeOf(*frames), 10U);
  EXPECT_EQ(sizeOf(*covariances), 10U);
  EXPECT_NEAR((*frames->begin())->getPose().x, 0.0, 1e-6);
  const auto ellipsoid =
      std::dynamic_pointer_cast<mrpt::opengl::CEllipsoid3D>(*std::next(covariances->begin()));
  ASSERT_TRUE(ellipsoid);
  EXPECT_NEAR(ellipsoid->getPose().x, 1.0, 0.11);
  const Matrix6 covariance = poseEstimateOf(scans[0].filter, {}).covariance;
  EXPECT_NEAR(ellipsoid->getCovMatrix()(0, 1), covariance(3, 4), 1e-12);
}

TEST(Scene, OfARunWithoutAPoseIsEmpty)
{
  MrptScene scene;
  ASSERT_NO_FATAL_FAILURE(loadScene({resultAt(0, ScanStatus::Initializing, 0, 1)}, scene));
  EXPECT_EQ(objectOf<mrpt::opengl::CSetOfLines>(scene, "trajectory")->size(), 0U);
  EXPECT_EQ(sizeOf(*objectOf<mrpt::opengl::CSetOfObjects>(scene, "keyframes")), 0U);
}

TEST(Scene, StatesThatAreNotFiniteAreLeftOut)
{
  std::vector<ScanResult> scans;
  scans.reserve(30);
  for (int i = 0; i < 30; ++i)
    scans.push_back(resultAt(i, ScanStatus::Tracking, i, 1.0));
  scans[3].filter.x.p.x() = std::nan("");
  scans[4].filter.P.setConstant(std::nan(""));
  scans[5].filter.P.setZero();
  MrptScene scene;
  ASSERT_NO_FATAL_FAILURE(loadScene(scans, scene));
  EXPECT_EQ(sizeOf(*objectOf<mrpt::opengl::CSetOfObjects>(scene, "keyframes")), 29U);
  EXPECT_EQ(sizeOf(*objectOf<mrpt::opengl::CSetOfObjects>(scene, "covariances")), 27U);
}

TEST(Scene, OfALongRunIsBounded)
{
  std::vector<ScanResult> scans;
  scans.reserve(3000);
  for (int i = 0; i < 3000; ++i)
    scans.push_back(resultAt(i, ScanStatus::Tracking, 2.0 * i, 1.0));
  MrptScene scene;
  ASSERT_NO_FATAL_FAILURE(loadScene(scans, scene));
  const std::size_t frames = sizeOf(*objectOf<mrpt::opengl::CSetOfObjects>(scene, "keyframes"));
  EXPECT_LT(frames, 1000U);
  EXPECT_GT(frames, 400U);
}

TEST(BoundedPath, KeepsItsEndsAndItsShape)
{
  BoundedPath path(100, 1.0);
  for (int i = 0; i < 10'001; ++i)
    path.add(kRunStart + i * kPeriod, {0.5 * i, 0.0, 0.0});
  const auto positions = path.positions();
  EXPECT_LE(positions.size(), 101U);
  EXPECT_GT(positions.size(), 40U);
  EXPECT_EQ(positions.front().x(), 0.0);
  EXPECT_EQ(positions.back().x(), 5000.0);
}

TEST(BoundedPath, BreaksWhereThereIsNoPoseForLong)
{
  BoundedPath path(100, 1.0);
  for (const int i : {0, 1, 2, 30, 31})
    path.add(kRunStart + i * kPeriod, {0.5 * i, 0.0, 0.0});
  const auto positions = path.positions();
  ASSERT_EQ(positions.size(), 6U);
  EXPECT_FALSE(positions[3].allFinite());
  EXPECT_EQ(
      std::count_if(
          positions.begin(), positions.end(), [](const Vec3& p) { return p.allFinite(); }),
      5);
}

/** Whatever is left out: no line is drawn across the time without poses. */
TEST(BoundedPath, GivesStretchesByThemselves)
{
  BoundedPath path(100, 1.0);
  for (int i = 0; i <= 20; ++i)
    path.add(i * 100'000'000LL, Vec3(i, 0.0, 0.0));
  UntrustedStretch first, second;
  first.begin_ns = 300'000'000;
  first.end_ns = 500'000'000;
  second.begin_ns = 1'900'000'000;
  second.end_ns = 5'000'000'000;
  std::vector<double> along;
  for (const Vec3& p : path.positionsWithin({first, second}))
    along.push_back(p.allFinite() ? p.x() : -1.0);
  EXPECT_EQ(along, (std::vector<double>{3, 4, 5, -1, 19, 20}));
  EXPECT_TRUE(path.positionsWithin({}).empty());
}

TEST(BoundedPath, StillBreaksWhereALongPathIsThinned)
{
  for (int gap_after = 1; gap_after < 500; ++gap_after)
  {
    BoundedPath path(50, 1.0);
    for (int i = 0; i < 501; ++i)
      path.add(kRunStart + (i + (i > gap_after ? 100 : 0)) * kPeriod, {0.0 + i, 0.0, 0.0});
    const auto positions = path.positions();
    int breaks = 0;
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      if (positions[i].allFinite()) continue;
      ++breaks;
      EXPECT_LE(positions.at(i - 1).x(), gap_after);
      EXPECT_GT(positions.at(i + 1).x(), gap_after);
    }
    EXPECT_EQ(breaks, 1) << gap_after;
  }
}

}  // namespace
}  // namespace fastlio
