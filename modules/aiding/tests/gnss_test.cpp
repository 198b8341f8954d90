// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gnss_test.cpp GNSS over kilometres, at the level of the pose graph: motions with the noise
 * that their covariances have, and fixes with noise. FASTLIO_EVERYTHING=1: up to 100 km, with the
 * time that this takes. */

#include "repeats.h"
#include <fastlio/aiding/gnss.h>
#include <fastlio/posegraph/odometry_chain.h>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace fastlio
{
namespace
{
constexpr double kStep = 12.0;    // of submaps [m]
constexpr double kSpeed = 12.0;   // [m/s]
constexpr double kNoise = 1.0;    // of a fix, horizontally [m]
constexpr double kTurned = 1e-3;  // odometry, each step [rad]
constexpr double kMoved = 0.01;   // likewise [m]
const Vec3 kAntenna(-0.4, 0.2, 1.1);

/** A winding road with hills, as odometry and receiver see it. */
class Road
{
 public:
  /** \param claimed standard deviation of a fix by the receiver's account, horizontally [m] */
  Road(double length, unsigned seed, double claimed = 2.0) : engine_(seed), claimed_(claimed)
  {
    truth_.push_back({Mat3::Identity(), Vec3::Zero()});
    OdometryChain chain(Pose{}, Matrix6::Zero());
    Matrix6 covariance = Matrix6::Zero();
    covariance.diagonal().head<3>().setConstant(kTurned * kTurned);
    covariance.diagonal().tail<3>().setConstant(kMoved * kMoved);
    take(0, chain);
    for (double at = kStep; at <= length; at += kStep)
    {
      const double yaw = 0.12 * std::sin(at / 170.0) + 0.05 * std::sin(at / 41.0);
      const double pitch = 0.02 * (std::sin(at / 230.0) - std::sin((at - kStep) / 230.0));
      const Pose motion{expSO3({0.0, pitch, yaw}), {kStep, 0.0, 0.0}};
      truth_.push_back(truth_.back() * motion);
      RelativePose measured;
      measured.T_a_b = {motion.R * expSO3(kTurned * normal3()), motion.p + kMoved * normal3()};
      measured.covariance = covariance;
      chain.advance(measured);
      take(truth_.size() - 1, chain);
    }
  }

  /** The map without GNSS, and with it. */
  std::pair<MappingResult, GnssOutcome> mapped()
  {
    GnssFactors gnss;
    gnss.add(fixes_, track_, 0, mapper_);
    MappingResult result = std::move(mapper_).result();
    GnssOutcome outcome = gnss.applyTo(result);
    return {std::move(result), outcome};
  }

  /** A receiver that repeats its first position. */
  void freeze()
  {
    for (GnssFix& fix : fixes_)
      fix.place = fixes_.front().place;
  }

  /** The second half of its positions is off, all by the same. */
  void jump(const Vec3& by)
  {
    for (std::size_t i = fixes_.size() / 2; i < fixes_.size(); ++i)
      fixes_[i].place = frame_.geodeticOf(frame_.enuOf(fixes_[i].place) + by);
  }

  /** Reflections: some successive positions are off, all by the same. \return how many */
  std::size_t reflect(const Vec3& by)
  {
    const std::size_t begin = fixes_.size() / 4, end = begin + fixes_.size() / 20;
    for (std::size_t i = begin; i < end; ++i)
      fixes_[i].place = frame_.geodeticOf(frame_.enuOf(fixes_[i].place) + by);
    return end - begin;
  }

  [[nodiscard]] const std::vector<Pose>& truth() const { return truth_; }
  [[nodiscard]] const LocalFrame& frame() const { return frame_; }

 private:
  Vec3 normal3()
  {
    const double x = normal_(engine_), y = normal_(engine_), z = normal_(engine_);
    return {x, y, z};
  }

  void take(std::size_t i, const OdometryChain& chain)
  {
    const auto stamp_ns =
        static_cast<std::int64_t>(1e9 * (100.0 + kStep / kSpeed * static_cast<double>(i)));
    ScanResult scan;
    scan.status = i == 0 ? ScanStatus::FirstScan : ScanStatus::Tracking;
    scan.begin_ns = scan.stamp_ns = stamp_ns;
    scan.filter.x.R = chain.pose().R;
    scan.filter.x.p = chain.pose().p;
    scan.filter.P.topLeftCorner<6, 6>() = scan.map_covariance = chain.covariance();
    track_.add(scan);
    Submap submap;
    submap.reference = mappingPoseOf(scan);
    submap.travel = kStep * static_cast<double>(i);
    submap.range = 20.0;
    submap.last_ns = stamp_ns;
    mapper_.add(std::move(submap));
    GnssFix fix;
    fix.stamp_ns = stamp_ns;
    fix.horizontal_std = claimed_;
    fix.vertical_std = 2.0 * claimed_;
    fix.antenna = kAntenna;
    const Vec3 noise = normal3();
    fix.place = frame_.geodeticOf(
        truth_[i] * kAntenna + kNoise * Vec3(noise.x(), noise.y(), 2.0 * noise.z()));
    fixes_.push_back(fix);
  }

  std::mt19937 engine_;
  double claimed_;
  std::normal_distribution<double> normal_;
  LocalFrame frame_{GeodeticPoint{48.1, 11.6, 520.0}};
  std::vector<Pose> truth_;
  PoseTrack track_{OutputFrame{}};
  Mapper mapper_;
  std::vector<GnssFix> fixes_;
};

/** Errors of the submaps on the earth. */
struct EarthErrors
{
  double horizontal = 0.0;  //!< rms [m]
  double nees = 0.0;        //!< of heading and place of the map: 3 degrees of freedom
};

EarthErrors errorsOf(const Road& road, const MappingResult& map, const GnssOutcome& gnss)
{
  const LocalFrame frame(gnss.datum);
  EarthErrors errors;
  for (std::size_t i = 0; i < map.estimate.nodes.size(); ++i)
  {
    const Vec3 truth = frame.enuOf(road.frame().geodeticOf(road.truth()[i].p));
    const Vec3 e = gnss.T_enu_world * map.estimate.nodes[i].p - truth;
    errors.horizontal += e.head<2>().squaredNorm();
  }
  const auto count = static_cast<double>(map.estimate.nodes.size());
  errors.horizontal = std::sqrt(errors.horizontal / count);
  const Mat3& R = gnss.T_enu_world.R;
  const Vec3 off =
      gnss.T_enu_world.p - frame.enuOf(road.frame().geodeticOf(road.truth().front().p));
  const Vec3 e(std::atan2(R(1, 0), R(0, 0)), off.x(), off.y());
  const Mat3 P = map.estimate.earth_covariance.block<3, 3>(2, 2);  // heading, east, north
  errors.nees = e.dot(P.ldlt().solve(e));
  return errors;
}
}  // namespace

TEST(Gnss, FiveKilometresWithAMetreOfNoise)
{
  for (unsigned seed = 1; seed <= 2; ++seed)
  {
    Road road(5000.0, seed);
    const auto [map, gnss] = road.mapped();
    ASSERT_TRUE(gnss.used) << gnss.reason;
    const EarthErrors errors = errorsOf(road, map, gnss);
    std::printf(
        "5 km, %zu fixes: %.2f m horizontally; a fix %.2f m, correlation %.2f\n", gnss.fixes,
        errors.horizontal, gnss.horizontal_std, gnss.correlation);
    EXPECT_LT(errors.horizontal, 0.3);
    EXPECT_NEAR(gnss.horizontal_std, kNoise, 0.15 * kNoise);
    EXPECT_LT(gnss.rejected, 5U);
  }
}

/** By the account of the receiver these are possible. By the noise that it has they are not. */
TEST(Gnss, LeavesReflectionsOutThatTheReceiversAccountAllows)
{
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    Road road(1200.0, seed, 2.0 * kNoise);
    const std::size_t wrong = road.reflect({7.0, -5.0, 3.0});
    const auto [map, gnss] = road.mapped();
    ASSERT_TRUE(gnss.used) << gnss.reason;
    EXPECT_GE(gnss.rejected, wrong);
    EXPECT_LE(gnss.rejected, wrong + 2);
    EXPECT_NEAR(gnss.horizontal_std, kNoise, 0.2 * kNoise);
  }
}

/** A receiver that promises centimetres and is off by a metre: the few fixes that agree are chance,
 * and their residuals would seem to be millimetres. */
TEST(Gnss, IsNotUsedWhereFewFixesAgree)
{
  Road road(1200.0, 1, 0.03);
  const auto [map, gnss] = road.mapped();
  EXPECT_FALSE(gnss.used);
  EXPECT_EQ(gnss.fixes, map.submaps.size());
  EXPECT_GT(2 * gnss.rejected, gnss.fixes);
  EXPECT_NE(gnss.reason.find("positions agree with each other"), std::string::npos) << gnss.reason;
  EXPECT_EQ(gnss.horizontal_std, 0.0);
  EXPECT_FALSE(map.corrected);
  EXPECT_FALSE(map.estimate.T_earth_world);
  EXPECT_TRUE(map.graph.positions.empty());
  for (std::size_t i = 0; i < map.submaps.size(); ++i)
    EXPECT_EQ(map.estimate.nodes[i].p, map.submaps[i].reference.T_world_body.p);
}

/** Which half is right nobody knows. */
TEST(Gnss, IsNotUsedWhereHalfOfTheFixesContradictTheOthers)
{
  Road road(1200.0, 1);
  road.jump({30.0, -20.0, 0.0});
  const auto [map, gnss] = road.mapped();
  EXPECT_FALSE(gnss.used);
  EXPECT_NE(gnss.reason.find("positions agree with each other"), std::string::npos) << gnss.reason;
}

/** Nobody gave control points, or could give them larger standard deviations. */
TEST(Gnss, RefusedPositionsAreCalledPositions)
{
  Road road(1200.0, 1);
  road.freeze();
  const auto [map, gnss] = road.mapped();
  EXPECT_FALSE(gnss.used);
  EXPECT_EQ(gnss.reason.find("positions contradict each other: "), 0U) << gnss.reason;
  EXPECT_NE(gnss.reason.find("check the antenna's place"), std::string::npos) << gnss.reason;
}

/** The place of the map on the earth is known as well as its covariance says. */
TEST(Gnss, CovarianceOfThePlaceIsThatOfItsErrors)
{
  constexpr unsigned kRoads = 20;
  double sum = 0.0;
  for (unsigned seed = 1; seed <= kRoads; ++seed)
  {
    Road road(600.0, seed);
    const auto [map, gnss] = road.mapped();
    ASSERT_TRUE(gnss.used) << gnss.reason;
    sum += errorsOf(road, map, gnss).nees;
  }
  std::printf("NEES of heading and place: %.1f, 3 degrees of freedom\n", sum / kRoads);
  EXPECT_GT(sum / kRoads, 1.5);
  EXPECT_LT(sum / kRoads, 5.0);
}

/** The cost grows with the length of the way, not with its square. */
TEST(Gnss, CostOverTheLength)
{
  std::vector<double> lengths{1250.0, 5000.0};
  if (testing::everything()) lengths = {5000.0, 20000.0, 100000.0};
  std::vector<double> seconds;
  for (const double length : lengths)
  {
    const std::clock_t begin = std::clock();
    Road road(length, 1);
    const auto [map, gnss] = road.mapped();
    ASSERT_TRUE(gnss.used) << gnss.reason;
    seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    std::printf(
        "%.1f km: %zu submaps, %.2f s of the processor, %.2f m horizontally\n", 1e-3 * length,
        map.submaps.size(), seconds.back(), errorsOf(road, map, gnss).horizontal);
  }
  // Proportional, with room for the noise of a busy machine.
  const double ratio = seconds.back() / std::max(seconds.front(), 1e-3);
  if (!testing::everything()) return;
  EXPECT_LT(ratio, 2.0 * lengths.back() / lengths.front());
}

}  // namespace fastlio
