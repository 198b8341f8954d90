// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/map/register_classes.h>
#include <fastlio/pointmap/incremental_points_map.h>

#include <mrpt/core/initializer.h>
#include <mrpt/rtti/CObject.h>

MRPT_INITIALIZER(registerFastlioMapClasses)
{
  fastlio::registerMapClasses();
}

namespace fastlio
{
void registerMapClasses()
{
  mrpt::rtti::registerClass(CLASS_ID(fastlio::CIncrementalPointsMap));
  mrpt::rtti::registerClass(CLASS_ID(fastlio::CVoxelPlanesMap));
}

}  // namespace fastlio
