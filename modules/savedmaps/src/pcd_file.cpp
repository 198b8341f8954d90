// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "pcd_file.h"

#include <fastlio/recordings/pcd_reader.h>

#include <stdexcept>

namespace fastlio
{
FilePoints readPcd(const std::string& path)
{
  constexpr std::size_t kPiece = 65536;  // points
  FilePoints points;
  try
  {
    PcdReader reader(path);
    for (PointGrid piece = reader.next(kPiece); piece.width > 0; piece = reader.next(kPiece))
    {
      const auto x = valuesOf(piece, reader.fields(), "x");
      const auto y = valuesOf(piece, reader.fields(), "y");
      const auto z = valuesOf(piece, reader.fields(), "z");
      for (std::size_t i = 0; i < piece.width; ++i)
        points.add({x[i], y[i], z[i]});
    }
  }
  catch (const std::runtime_error& e)
  {
    throw std::runtime_error("PCD file '" + path + "' " + e.what());
  }
  return points;
}

}  // namespace fastlio
