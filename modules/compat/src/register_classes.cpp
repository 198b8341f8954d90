// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/CGenericPointsMap.h>
#include <fastlio/compat/CPointsMapXYZIRT.h>
#include <fastlio/compat/newer_points_maps.h>
#include <fastlio/compat/register_classes.h>

#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/registerAllClasses.h>
#include <mrpt/rtti/CObject.h>

namespace
{
bool registerOnce()
{
  mrpt::maps::registerAllClasses_mrpt_maps();
  mrpt::obs::registerAllClasses_mrpt_obs();
  mrpt::rtti::registerClass(CLASS_ID_NAMESPACE(CPointsMapXYZIRT, mrpt::maps));
  mrpt::rtti::registerClass(CLASS_ID_NAMESPACE(CGenericPointsMap, mrpt::maps));
  fastlio::registerNewerPointsMaps();
  return true;
}
}  // namespace

namespace fastlio
{
void registerBridgeClasses()
{
  // Initialised once, also when threads race for it.
  [[maybe_unused]] static const bool kRegistered = registerOnce();
}

}  // namespace fastlio
