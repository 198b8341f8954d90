// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/odometry/map_error.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
constexpr double kInformation = 1e4;

/** Half of the weight on planes of each founding; planes without errors of their own. */
GroupedMeasurements scanOn(std::initializer_list<std::uint32_t> foundings)
{
  GroupedMeasurements scan;
  scan.information = kInformation * Matrix6::Identity();
  for (const std::uint32_t born : foundings)
  {
    PlaneGroup& group = scan.groups.emplace_back();
    group.weight = 1.0;
    group.born = born;
  }
  return scan;
}

/** An update that puts the scan wherever the map says: K H = I on the pose. */
LinearizedUpdate fullTrust()
{
  LinearizedUpdate update;
  update.gain.topRows<6>() = Matrix6::Identity() / kInformation;
  return update;
}

FoundingError ownError(double variance)
{
  FoundingError error;
  error.own = variance * Matrix6::Identity();
  return error;
}

Matrix6 poseAddition(const MapErrorModel& model)
{
  return model.addition().topLeftCorner<6, 6>();
}

TEST(MapError, isTheFoundingPosesWhereTheMapIsTrusted)
{
  MapErrorModel model;
  model.recordInsertion(1, ownError(4e-6), {});
  EXPECT_EQ(poseAddition(model).norm(), 0.0);
  model.update(fullTrust(), scanOn({1}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

TEST(MapError, ownErrorsOfScansThatForgetAverageOut)
{
  MapErrorModel model;
  model.recordInsertion(1, ownError(4e-6), {});
  model.update(fullTrust(), scanOn({1}));  // nothing is left of the error before
  model.recordInsertion(2, ownError(4e-6), {});
  model.update(fullTrust(), scanOn({1, 2}));
  EXPECT_LT((poseAddition(model) - 2e-6 * Matrix6::Identity()).norm(), 1e-12);
}

TEST(MapError, ownErrorsThatAreRememberedDoNot)
{
  MapErrorModel model;
  model.recordInsertion(1, ownError(4e-6), {});
  model.recordInsertion(2, ownError(4e-6), {});  // no update between: one and the same error
  model.update(fullTrust(), scanOn({1, 2}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

TEST(MapError, inheritedErrorsAreCommonToAllFoundings)
{
  FoundingError inherited;
  inherited.inherited = 4e-6 * Matrix6::Identity();
  MapErrorModel model;
  model.recordInsertion(1, inherited, {});
  model.update(fullTrust(), scanOn({1}));
  model.recordInsertion(2, inherited, {});
  model.update(fullTrust(), scanOn({1, 2}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

TEST(MapError, staysBoundedOverMoreFoundingsThanAreKept)
{
  MapErrorModel model;
  for (std::uint32_t scan = 1; scan <= 1000; ++scan)
  {
    model.recordInsertion(scan, ownError(4e-6), {});
    model.update(fullTrust(), scanOn({scan, 1 + scan / 2}));
    const double largest = poseAddition(model).diagonal().maxCoeff();
    EXPECT_GT(largest, 1.9e-6);
    EXPECT_LT(largest, 4.1e-6);
  }
}

}  // namespace
}  // namespace fastlio
