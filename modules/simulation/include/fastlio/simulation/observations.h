// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file observations.h Simulated data as the observations that MRPT's drivers would record. */
#pragma once

#include <fastlio/simulation/simulation.h>

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

namespace fastlio
{
/** Sensor labels of all simulated recordings. */
constexpr const char* kImuLabel = "imu";
constexpr const char* kLidarLabel = "lidar";
constexpr const char* kGnssLabel = "gnss";
constexpr const char* kWheelsLabel = "wheels";

/** Angular rate and specific force; the sensor pose is the identity, the vehicle frame being that
 * of the IMU. */
[[nodiscard]] mrpt::obs::CObservationIMU::Ptr toImuObservation(const ImuSample& sample);

/** A fix as a GGA message: latitude, longitude, altitude above the geoid, the geoid's height, their
 * sum, satellites, HDOP and quality: 4 (RTK) for a noise below 0.1 m, 2 (DGPS) below 0.6 m, else 1;
 * 0 in an outage, whose coordinates are 0. The sensor pose is the lever arm. Where MRPT's class has
 * a covariance_enu, it is that of the noise. */
[[nodiscard]] mrpt::obs::CObservationGPS::Ptr toGnssObservation(
    const SimulatedFix& fix, const GnssSettings& settings);

/** Pose in the plane since the start and velocity ahead and of the turn. */
[[nodiscard]] mrpt::obs::CObservationOdometry::Ptr toWheelObservation(const WheelReading& reading);

/** A sweep of a VLP-16 as raw packets: ranges in units of 2 mm, azimuths of 0.01 deg, times of 1 us
 * past the hour; strongest return. Ranges beyond what a packet can hold (131 m) are no returns. */
[[nodiscard]] mrpt::obs::CObservationVelodyneScan::Ptr toVelodyneScan(
    const FiredSweep& fired, const SimulationSettings& settings);

/** Sweep number index in the class that its sensor's recordings have: CObservationVelodyneScan for
 * vlp16, CObservationPointCloud with CPointsMapXYZIRT for the others; or what lidar.cloud says. */
[[nodiscard]] mrpt::obs::CObservation::Ptr toLidarObservation(
    const Simulation& simulation, std::size_t index);

}  // namespace fastlio
