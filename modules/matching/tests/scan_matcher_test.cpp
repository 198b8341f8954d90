// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_matching.h"
#include <fastlio/matching/pose_search.h>
#include <fastlio/matching/scan_matcher.h>

#include <mrpt/maps/CSimplePointsMap.h>

#include <cmath>
#include <memory>
#include <vector>

namespace fastlio
{
namespace
{
constexpr double kHeight = 1.5;  // of the sensor above the ground [m]

/** Flat ground whose height is known to a millimetre, and a wall each in front and at the side. */
class FlatWorld : public SurfaceMap
{
 public:
  void match(
      const WorldPoints& points, const Vec3& /*sensor_origin*/, std::size_t first, std::size_t last,
      std::vector<PlaneMatch>& matches) const override
  {
    for (std::size_t i = first; i < last; ++i)
    {
      const Vec3 p(points.x[i], points.y[i], points.z[i]);
      const Vec3 normal = p.z() < 1.0                      ? Vec3::UnitZ()
                          : std::abs(p.x()) > p.norm() / 2 ? Vec3::UnitX()
                                                           : Vec3::UnitY();
      matches[i] = planeThrough(kWall * (Vec3::Ones() - Vec3::UnitZ()), normal, 1e-6);
    }
  }
  void insert(const WorldPoints& /*points*/, const Vec3& /*sensor_origin*/) override {}
  void removeOutside(const Vec3& /*center*/, double /*radius*/) override {}
  [[nodiscard]] std::size_t pointCount() const override { return 1; }
  [[nodiscard]] std::shared_ptr<mrpt::maps::CSimplePointsMap> toPointsMap() const override
  {
    return std::make_shared<mrpt::maps::CSimplePointsMap>();
  }

  static constexpr double kWall = 6.0;  // [m]
};

void addPoint(BodyPoints& body, const Vec3& p)
{
  const Vec3 beam = p.normalized();
  body.x.push_back(float(p.x()));
  body.y.push_back(float(p.y()));
  body.z.push_back(float(p.z()));
  body.ux.push_back(float(beam.x()));
  body.uy.push_back(float(beam.y()));
  body.uz.push_back(float(beam.z()));
  body.beam_bin.push_back(0);
}

/** Ground and walls nearby, and 20 points of ground far away that lie 3 cm too low or too high:
 * 0.4 mrad, a part of the width of a beam. */
DeskewedScan scanWithGroundFarAway()
{
  DeskewedScan scan;
  Random random(5);
  for (int i = 0; i < 100; ++i)
  {
    addPoint(scan.surfaces, {random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), -kHeight});
    addPoint(
        scan.surfaces, {FlatWorld::kWall, random.uniform(-2.0, 2.0), random.uniform(0.0, 3.0)});
    addPoint(
        scan.surfaces, {random.uniform(-2.0, 2.0), FlatWorld::kWall, random.uniform(0.0, 3.0)});
  }
  for (int i = 0; i < 20; ++i)
  {
    const double error = i % 2 == 0 ? 0.03 : -0.03;
    addPoint(
        scan.surfaces, {random.uniform(70.0, 90.0), random.uniform(-9.0, 9.0), error - kHeight});
  }
  return scan;
}

// Without the noise of the directions, a millimetre would be left of the noise of the range on
// ground that a beam hits at a degree.
TEST(ScanMatcher, GroundFarAwayDoesNotOutweighAllElse)
{
  const FlatWorld world;
  const EdgeMap edges;
  FilterState predicted;
  predicted.x.p = Vec3(0.0, 0.0, kHeight);
  predicted.P.topLeftCorner<6, 6>().diagonal() << Vec3::Constant(3e-8), Vec3::Constant(2e-6);
  ScanMatcher matcher(std::make_shared<const Workers>(1));
  const MatchResult result =
      matcher.match(scanWithGroundFarAway(), predicted, {world, edges}, MatchOptions{});
  ASSERT_EQ(result.update.last.count, 320U);
  const double innovation =
      result.update.last.weighted_squares / static_cast<double>(result.update.last.count);
  EXPECT_LT(innovation, 1.5) << "a few points look like a scan that does not fit";
  const NavState& x = result.update.posterior.x;
  EXPECT_LT((x.p - predicted.x.p).norm(), 0.002);
  EXPECT_LT(logSO3(x.R).norm(), 2e-4);
}

/** Starts around the pose that the scan was taken from, up to 0.3 m and 0.05 rad off. */
std::vector<PoseStart> startsAround(const FilterState& predicted, int starts)
{
  Random random(7);
  std::vector<PoseStart> all;
  all.reserve(static_cast<std::size_t>(starts));
  for (int i = 0; i < starts; ++i)
    all.push_back(poseStartAt(
        predicted, {expSO3(random.vector(0.05)), predicted.x.p + random.vector(0.3)}, {0.3, 0.1}));
  return all;
}

FilterState uncertainPrediction()
{
  FilterState predicted;
  predicted.x.p = Vec3(0.0, 0.0, kHeight);
  predicted.P.diagonal().head<3>().setConstant(1e-2);
  return predicted;
}

TEST(ScanMatcher, ThePoseAloneIsMatchedAsTheWholeStateIs)
{
  const FlatWorld world;
  const EdgeMap edges;
  const DeskewedScan scan = scanWithGroundFarAway();
  const FilterState predicted = uncertainPrediction();
  ScanMatcher matcher(std::make_shared<const Workers>(1));
  MatchOptions options;
  options.measurement.min_signal_to_noise = 0.0;  // three planes alone leave directions open
  for (const PoseStart& start : startsAround(predicted, 20))
  {
    const PoseMatch pose = matcher.matchPoses(scan, {start}, {world, edges}, options).front();
    const MatchResult whole = matcher.match(
        scan, startAt(predicted, start.T_world_imu, {0.3, 0.1}), {world, edges}, options);
    ASSERT_TRUE(pose.updated);
    ASSERT_TRUE(whole.update.updated);
    EXPECT_EQ(pose.sums.count, whole.update.last.count);
    const Pose expected = whole.update.posterior.x.pose();
    EXPECT_LT((pose.T_world_imu.p - expected.p).norm(), 1e-4);
    EXPECT_LT(logSO3(pose.T_world_imu.R.transpose() * expected.R).norm(), 1e-4);
  }
}

TEST(ScanMatcher, ManyStartsGiveTheSameOnAnyNumberOfThreads)
{
  const FlatWorld world;
  const EdgeMap edges;
  const DeskewedScan scan = scanWithGroundFarAway();
  const FilterState predicted = uncertainPrediction();
  const std::vector<PoseStart> starts = startsAround(predicted, 100);
  ScanMatcher alone(std::make_shared<const Workers>(1)), four(std::make_shared<const Workers>(4));
  const auto one_by_one = alone.matchPoses(scan, starts, {world, edges}, {});
  const auto together = four.matchPoses(scan, starts, {world, edges}, {});
  ASSERT_EQ(one_by_one.size(), starts.size());
  ASSERT_EQ(together.size(), starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i)
  {
    EXPECT_EQ(one_by_one[i].T_world_imu.p, together[i].T_world_imu.p);
    EXPECT_EQ(one_by_one[i].T_world_imu.R, together[i].T_world_imu.R);
  }
}

TEST(ScanMatcher, AStartOfWhichTooLittleMatchesFindsNoPose)
{
  const FlatWorld world;
  const EdgeMap edges;
  DeskewedScan few;
  for (int i = 0; i < 10; ++i)
    addPoint(few.surfaces, {1.0 + i, 0.0, -kHeight});
  const FilterState predicted = uncertainPrediction();
  ScanMatcher matcher(std::make_shared<const Workers>(1));
  EXPECT_FALSE(
      matcher.matchPoses(few, startsAround(predicted, 1), {world, edges}, {}).front().updated);
}
}  // namespace
}  // namespace fastlio
