// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "faults.h"

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace fastlio::testing
{
namespace
{
using mrpt::obs::CObservation;
using mrpt::obs::CObservationIMU;
using Predicate = std::function<bool(const CObservation&)>;

bool isImu(const CObservation& o)
{
  return o.sensorLabel == "imu";
}
bool isLidar(const CObservation& o)
{
  return o.sensorLabel == "lidar";
}
bool isAny(const CObservation& /*o*/)
{
  return true;
}

double secondsOf(const CObservation& o, const Observations& all)
{
  return mrpt::system::timeDifference(all.front()->timestamp, o.timestamp);
}

void shift(CObservation& o, double seconds)
{
  o.timestamp +=
      std::chrono::duration_cast<mrpt::Clock::duration>(std::chrono::duration<double>(seconds));
  if (auto* scan = dynamic_cast<mrpt::obs::CObservationVelodyneScan*>(&o))
    scan->originalReceivedTimestamp = scan->timestamp;
}

Injection dropped(Predicate of, double probability)
{
  return [=](Observations& all, Random& random)
  {
    all.erase(
        std::remove_if(
            all.begin() + 1, all.end(),
            [&](const auto& o) { return of(*o) && chance(random, probability); }),
        all.end());
  };
}

/** Nothing of a sensor in a span of time [s]. */
Injection gap(Predicate of, double begin, double end)
{
  return [=](Observations& all, Random& /*random*/)
  {
    const Observations before = all;
    all.erase(
        std::remove_if(
            all.begin() + 1, all.end(),
            [&](const auto& o)
            {
              const double t = secondsOf(*o, before);
              return of(*o) && t > begin && t < end;
            }),
        all.end());
  };
}

Injection duplicated(double probability)
{
  return [=](Observations& all, Random& random)
  {
    Observations twice;
    for (const auto& o : all)
      twice.insert(twice.end(), chance(random, probability) ? 2U : 1U, o);
    all = twice;
  };
}

/** Observations come so many places later. */
Injection late(const Predicate& of, double probability, std::size_t places)
{
  return [=](Observations& all, Random& random)
  {
    for (std::size_t i = all.size(); i-- > 0;)
    {
      if (!of(*all[i]) || !chance(random, probability)) continue;
      const auto from = all.begin() + static_cast<std::ptrdiff_t>(i);
      const auto to =
          all.begin() + static_cast<std::ptrdiff_t>(std::min(i + places, all.size() - 1));
      std::rotate(from, from + 1, to + 1);
    }
  };
}

Injection eachImu(double probability, const std::function<void(CObservationIMU&, Random&)>& change)
{
  return [=](Observations& all, Random& random)
  {
    for (const auto& o : all)
      if (auto* imu = dynamic_cast<CObservationIMU*>(o.get()))
        if (chance(random, probability)) change(*imu, random);
  };
}

/** One of the six channels gets a value. */
Injection imuValue(double probability, std::vector<double> values)
{
  return eachImu(
      probability,
      [values = std::move(values)](CObservationIMU& imu, Random& random)
      {
        constexpr mrpt::obs::TIMUDataIndex kChannels[] = {
            mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC, mrpt::obs::IMU_Z_ACC,
            mrpt::obs::IMU_WX,    mrpt::obs::IMU_WY,    mrpt::obs::IMU_WZ};
        imu.set(kChannels[random() % 6], values[random() % values.size()]);
      });
}

Injection imuScaled(double accel, double gyro)
{
  return eachImu(
      1.0,
      [=](CObservationIMU& imu, Random& /*random*/)
      {
        for (const auto i : {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC, mrpt::obs::IMU_Z_ACC})
          imu.set(i, accel * imu.get(i));
        for (const auto i : {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ})
          imu.set(i, gyro * imu.get(i));
      });
}

Injection imuClipped(double accel, double gyro)
{
  return eachImu(
      1.0,
      [=](CObservationIMU& imu, Random& /*random*/)
      {
        for (const auto i : {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC, mrpt::obs::IMU_Z_ACC})
          imu.set(i, std::clamp(imu.get(i), -accel, accel));
        for (const auto i : {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ})
          imu.set(i, std::clamp(imu.get(i), -gyro, gyro));
      });
}

/** Stamps of single observations are wrong by so many seconds, to one side or the other. */
Injection wrongStamps(const Predicate& of, double probability, double seconds)
{
  return [=](Observations& all, Random& random)
  {
    for (const auto& o : all)
      if (of(*o) && chance(random, probability))
        shift(*o, chance(random, 0.5) ? seconds : -seconds);
  };
}

/** From a time on, all stamps of a sensor differ. */
Injection clockSet(const Predicate& of, double from, double seconds)
{
  return [=](Observations& all, Random& /*random*/)
  {
    std::vector<bool> later;
    for (const auto& o : all)
      later.push_back(of(*o) && secondsOf(*o, all) > from);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (later[i]) shift(*all[i], seconds);
  };
}

Injection relabelled(const Predicate& of, double from, const std::string& label)
{
  return [=](Observations& all, Random& /*random*/)
  {
    for (const auto& o : all)
      if (of(*o) && secondsOf(*o, all) > from) o->sensorLabel = label;
  };
}

/** Bytes of packets are random. */
Injection brokenPackets(double probability)
{
  return [=](Observations& all, Random& random)
  {
    for (const auto& o : all)
      if (auto* scan = dynamic_cast<mrpt::obs::CObservationVelodyneScan*>(o.get()))
        for (auto& packet : scan->scan_packets)
          if (chance(random, probability))
            for (int k = 0; k < 20; ++k)
              reinterpret_cast<unsigned char*>(&packet)[random() % sizeof(packet)] =
                  static_cast<unsigned char>(random());
  };
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kHour = 3600.0;
std::vector<ObservationFault> faultsOfDelivery()
{
  return {
      {"inertial samples dropped, 1 %", dropped(isImu, 0.01), 1.5, 0.95, "samples missing"},
      {"inertial samples dropped, 30 %", dropped(isImu, 0.3), 3.0, 0.95, "samples missing"},
      {"scans dropped, 10 %", dropped(isLidar, 0.1), 1.5, 0.8, "missing in between"},
      {"scans dropped, 50 %", dropped(isLidar, 0.5), 2.0, 0.35, "missing in between"},
      {"inertial gap of 0.3 s in motion", gap(isImu, 5.0, 5.3), 3.0, 0.95, "1 gap .longest 0.3"},
      {"inertial gap of 1 s in motion", gap(isImu, 5.0, 6.0), 60.0, 0.95, "1 gap .longest 1.0"},
      {"inertial gap of 1 s at rest", gap(isImu, 1.0, 2.0), 3.0, 0.5, "1 gap .longest 1.0"},
      {"no scans for 2 s in motion", gap(isLidar, 5.0, 7.0), 5.0, 0.6, "missing in between"},
      {"no inertial samples at all", dropped(isImu, 1.0), 0.0, 0.0, "no inertial data"},
      {"inertial data end early", gap(isImu, 6.0, 100.0), 50.0, 0.55,
       "could not be processed: .* without inertial data"},
      {"everything duplicated", duplicated(1.0), 1.01, 1.0, "imu_duplicate"},
      {"observations duplicated, 5 %", duplicated(0.05), 1.01, 1.0, "imu_duplicate"},
      {"inertial samples late by 5 places", late(isImu, 0.05, 5), 1.01, 1.0},
      {"scans late by 0.1 s", late(isLidar, 0.3, 20), 1.01, 0.95},
      {"scans late by 1 s", late(isLidar, 0.1, 210), 1.5, 0.8, "scans_out_of_order"},
      {"inertial samples late by 1 s", late(isImu, 0.02, 210), 1.5, 0.95, "imu_out_of_order"},
  };
}

std::vector<ObservationFault> faultsOfReadings()
{
  return {
      {"NaN and infinity in inertial samples, 2 %", imuValue(0.02, {kNaN, kInf, -kInf}), 1.5, 0.95,
       "imu_not_finite"},
      {"huge inertial values, 1 %", imuValue(0.01, {1e6, -1e12, 1e300, -1e308}), 2.0, 0.95,
       "spikes"},
      {"inertial spikes, 1 %", imuValue(0.01, {300.0, -300.0}), 2.0, 0.95, "spikes"},
      {"channels exchanged for zero, 1 %", imuValue(0.01, {0.0}), 5.0, 0.95,
       "inertial samples scatter more"},
      {"accelerometer in g", imuScaled(1.0 / 9.80665, 1.0), 1.2, 1.0, "in units of g"},
      {"gyro in deg/s", imuScaled(1.0, 180.0 / M_PI), 5.0, 0.1, "in deg/s, not in rad/s"},
      {"gyro clipped at 20 deg/s", imuClipped(1e9, 0.35), 300.0, 0.9,
       "the gyro clips at 0.35 rad/s"},
      {"accelerometer clipped at 10 m/s^2", imuClipped(10.0, 1e9), 100.0, 0.9,
       "the accelerometer clips at 10 m/s"},
      {"gyro clipped at 45 deg/s", imuClipped(1e9, 0.785), 30.0, 0.9,
       "the gyro clips at 0.785 rad/s"},
      {"accelerometer clipped at 11 m/s^2", imuClipped(11.0, 1e9), 30.0, 0.9,
       "the accelerometer clips at 11 m/s"},
  };
}

std::vector<ObservationFault> faultsOfStampsAndLabels()
{
  return {
      {"wrong stamps of inertial samples, 1 %", wrongStamps(isImu, 0.01, kHour), 1.5, 0.95,
       "imu_bad_stamp"},
      {"wrong stamps of scans, 5 %", wrongStamps(isLidar, 0.05, kHour), 1.5, 0.8,
       "scans_without_imu|scans_bad_stamp|scans_out_of_order"},
      {"stamps wrong by 300 years, 1 %", wrongStamps(isAny, 0.01, 1e10), 2.0, 0.35,
       "imu_bad_stamp"},
      {"clock set back by an hour", clockSet(isAny, 5.0, -kHour), 2.0, 0.9, "clock was set back"},
      {"clock set forward by an hour", clockSet(isAny, 5.0, kHour), 0.0, 0.6,
       "without inertial samples"},
      {"inertial clock set forward by an hour", clockSet(isImu, 5.0, kHour), 0.0, 0.2,
       "without inertial samples"},
      {"LiDAR clock set back by an hour", clockSet(isLidar, 5.0, -kHour), 0.0, 0.2,
       "could not be processed: .* stamped before others"},
      {"LiDAR exchanged for another label", relabelled(isLidar, 5.0, "lidar2"), 3.0, 0.4,
       "no scans follow"},
      {"IMU exchanged for another label", relabelled(isImu, 5.0, "imu2"), 50.0, 0.4,
       "could not be processed: .* without inertial data"},
      {"labels exchanged",
       [](Observations& all, Random& /*random*/)
       {
         for (const auto& o : all)
           o->sensorLabel = isImu(*o) ? "lidar" : "imu";
       },
       0.0, 0.0, "No usable LiDAR has a label that matches 'lidar'"},
      {"random bytes in packets, 20 %", brokenPackets(0.2), 2.0, 0.85, "packet_blocks_corrupt"},
      {"scans without points, 20 %", emptyScans(0.2), 2.0, 0.7, "scans_empty"},
  };
}
}  // namespace

std::vector<ObservationFault> observationFaults()
{
  std::vector<ObservationFault> all;
  for (const auto& faults : {faultsOfDelivery(), faultsOfReadings(), faultsOfStampsAndLabels()})
    all.insert(all.end(), faults.begin(), faults.end());
  return all;
}

}  // namespace fastlio::testing
