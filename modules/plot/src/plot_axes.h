// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plot_axes.h From the data of a panel to pixels (internal). */
#pragma once

#include <fastlio/plot/svg_plot.h>

namespace fastlio
{
struct PlotAxes
{
  PlotRange x, y;       //!< data
  PlotRectangle inner;  //!< pixels

  [[nodiscard]] double px(double v) const
  {
    return inner.x + inner.width * (v - x.low) / (x.high - x.low);
  }
  [[nodiscard]] double py(double v) const
  {
    return inner.y + inner.height * (1.0 - (v - y.low) / (y.high - y.low));
  }
};

/** Axes that hold everything that is finite in the panel. */
[[nodiscard]] PlotAxes axesOf(const PlotPanel& panel, const PlotRectangle& inner);

}  // namespace fastlio
