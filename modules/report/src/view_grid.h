// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file view_grid.h A view of a map as cells (internal). */
#pragma once

#include <fastlio/plot/svg_plot.h>

#include <array>
#include <cstddef>
#include <vector>

namespace fastlio
{
/** Colours of the heights, from low to high. */
constexpr std::array<const char*, 7> kHeightColours = {"#3b6fd4", "#2aa0c9", "#2fa86f", "#8fb53a",
                                                       "#d9a91f", "#e8832b", "#d3452c"};

/** Room for the content of a view on the page [px], about. */
constexpr double kViewWidth = 400.0, kViewHeight = 340.0;

/** Edge of a cell on the page [px]. */
constexpr double kPixelsPerCell = 2.5;

/** Cells of one view, row by row: their number is that of the view's pixels, whatever the map. */
class ViewGrid
{
 public:
  /** \param stretch one unit is drawn so many times as long upwards as across
   * \param pixels of a cell's edge */
  ViewGrid(
      const PlotRange& across, const PlotRange& up, double stretch = 1.0,
      double pixels = kPixelsPerCell);

  void add(double across, double up, double height);

  /** The cells that hold points, by their mean height; the more points, the more is seen. */
  [[nodiscard]] std::vector<PlotCells> cells(const PlotRange& heights) const;

  [[nodiscard]] const PlotRange& across() const { return x_; }
  [[nodiscard]] const PlotRange& up() const { return y_; }
  [[nodiscard]] double stretch() const { return stretch_; }

 private:
  struct Cell
  {
    double height = 0.0;  //!< sum
    std::size_t count = 0;
  };

  [[nodiscard]] PlotPoint centreOf(std::size_t cell) const;
  [[nodiscard]] std::array<std::size_t, 2> crowdLimits() const;

  PlotRange x_, y_;
  double stretch_;
  double width_;   //!< of a cell [m]
  double height_;  //!< likewise
  std::size_t columns_;
  std::vector<Cell> cells_;
};

}  // namespace fastlio
