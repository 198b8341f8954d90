// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// How accurate a fix of sensor_msgs/NavSatFix is.

#include "wire_writer.h"
#include <fastlio/messages/ros_messages.h>
#include <fastlio/sensors/gnss_accuracy.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
namespace
{
using testing::Wire;

const std::vector<double> kCovariance{0.25, 0.1, 0.0, 0.1, 4.0, 0.0, 0.0, 0.0, 9.0};

std::optional<Vec3> stated(
    const std::vector<double>& covariance, std::uint8_t type, std::int8_t status = 0,
    Wire wire = Wire::Cdr)
{
  const std::string bytes =
      testing::navSatFixMessage(wire, 1'700'000'000'000'000'000, covariance, type, status);
  WireReader in(
      reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
      wire == Wire::Ros1 ? WireFormat::Ros1 : WireFormat::Cdr);
  const auto fix = readNavSatFix(in, "label");
  return statedStdOf(dynamic_cast<const mrpt::obs::CObservationGPS&>(*fix.observation));
}
}  // namespace

TEST(NavSatFix, KeepsTheCovarianceThatIsKnown)
{
  for (const Wire wire : {Wire::Ros1, Wire::Cdr, Wire::CdrBigEndian})
    for (const std::uint8_t type : std::vector<std::uint8_t>{1, 2, 3})
    {
      const auto std = stated(kCovariance, type, 0, wire);
      ASSERT_TRUE(std) << int{type};
      EXPECT_LT((*std - Vec3(0.5, 2.0, 3.0)).norm(), 1e-6) << int{type};
    }
}

TEST(NavSatFix, HasNoAccuracyWhereItsCovarianceIsUnknown)
{
  EXPECT_FALSE(stated(kCovariance, 0));
  EXPECT_FALSE(stated(std::vector<double>(9, 0.0), 2));
  std::vector<double> bad = kCovariance;
  bad[8] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(stated(bad, 3));
  bad[8] = -1.0;
  EXPECT_FALSE(stated(bad, 3));
}

TEST(NavSatFix, WithoutAPositionHasNoAccuracy)
{
  EXPECT_FALSE(stated(kCovariance, 2, -1));
}

}  // namespace fastlio
