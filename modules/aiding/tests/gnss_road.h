// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gnss_road.h A road with positions of GNSS, at the level of the pose graph: motions with the
 * noise that their covariances have, and fixes with noise. */
#pragma once

#include <fastlio/aiding/gnss.h>
#include <fastlio/posegraph/odometry_chain.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace fastlio::testing
{
inline constexpr double kStep = 12.0;    // of submaps [m]
inline constexpr double kSpeed = 12.0;   // [m/s]
inline constexpr double kNoise = 1.0;    // of a fix, horizontally [m]
inline constexpr double kTurned = 1e-3;  // odometry, each step [rad]
inline constexpr double kMoved = 0.01;   // likewise [m]
inline const Vec3 kAntenna(-0.4, 0.2, 1.1);

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

  /** The receiver states a standard deviation for each fix. \param std that it states for fix
   * number i \param noise that this fix has, both horizontally [m] */
  template <typename Std, typename Noise>
  void state(const Std& std, const Noise& noise)
  {
    for (std::size_t i = 0; i < fixes_.size(); ++i)
    {
      GnssFix& fix = fixes_[i];
      fix.usual = GnssStd{claimed_, 2.0 * claimed_};
      fix.horizontal_std = std(i);
      fix.vertical_std = 2.0 * std(i);
      const Vec3 antenna = truth_[i] * kAntenna;
      const Vec3 error = frame_.enuOf(fix.place) - antenna;
      fix.place = frame_.geodeticOf(antenna + noise(i) / kNoise * error);
    }
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

inline EarthErrors errorsOf(const Road& road, const MappingResult& map, const GnssOutcome& gnss)
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

}  // namespace fastlio::testing
