// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file velodyne_packets.h Velodyne packets made byte by byte, as the manuals lay them out. */
#pragma once

#include <fastlio/lidar/scan.h>

#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstdint>
#include <vector>

namespace fastlio::testing
{
constexpr std::size_t kBlocks = 12, kReturns = 32;

using Packet = mrpt::obs::CObservationVelodyneScan::TVelodyneRawPacket;

/** All blocks with header 0xEEFF, azimuths from \a azimuth on in steps of \a step [0.01 deg] per \a
 * group of blocks, all returns with the same distance [2 mm] and intensity. */
Packet makePacket(
    std::uint16_t azimuth, std::uint16_t step, std::uint32_t time_us, std::uint16_t distance,
    std::uint8_t mode = 0x37, std::uint8_t model = 0x22, std::size_t group = 1);

void setHeader(Packet& packet, std::size_t block, std::uint16_t header);
void setAzimuth(Packet& packet, std::size_t block, std::uint16_t azimuth);
void setReturn(
    Packet& packet, std::size_t block, std::size_t index, std::uint16_t distance,
    std::uint8_t intensity = 100);

/** A scan of these packets with MRPT's calibration of the VLP-16. */
mrpt::obs::CObservationVelodyneScan::Ptr makeVlp16Scan(const std::vector<Packet>& packets);

constexpr double kDegree = 0.017453292519943295;

/** Spherical coordinates of a point [m], [deg]; azimuth clockwise from x, as Velodyne counts, in
 * [0, 360).
 * @{ */
double rangeOf(const fastlio::PointColumns& points, std::size_t i);
double elevationOf(const fastlio::PointColumns& points, std::size_t i);
double azimuthOf(const fastlio::PointColumns& points, std::size_t i);
/** @} */

}  // namespace fastlio::testing
