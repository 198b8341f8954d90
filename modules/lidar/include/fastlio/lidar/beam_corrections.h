// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file beam_corrections.h Known errors that the beams of one elevation share: their range is off
 * by a constant, or their elevation, or their azimuth. Points do not name their laser in every
 * format, but its elevation does. */
#pragma once

#include <fastlio/lidar/scan.h>

#include <array>
#include <cstddef>
#include <vector>

namespace fastlio
{
/** Bins are as wide in the sine of the elevation as 2 deg at the horizon, where an edge is. The
 * lasers of a VLP-16 are 2 deg apart, at odd degrees: in the middle of a bin. Denser LiDARs have
 * several in a bin, whose mean counts. */
inline constexpr std::size_t kBeamBins = 58;
inline constexpr double kBeamBinsPerUnit = 28.65;  // 1 / sin(2 deg)

/** The bin of a beam, by the sine of its elevation. */
[[nodiscard]] inline std::size_t beamBin(double sine)
{
  return static_cast<std::size_t>(sine * kBeamBinsPerUnit + 0.5 * kBeamBins);
}
/** The elevation in the middle of a bin [rad]. */
[[nodiscard]] double beamElevation(std::size_t bin);

/** Errors of the beams of a laser: LiDAR less truth. */
struct BeamOffset
{
  double range = 0.0;      //!< [m]
  double elevation = 0.0;  //!< upward [rad]
  double azimuth = 0.0;    //!< about the z axis of the LiDAR [rad]
};

/** Takes known offsets off the points of scans. */
class BeamCorrections
{
 public:
  /** \param rows of elevation [deg], offset of the range [m] and of the elevation [deg]: LiDAR less
   * truth; of several rows in one bin the last one counts */
  explicit BeamCorrections(const std::vector<double>& rows = {});

  void set(std::size_t bin, const BeamOffset& offset);

  /** Of one point, in the LiDAR frame. \return its bin, before it was corrected */
  std::size_t apply(float& x, float& y, float& z) const;

  /** In the LiDAR frame. */
  void apply(PointColumns& points) const;

 private:
  struct Offset
  {
    float range = 0.0F, elevation = 0.0F, azimuth = 0.0F;  // [m], [rad]
  };
  bool any_ = false;
  std::array<Offset, kBeamBins> offsets_{};
};

}  // namespace fastlio
