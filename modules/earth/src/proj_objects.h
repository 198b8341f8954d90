// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file proj_objects.h PROJ's contexts and objects with an owner. */
#pragma once

#include <memory>
#include <proj.h>

namespace fastlio
{
struct DestroyProj
{
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
  void operator()(PJ* object) const { proj_destroy(object); }
  void operator()(PJ_OPERATION_FACTORY_CONTEXT* how) const
  {
    proj_operation_factory_context_destroy(how);
  }
  void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
};
using ProjContext = std::unique_ptr<PJ_CONTEXT, DestroyProj>;
using ProjObject = std::unique_ptr<PJ, DestroyProj>;
using ProjOperations = std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, DestroyProj>;
using ProjList = std::unique_ptr<PJ_OBJ_LIST, DestroyProj>;

}  // namespace fastlio
