// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "odometry_option_rows.h"
#include <fastlio/math/angles.h>

namespace fastlio
{
namespace
{
OptionTable<DownsamplingOptions> downsamplingRows()
{
  return {
      {"downsampling.target_points", "",
       wholeNumber(&DownsamplingOptions::target_points, 0, 10000000),
       "target number of points per scan, evenly spread over the surfaces; fewer: faster, less "
       "accurate; 0: all",
       OptionTier::Main},
      {"downsampling.wide_points", "", wholeNumber(&DownsamplingOptions::wide_points, 0, 10000000),
       "largest number of points per scan; not more than target_points: every scan uses "
       "target_points"},
  };
}

OptionTable<FeatureOptions> featureRows()
{
  return {
      {"features.mode", "", choice(&FeatureOptions::mode, {"none", "planar", "planar_and_edge"}),
       "none: direct, any point that finds a plane; planar: only points where the scan line is "
       "smooth; planar_and_edge: also sharp bends of the scan line, matched with lines, as in the "
       "paper",
       OptionTier::Main},
      {"features.scan_lines", "",
       choice(&FeatureOptions::scan_lines, {"automatic", "ring", "elevation", "time"}),
       "which points are neighbours: those of one laser (ring field), of one elevation, or that "
       "follow each other in time; automatic: by what the scan has"},
      {"features.half_width", "m", number(&FeatureOptions::half_width, 0.01, 10.0),
       "extent of the neighbours to each side; larger: less noise, small structures are lost; "
       "should be 10 times the noise of a range or more"},
      {"features.max_beam_gap", "deg",
       number(&FeatureOptions::max_beam_gap, 0.001, 90.0, kRadPerDeg),
       "scan lines are cut where beams lie farther apart; must exceed the sensor's step"},
  };
}

OptionTable<MeasurementOptions> measurementRows()
{
  return {
      {"measurement.range_noise", "m", number(&MeasurementOptions::range_noise, 1e-4, 10.0),
       "standard deviation of a measured range", OptionTier::Main},
      {"measurement.min_signal_to_noise", "",
       number(&MeasurementOptions::min_signal_to_noise, 0.0, 1e6),
       "directions of motion whose signal-to-noise ratio is below this are not corrected by the "
       "scan (for example along a tunnel); 0: all are"},
      {"measurement.max_unaided_time", "s", number(&MeasurementOptions::max_unaided_time, 0.0, 1e6),
       "after this time without a scan that matches the map, the status is diverged"},
  };
}

OptionTable<MapOptions> mapRows()
{
  return {
      {"map.type", "", choice(&MapOptions::type, {"planes", "knn"}),
       "planes: voxels at several scales that hold a ready plane, one lookup each; knn: a plane "
       "through the exact nearest points, as in the paper",
       OptionTier::Main},
      {"map.update", "", valueAs<BooleanValue>(&MapOptions::update),
       "false: a map that the run is started in (--map-in) stays as it is; without such a map it "
       "has no effect",
       OptionTier::Main},
      {"map.radius", "m", number(&MapOptions::radius, 1.0, 100000.0),
       "points farther from the sensor than this may leave the map: bounds its memory",
       OptionTier::Main},
      {"map.voxel_size", "m", number(&MapOptions::voxel_size, 0.0, 100.0),
       "map type planes: edge of the finest voxels; two coarser sizes are twice and four times as "
       "wide; 0: 0.4 m, or 0.8 m in wide surroundings where some lasers are several times as far "
       "apart as most",
       OptionTier::Main},
      {"map.output_spacing", "m", number(&MapOptions::output_spacing, 0.01, 100.0),
       "least distance between the points of the saved map; smaller: denser and larger files"},
      {"map.min_spacing", "m", number(&MapOptions::min_spacing, 0.001, 10.0),
       "map type knn: points nearer than this to one in the map are not added"},
  };
}

OptionTable<IterationLimits> updateRows()
{
  return {
      {"update.max_iterations", "", wholeNumber(&IterationLimits::max_iterations, 1, 100),
       "limit of iterations of the update"},
  };
}

OptionTable<RestOptions> restRows()
{
  return {
      {"rest.enabled", "", valueAs<BooleanValue>(&RestOptions::enabled),
       "true: a platform that stands still gets a pseudo-measurement of no velocity, and its scans "
       "do not make the map grow",
       OptionTier::Main},
      {"rest.at_start", "", valueAs<BooleanValue>(&RestOptions::at_start),
       "true: a platform that starts at rest goes on standing still, as with rest.enabled, until "
       "it is not quiet any more"},
      {"rest.duration", "s", number(&RestOptions::duration, 0.2, 600.0),
       "the platform is at rest when it has been quiet for this time"},
      {"rest.max_speed", "m/s", number(&RestOptions::max_speed, 1e-4, 1.0),
       "quiet: trend of the positions; slow steady motion must exceed it"},
  };
}

OptionTable<RecoveryOptions> recoveryRows()
{
  return {
      {"recovery.enabled", "", valueAs<BooleanValue>(&RecoveryOptions::enabled),
       "true: a run that has lost its pose, or its inertial data for longer than imu.max_gap, is "
       "re-initialised, at rest or in motion, with the pose carried over"},
  };
}

OptionTable<OdometryOptions> furtherRows()
{
  return {
      {"output.imu_rate", "", valueAs<BooleanValue>(&OdometryOptions::imu_rate),
       "true: also gives the state at each inertial sample, predicted from the latest scan before "
       "it (imu_rate.csv)",
       OptionTier::Main},
      {"threads", "", wholeNumber(&OdometryOptions::threads, 0, 1024),
       "worker threads; 0: all cores; the results do not depend on it", OptionTier::Main},
      {"gain", "", choice(&OdometryOptions::gain, {"information", "standard"}),
       "form of the Kalman gain, equal results: information is eq. 20, fast for any number of "
       "points; standard is eq. 18, its cost grows with the cube of the number of points"},
  };
}
}  // namespace

OdometryOptionRows estimationRows()
{
  using O = OdometryOptions;
  return joinedRows<O>(
      {rowsOf(downsamplingRows(), &O::downsampling), rowsOf(featureRows(), &O::features),
       rowsOf(measurementRows(), &O::measurement), rowsOf(mapRows(), &O::map),
       rowsOf(updateRows(), &O::update), rowsOf(restRows(), &O::rest),
       rowsOf(recoveryRows(), &O::recovery), furtherRows()});
}

}  // namespace fastlio
