// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file registration_rivals_test.cpp Places that look the same: along the direction that the
 * surfaces tell least, and across it. */

#include <fastlio/map/voxel_plane_map.h>
#include <fastlio/submaps/registration.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace fastlio
{
namespace
{
/** Points of upright rectangles and of a floor. */
class Scene
{
 public:
  Scene() { rectangle({-20.0, -5.5, -1.5}, {40.0, 0.0, 0.0}, {0.0, 11.0, 0.0}, 0.2); }

  void wall(const Vec3& from, const Vec3& along) { rectangle(from, along, {0.0, 0.0, 4.0}, 0.08); }

  [[nodiscard]] std::vector<VoxelPlane> planes() const
  {
    VoxelPlaneMap map(VoxelPlaneOptions{});
    map.insert(points_, Vec3::Zero());
    return map.bestPlanes();
  }

 private:
  void rectangle(const Vec3& from, const Vec3& one, const Vec3& other, double spacing)
  {
    for (double a = 0.0; a < 1.0; a += spacing / one.norm())
      for (double b = 0.0; b < 1.0; b += spacing / other.norm())
      {
        const Vec3 p = from + a * one + b * other;
        points_.x.push_back(static_cast<float>(p.x() + noise_(engine_)));
        points_.y.push_back(static_cast<float>(p.y() + noise_(engine_)));
        points_.z.push_back(static_cast<float>(p.z() + noise_(engine_)));
      }
  }

  std::mt19937 engine_{7};
  std::normal_distribution<double> noise_{0.0, 0.005};
  WorldPoints points_;
};

RegistrationEvidence evidenceOfItself(const Scene& scene)
{
  const auto planes = scene.planes();
  RelativePose predicted;
  predicted.T_a_b.p.x() = 0.1;
  predicted.covariance = 1e-4 * Matrix6::Identity();
  predicted.covariance.diagonal().tail<3>().setConstant(0.8 * 0.8);
  const Registration found = SubmapRegistration(planes).search(planes, predicted, Vec3::UnitZ());
  EXPECT_TRUE(found.converged);
  return found.evidence;
}
}  // namespace

/** A street with pillars every metre: one metre on, all but its ends looks the same. */
TEST(SubmapRegistration, RivalsAlongTheWeakDirectionCountApart)
{
  Scene street;
  street.wall({-20.0, 6.0, -1.5}, {40.0, 0.0, 0.0});
  street.wall({-20.0, -5.0, -1.5}, {40.0, 0.0, 0.0});
  for (int pillar = -20; pillar < 20; ++pillar)
    street.wall({static_cast<double>(pillar), 5.0, -1.5}, {0.0, 1.0, 0.0});
  const RegistrationEvidence evidence = evidenceOfItself(street);
  EXPECT_NEAR(std::abs(evidence.rival.x()), 1.0, 0.05);
  EXPECT_LT(evidence.rival.tail<2>().norm(), 0.05);
  EXPECT_GT(evidence.margin_across, 5.0 * evidence.margin);
}

/** Many short shelves in rows: in the next row nearly everything looks the same, and that is
 * another place. */
TEST(SubmapRegistration, RivalsAcrossTheWeakDirectionAreRivals)
{
  Scene rows;
  for (int row = -20; row <= 20; ++row)
    rows.wall({static_cast<double>(row), -5.0, -1.5}, {0.0, 10.0, 0.0});
  const RegistrationEvidence evidence = evidenceOfItself(rows);
  EXPECT_NEAR(std::abs(evidence.rival.x()), 1.0, 0.05);
  EXPECT_LT(evidence.rival.tail<2>().norm(), 0.05);
  EXPECT_EQ(evidence.margin_across, evidence.margin);
}

}  // namespace fastlio
