// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_matching.h"
#include <fastlio/matching/plane_groups.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

namespace fastlio
{
namespace
{
constexpr std::uint32_t kPlanes = 40;
constexpr double kRelative = 1e-9;

Matching onFewPlanes(unsigned seed, std::size_t n)
{
  Matching m = randomMatching(seed, n);
  Random random(seed + 1000);
  for (PlaneMatch& match : m.matches)
  {
    match.plane = static_cast<std::uint32_t>(random.uniform(0.0, kPlanes));
    match.created_insertion = match.plane / 3;
    match.shared_variance = float(random.uniform(1e-6, 1e-5));
  }
  return m;
}

ResidualModel narrow()
{
  ResidualModel model;
  model.gate = 1.0;  // a good part of the points fails it
  return model;
}

/** PlaneGroup and the sums by their definitions, point by point. */
struct Definition
{
  Matrix6 information = Matrix6::Zero(), shared_noise = Matrix6::Zero();
  std::map<std::uint32_t, Vector6> g;
  std::map<std::uint32_t, double> weight, shared;
};

Definition definition(const Matching& m, const ResidualModel& model)
{
  Definition d;
  for (std::size_t i = 0; i < m.body.size(); ++i)
  {
    const PlaneMatch& match = m.matches[i];
    if (!match.valid()) continue;
    const PlaneMeasurement one = planeMeasurement(m.x.pose(), m.body, i, match, model);
    if (!isConsistent(one, model)) continue;
    const double w = 1.0 / one.variance, s = match.shared_variance;
    const Matrix6 square = one.h * one.h.transpose();
    d.information += w * square;
    d.shared_noise += w * w * s * square;
    d.g.try_emplace(match.plane, Vector6::Zero()).first->second += w * one.h;
    d.weight[match.plane] += w;
    d.shared[match.plane] += w * s;
  }
  return d;
}

TEST(PlaneGrouping, IsTheSumsByPlane)
{
  const ResidualModel model = narrow();
  for (const std::size_t n : {1, 7, 8, 9, 255, 600, 1025})
  {
    const Matching m = onFewPlanes(static_cast<unsigned>(n), n);
    const Definition expected = definition(m, model);
    PlaneGrouping grouping;
    const GroupedMeasurements& grouped = grouping.group(Workers(1), measured(m, model), m.matches);
    const double scale = kRelative * expected.information.norm();
    EXPECT_LE((grouped.information - expected.information).norm(), scale) << n << " points";
    EXPECT_LE(
        (grouped.shared_noise - expected.shared_noise).norm(),
        kRelative * expected.shared_noise.norm());
    EXPECT_EQ(grouped.groups.size(), expected.g.size());
  }
}

TEST(PlaneGrouping, GivesEachPlaneItsPointsInTheOrderOfTheFirst)
{
  const ResidualModel model = narrow();
  const Matching m = onFewPlanes(3, 800);
  const Definition expected = definition(m, model);
  PlaneGrouping grouping;
  const auto& groups = grouping.group(Workers(1), measured(m, model), m.matches).groups;
  std::vector<std::uint32_t> planes;
  for (std::size_t i = 0; i < m.matches.size(); ++i)
  {
    const PlaneMatch& match = m.matches[i];
    if (!match.valid()) continue;
    const PlaneMeasurement one = planeMeasurement(m.x.pose(), m.body, i, match, model);
    if (!isConsistent(one, model)) continue;
    if (std::find(planes.begin(), planes.end(), match.plane) == planes.end())
      planes.push_back(match.plane);
  }
  ASSERT_EQ(groups.size(), planes.size());
  for (std::size_t k = 0; k < planes.size(); ++k)
  {
    const std::uint32_t plane = planes[k];
    const Vector6& g = expected.g.at(plane);
    EXPECT_LE((groups[k].g - g).norm(), kRelative * g.norm());
    EXPECT_NEAR(groups[k].weight, expected.weight.at(plane), kRelative * groups[k].weight);
    EXPECT_NEAR(
        groups[k].shared_variance, expected.shared.at(plane) / expected.weight.at(plane), 1e-12);
    EXPECT_EQ(groups[k].created_insertion, plane / 3);
  }
}

// The planes' errors come into the sums of two scans alike where these see the same planes alike.
TEST(PlaneGrouping, KnowsWhatTheErrorsOfTheScanBeforeHaveInCommon)
{
  const ResidualModel model = narrow();
  const Matching m = onFewPlanes(4, 400);
  PlaneGrouping grouping;
  const auto again = [&](const std::vector<PlaneMatch>& matches) -> const GroupedMeasurements&
  { return grouping.group(Workers(1), measured(m.x.pose(), m.body, matches, model), matches); };
  EXPECT_EQ(again(m.matches).plane_errors_before.norm(), 0.0);
  const GroupedMeasurements& same = again(m.matches);
  Matrix6 of_planes = Matrix6::Zero();
  for (const PlaneGroup& group : same.groups)
    of_planes += group.shared_variance * group.g * group.g.transpose();
  EXPECT_LT((same.plane_errors - of_planes).norm(), 1e-12 * of_planes.norm());
  EXPECT_LT((same.plane_errors_before - of_planes).norm(), 1e-12 * of_planes.norm());
  const std::vector<PlaneMatch> none(m.matches.size());
  EXPECT_EQ(again(none).plane_errors_before.norm(), 0.0);
  EXPECT_EQ(again(m.matches).plane_errors_before.norm(), 0.0);
}

TEST(PlaneGrouping, LeavesOutWhatIsNoNumber)
{
  const ResidualModel model = narrow();
  Matching m = onFewPlanes(5, 64);
  m.body.x[10] = std::numeric_limits<float>::quiet_NaN();
  m.matches[20].shared_variance = std::numeric_limits<float>::quiet_NaN();
  m.matches[20].d = 1e6F;  // far outside of the gate
  PlaneGrouping grouping;
  const GroupedMeasurements& grouped = grouping.group(Workers(1), measured(m, model), m.matches);
  EXPECT_TRUE(grouped.information.allFinite());
  EXPECT_TRUE(grouped.shared_noise.allFinite());
}

TEST(PlaneGrouping, IsTheSameOnSeveralThreads)
{
  const ResidualModel model = narrow();
  const Matching m = onFewPlanes(6, 2000);
  const MeasuredScan scan = measured(m, model);
  PlaneGrouping one, several;
  const GroupedMeasurements& a = one.group(Workers(1), scan, m.matches);
  const GroupedMeasurements& b = several.group(Workers(3), scan, m.matches);
  EXPECT_EQ(a.information, b.information);
  EXPECT_EQ(a.shared_noise, b.shared_noise);
  ASSERT_EQ(a.groups.size(), b.groups.size());
  for (std::size_t k = 0; k < a.groups.size(); ++k)
    EXPECT_EQ(a.groups[k].g, b.groups[k].g);
}
}  // namespace
}  // namespace fastlio
