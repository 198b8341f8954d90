// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/beam_calibration.h>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::size_t kFirstBin = 21, kBins = 16;  // those of a VLP-16
constexpr double kReturnWeight = 1.0 / 4e-4;       // of a range noise of 2 cm

/** Scans of lasers that meet surfaces of all directions, 3 to 30 m away. The scan pose is updated
 * with them, as the filter does it. */
class Ride
{
 public:
  explicit Ride(std::vector<BeamOffset> lasers) : lasers_(std::move(lasers)) {}

  void scan(BeamCalibration& calibration)
  {
    constexpr int kPoints = 400;
    struct Point
    {
      PointMeasurement measurement;
      Vector6 h;
      BeamView measured, created;
    };
    std::vector<Point> points(kPoints);
    Matrix6 information = Matrix6::Zero();
    Vector6 weighted = Vector6::Zero();
    for (Point& point : points)
    {
      point.measured = viewOf(laser_(random_));
      point.created = viewOf(laser_(random_));
      point.measurement.weight = kReturnWeight;
      point.measurement.z =
          left(calibration, point.measured) - left(calibration, point.created) + noise_(random_);
      for (Eigen::Index k = 0; k < 3; ++k)
      {
        point.h[k] = 8.0 * normal_(random_);
        point.h[3 + k] = normal_(random_);
      }
      point.measurement.weighted_h = kReturnWeight * point.h;
      information += kReturnWeight * point.h * point.h.transpose();
      weighted += kReturnWeight * point.h * point.measurement.z;
    }
    const Vector6 step = information.ldlt().solve(weighted);
    for (Point& point : points)
    {
      point.measurement.z -= point.h.dot(step);
      calibration.add(point.measurement, point.measured, &point.created);
    }
    calibration.finishScan(information);
  }

  /** The largest offset that is left of any laser. */
  [[nodiscard]] BeamOffset worst(const BeamCalibration& calibration) const
  {
    BeamOffset worst;
    for (std::size_t i = 0; i < kBins; ++i)
    {
      const BeamOffset left = leftOf(calibration, i);
      worst.range = std::max(worst.range, std::abs(left.range));
      worst.elevation = std::max(worst.elevation, std::abs(left.elevation));
      worst.azimuth = std::max(worst.azimuth, std::abs(left.azimuth));
    }
    return worst;
  }

 private:
  BeamView viewOf(std::size_t laser)
  {
    const double along = normal_(random_), range = range_(random_);
    const double upward = normal_(random_), sideways = normal_(random_);
    return {kFirstBin + laser, {along, range * upward, range * sideways}};
  }

  [[nodiscard]] BeamOffset leftOf(const BeamCalibration& calibration, std::size_t laser) const
  {
    // What corrections() do to a point of this laser, 10 m away.
    const double elevation = beamElevation(kFirstBin + laser);
    auto x = static_cast<float>(10.0 * std::cos(elevation)), y = 0.0F,
         z = static_cast<float>(10.0 * std::sin(elevation));
    calibration.corrections().apply(x, y, z);
    const BeamOffset& truth = lasers_[laser];
    return {
        truth.range - (10.0 - std::hypot(double{x}, double{y}, double{z})),
        truth.elevation - (elevation - std::atan2(z, std::hypot(x, y))),
        truth.azimuth + std::atan2(y, x)};
  }

  [[nodiscard]] double left(const BeamCalibration& calibration, const BeamView& view) const
  {
    const BeamOffset offset = leftOf(calibration, view.bin - kFirstBin);
    return view.by_offset.dot(Vec3(offset.range, offset.elevation, offset.azimuth));
  }

  std::vector<BeamOffset> lasers_;
  std::mt19937 random_{5};
  std::uniform_int_distribution<std::size_t> laser_{0, kBins - 1};
  std::uniform_real_distribution<double> normal_{-1.0, 1.0}, range_{3.0, 30.0};
  std::normal_distribution<double> noise_{0.0, 0.02};
};

/** Of these sizes, with a pattern of signs for each of them. */
std::vector<BeamOffset> alternating(const BeamOffset& size)
{
  const auto signed_by = [](std::size_t step, double x) { return step % 2 == 0 ? x : -x; };
  std::vector<BeamOffset> lasers;
  for (std::size_t i = 0; i < kBins; ++i)
    lasers.push_back(
        {signed_by(i, size.range), signed_by(i / 2, size.elevation),
         signed_by(i / 4, size.azimuth)});
  return lasers;
}

BeamCalibration begun(bool corrects)
{
  BeamCalibration calibration(corrects);
  calibration.begin(kFirstBin, kBins);
  return calibration;
}

BeamCalibration calibratedBy(Ride& ride, bool corrects)
{
  BeamCalibration calibration = begun(corrects);
  for (int i = 0; i < 400; ++i)
    ride.scan(calibration);
  return calibration;
}

TEST(BeamCalibration, TakesTheOffsetsOff)
{
  Ride ride(alternating({0.01, 1e-3, 2e-3}));
  const BeamCalibration calibration = calibratedBy(ride, true);
  EXPECT_LT(ride.worst(calibration).range, 1.2e-3);
  EXPECT_LT(ride.worst(calibration).elevation, 1e-4);
  EXPECT_LT(ride.worst(calibration).azimuth, 1e-4);
  EXPECT_NEAR(calibration.rangeStd(), 0.01, 5e-4);
  EXPECT_NEAR(calibration.elevationStd(), 1e-3, 5e-5);
  EXPECT_NEAR(calibration.azimuthStd(), 2e-3, 1e-4);
  EXPECT_LT(calibration.covariance().diagonal().maxCoeff(), std::pow(7.5e-3, 2));
}

TEST(BeamCalibration, LeavesAPerfectSensorAlone)
{
  Ride ride(alternating({}));
  const BeamCalibration calibration = calibratedBy(ride, true);
  EXPECT_LT(ride.worst(calibration).range, 3e-4);
  EXPECT_LT(ride.worst(calibration).elevation, 3e-5);
  EXPECT_LT(ride.worst(calibration).azimuth, 3e-5);
  EXPECT_LT(calibration.rangeStd(), 1e-3);
  EXPECT_LT(calibration.elevationStd(), 1e-4);
  EXPECT_LT(calibration.azimuthStd(), 1e-4);
}

TEST(BeamCalibration, KnowsThatALaserDoesNotContradictItself)
{
  // A laser that meets what it has created itself has the same offset twice: nothing shows it.
  BeamCalibration calibration = begun(true);
  const Eigen::MatrixXd before = calibration.covariance();
  PointMeasurement point;
  point.weight = kReturnWeight;
  point.z = 0.01;
  const BeamView view{kFirstBin + 3, {1.0, 5.0, 5.0}};
  for (int i = 0; i < 100; ++i)
  {
    calibration.add(point, view, &view);
    calibration.finishScan(Matrix6::Identity());
  }
  EXPECT_GE(calibration.covariance().diagonal().minCoeff(), before.diagonal().minCoeff());
  EXPECT_LT(Ride(alternating({})).worst(calibration).range, 1e-6) << "rounding";
}

TEST(BeamCalibration, WithoutCorrectionStillKnowsHowLargeTheyAre)
{
  Ride ride(alternating({0.01, 1e-3, 2e-3}));
  const BeamCalibration calibration = calibratedBy(ride, false);
  EXPECT_NEAR(ride.worst(calibration).range, 0.01, 1e-6);
  EXPECT_NEAR(calibration.rangeStd(), 0.01, 5e-4);
  // The whole offset is an error of the scans.
  EXPECT_NEAR(std::sqrt(calibration.covariance()(0, 0)), 0.01, 3e-3);
}

TEST(BeamCalibration, LeavesOtherElevationsAlone)
{
  BeamCalibration calibration = begun(true);
  PointMeasurement point;
  point.weight = kReturnWeight;
  point.z = 0.01;
  for (int i = 0; i < 100; ++i)
  {
    calibration.add(point, {kFirstBin + kBins, {1.0, 0.0, 0.0}}, nullptr);
    calibration.add(point, {kFirstBin - 1, {1.0, 0.0, 0.0}}, nullptr);
    calibration.finishScan(Matrix6::Identity());
  }
  float x = 0.0F, y = 9.0F, z = 1.0F;
  calibration.corrections().apply(x, y, z);
  EXPECT_EQ(y, 9.0F);
  EXPECT_EQ(z, 1.0F);
}
}  // namespace
}  // namespace fastlio
