// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_rows.h"

namespace fastlio
{
ParameterRows downsamplingRows()
{
  return {
      {"downsampling.target_points", "",
       IntegerValue{[](auto& p) { return &p.downsampling.target_points; }, 0, 10000000},
       "about so many points of a scan are used, evenly spread over the surfaces; fewer: faster, "
       "less accurate; 0: all"},
      {"downsampling.wide_range", "m",
       RealValue{[](auto& p) { return &p.downsampling.wide_range; }, 0.1, 1e6},
       "scans with a larger RMS range use more than target_points, in proportion to its square, as "
       "their surfaces are larger"},
      {"downsampling.wide_points", "",
       IntegerValue{[](auto& p) { return &p.downsampling.wide_points; }, 0, 10000000},
       "but about so many at most; not more than target_points: all scans use target_points"},
  };
}

ParameterRows measurementRows()
{
  return {
      {"measurement.range_noise", "m",
       RealValue{[](auto& p) { return &p.measurement.range_noise; }, 1e-4, 10.0},
       "standard deviation of a measured range"},
      {"measurement.max_normalized_residual", "",
       RealValue{[](auto& p) { return &p.measurement.max_normalized_residual; }, 0.1, 1e6},
       "a point is left out when its residual exceeds so many standard deviations of residual and "
       "prediction"},
      {"measurement.robust_kernel", "",
       enumeration(
           [](auto& p) { return &p.measurement.robust_kernel; },
           {"none", "huber", "cauchy", "geman_mcclure"}),
       "weight of large residuals within the gate: none weighs all alike, huber lets them pull "
       "with constant force, cauchy and geman_mcclure with less and less"},
      {"measurement.robust_scale", "",
       RealValue{[](auto& p) { return &p.measurement.robust_scale; }, 0.1, 1000.0},
       "residual, in standard deviations, from which on the robust kernel acts"},
      {"measurement.min_signal_to_noise", "",
       RealValue{[](auto& p) { return &p.measurement.min_signal_to_noise; }, 0.0, 1e6},
       "a direction of motion whose information is less than so many times that which noise in the "
       "normals of the map feigns (along a tunnel) is not corrected by the scan; 0: all are"},
      {"measurement.min_effective_points", "",
       IntegerValue{[](auto& p) { return &p.measurement.min_effective_points; }, 1, 1000000},
       "with fewer matched points the scan does not correct the prediction"},
      {"measurement.association_iterations", "",
       IntegerValue{[](auto& p) { return &p.measurement.association_iterations; }, 1, 100},
       "so many iterations of the update search the map anew, the further ones keep the planes"},
      {"measurement.max_unaided_time", "s",
       RealValue{[](auto& p) { return &p.measurement.max_unaided_time; }, 0.0, 1e6},
       "after so long without a scan that matches the map, the pose is reported as diverged"},
  };
}

ParameterRows mapRows()
{
  return {
      {"map.type", "",
       enumeration([](auto& p) { return &p.map.type; }, {"planes", "knn", "kdtree"}),
       "planes: voxels at several scales that hold a ready plane, one lookup each; knn: a plane "
       "through the exact nearest points, as in the paper; kdtree: the same through nanoflann, "
       "rebuilt for each scan, slow: the reference"},
      {"map.update", "", BooleanValue{[](auto& p) { return &p.map.update; }},
       "false: a map that the run is started in (--map-in) stays as it is; without such a map it "
       "has no effect"},
      {"map.output_spacing", "m",
       RealValue{[](auto& p) { return &p.map.output_spacing; }, 0.01, 100.0},
       "least distance between the points of the map that is saved; smaller: denser and larger "
       "files"},
      {"map.radius", "m", RealValue{[](auto& p) { return &p.map.radius; }, 1.0, 100000.0},
       "points farther from the sensor than this may leave the map: bounds its memory"},
      {"map.max_insertion_std", "m",
       RealValue{[](auto& p) { return &p.map.max_insertion_std; }, 0.0, 1e6},
       "a scan that does not match still joins the map while the predicted position is known "
       "better than this: lets a young map grow, keeps a lost one clean"},
      {"map.min_spacing", "m", RealValue{[](auto& p) { return &p.map.min_spacing; }, 0.001, 10.0},
       "map types knn and kdtree: points nearer than this to one in the map are not added"},
      {"map.voxel_size", "m", RealValue{[](auto& p) { return &p.map.voxel_size; }, 0.01, 100.0},
       "map type planes: edge of the finest voxels; two coarser sizes are twice and four times as "
       "wide"},
      {"map.min_incidence", "", RealValue{[](auto& p) { return &p.map.min_incidence; }, 0.0, 1.0},
       "map type planes: a plane whose normal has a smaller cosine to its mean beam is not used: "
       "grazing beams make bad planes"},
      {"map.max_thickness", "m",
       RealValue{[](auto& p) { return &p.map.max_thickness; }, 0.001, 10.0},
       "map type planes: points that scatter more than this across their plane make none"},
  };
}

ParameterRows updateRows()
{
  return {
      {"update.max_iterations", "",
       IntegerValue{[](auto& p) { return &p.update.max_iterations; }, 1, 100},
       "limit of iterations of the update"},
      {"update.attitude", "rad", RealValue{[](auto& p) { return &p.update.attitude; }, 0.0, 1.0},
       "the update has converged when no component of a step exceeds its threshold: attitude"},
      {"update.position", "m", RealValue{[](auto& p) { return &p.update.position; }, 0.0, 10.0},
       "threshold of convergence of the position"},
      {"update.velocity", "m/s", RealValue{[](auto& p) { return &p.update.velocity; }, 0.0, 10.0},
       "threshold of convergence of the velocity"},
      {"update.gyro_bias", "rad/s",
       RealValue{[](auto& p) { return &p.update.gyro_bias; }, 0.0, 1.0},
       "threshold of convergence of the gyro bias"},
      {"update.accel_bias", "m/s^2",
       RealValue{[](auto& p) { return &p.update.accel_bias; }, 0.0, 10.0},
       "threshold of convergence of the accelerometer bias"},
      {"update.gravity", "m/s^2", RealValue{[](auto& p) { return &p.update.gravity; }, 0.0, 10.0},
       "threshold of convergence of gravity"},
  };
}

ParameterRows generalRows()
{
  return {
      {"gain", "", enumeration([](auto& p) { return &p.gain; }, {"information", "standard"}),
       "form of the Kalman gain, equal results: information is eq. 20, fast for any number of "
       "points; standard is eq. 18, its cost grows with the cube of the number of points"},
      {"threads", "", IntegerValue{[](auto& p) { return &p.threads; }, 0, 1024},
       "worker threads; 0: all cores; the results do not depend on it"},
  };
}

}  // namespace fastlio
