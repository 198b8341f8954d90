// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Places where upright surfaces are others in each pass, as those of leaves and trunks.

#include "closure_submaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace fastlio
{
namespace
{
using testing::closureOf;
using testing::secondPass;
using testing::streetWithoutCorners;
using testing::submapAt;
using testing::surroundings;

/** The same submap with two of three upright planes turned about the vertical. */
Submap withOtherLeaves(Submap submap)
{
  SubmapSurfaces surfaces = *submap.surfaces.get();
  std::size_t upright = 0;
  for (VoxelPlane& plane : surfaces.planes)
  {
    if (std::abs(plane.nz) > 0.5F || upright++ % 3 == 0) continue;
    const Vec3 turned =
        expSO3({0, 0, 1.0 + 0.3 * static_cast<double>(upright % 3)}) * plane.normal();
    plane.nx = static_cast<float>(turned.x());
    plane.ny = static_cast<float>(turned.y());
  }
  submap.surfaces = StoredSurfaces(std::make_shared<SubmapStore>(), std::move(surfaces));
  return submap;
}

/** \param std how well the odometry knows the place on its second pass [m] */
Closure closureWithOtherLeaves(const Submap& place, double std)
{
  return closureOf({submapAt(place, 0.0, 0.0, 0.0), withOtherLeaves(secondPass(place, std))});
}
}  // namespace

TEST(UprightSurfaces, AreFewerAmongLeavesThatAreKnownOtherwise)
{
  const Closure closure = closureWithOtherLeaves(surroundings("park"), 1.0);
  const RegistrationEvidence& found = closure.registration.evidence;
  ASSERT_GT(found.overlap, ClosureLimits{}.min_overlap);
  ASSERT_LT(found.upright_score, ClosureLimits{}.min_upright);
  EXPECT_EQ(closure.verdict, ClosureVerdict::Accepted) << closure.reason;
  EXPECT_LT(closure.registration.motion.T_a_b.p.norm(), 0.02);
}

/** The ground fits anywhere. */
TEST(UprightSurfaces, HaveToAgreeWhereThePlaceIsUncertain)
{
  const Submap park = surroundings("park");
  const double std = 1.1 * ClosureLimits{}.maxStd(park.range);
  EXPECT_EQ(closureWithOtherLeaves(park, std).verdict, ClosureVerdict::LittleOverlap);
}

/** The ground and one wall fit anywhere along it. */
TEST(UprightSurfaces, HaveToAgreeWhereADirectionStaysOpen)
{
  const Closure closure = closureWithOtherLeaves(streetWithoutCorners(), 1.0);
  ASSERT_LT(closure.registration.evidence.upright_score, ClosureLimits{}.min_upright);
  EXPECT_NE(closure.verdict, ClosureVerdict::Accepted) << closure.reason;
}

/** The next room has the same floor. */
TEST(UprightSurfaces, HaveToAgreeInNarrowPlaces)
{
  const Closure closure = closureWithOtherLeaves(surroundings("office"), 0.4);
  EXPECT_EQ(closure.verdict, ClosureVerdict::LittleOverlap) << closure.reason;
}

}  // namespace fastlio
