// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mrpt_scene.h MRPT's 3D scene by the name that the version at hand gives it. */
#pragma once

#if __has_include(<mrpt/opengl/Scene.h>)
#include <mrpt/opengl/Scene.h>
#else
#include <mrpt/opengl/COpenGLScene.h>
#endif

namespace fastlio
{
#if __has_include(<mrpt/opengl/Scene.h>)
using MrptScene = mrpt::opengl::Scene;
#else
using MrptScene = mrpt::opengl::COpenGLScene;
#endif

}  // namespace fastlio
