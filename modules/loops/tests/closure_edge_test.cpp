// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What a closure measures in the graph: the poses of two submaps, by surfaces that both have.

#include "closure_submaps.h"

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
using testing::closureOf;
using testing::secondPass;
using testing::submapAt;
using testing::surroundings;

constexpr double kAttitudeStd = 0.01;  // of a reference as seen from its surfaces [rad]
constexpr double kPositionStd = 0.1;   // likewise [m]

Submap withUnsureReference(Submap submap)
{
  submap.reference_covariance.diagonal().head<3>().setConstant(kAttitudeStd * kAttitudeStd);
  submap.reference_covariance.diagonal().tail<3>().setConstant(kPositionStd * kPositionStd);
  return submap;
}

/** Covariance of the edge that closes the loop. */
Matrix6 closureCovariance(const Submap& first, const Submap& second)
{
  Mapper mapper;
  mapper.add(first);
  mapper.add(second);
  const MappingResult result = mapper.result();
  EXPECT_EQ(result.accepted(), 1U);
  EXPECT_TRUE(result.graph.edges.back().robust);
  return result.graph.edges.back().measured.covariance;
}
}  // namespace

/** Both references are off from their surfaces, each by its own. */
TEST(ClosureEdge, CountsHowWellBothReferencesAreKnown)
{
  const Submap place = surroundings("campus");
  const Submap first = submapAt(place, 0.0, 0.0, 0.0), second = secondPass(place, 1.0);
  const Matrix6 aligned = closureCovariance(first, second);
  for (const bool both : {false, true})
  {
    const Matrix6 more =
        closureCovariance(withUnsureReference(first), both ? withUnsureReference(second) : second) -
        aligned;
    const double references = both ? 2.0 : 1.0;
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(more(i, i), references * kAttitudeStd * kAttitudeStd, 1e-6) << i;
      EXPECT_NEAR(more(3 + i, 3 + i), references * kPositionStd * kPositionStd, 1e-4) << i;
    }
  }
}

/** Whether a closure is right is judged by its surfaces alone. */
TEST(ClosureEdge, AReferenceDoesNotChangeTheVerdict)
{
  const Submap place = surroundings("campus");
  const Closure closure = closureOf(
      {withUnsureReference(submapAt(place, 0.0, 0.0, 0.0)),
       withUnsureReference(secondPass(place, 1.0))});
  EXPECT_EQ(closure.verdict, ClosureVerdict::Accepted) << closure.reason;
  EXPECT_LT(closure.registration.motion.covariance(5, 5), 0.1 * kPositionStd * kPositionStd);
}

}  // namespace fastlio
