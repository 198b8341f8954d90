// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bridge_recording.h"

#include <fastlio/math/time.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/xyzirt_access.h>

namespace fastlio::testing
{
mrpt::obs::CObservationPointCloud::Ptr cloudAt(
    double seconds, const std::string& label, const std::vector<float>& times)
{
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  cloud->sensorLabel = label;
  cloud->timestamp = fastlio::toMrptTime(kStart + toNanoseconds(seconds));
  cloud->sensorPose = mrpt::poses::CPose3D(0, 0, 1, 0, 0, 0);
  cloud->pointcloud = fastlio::makeXyzirt(
      fastlio::CloudColumns{{1, 2}, {1, 2}, {1, 2}, {}, {}, {times.begin(), times.end()}, true});
  return cloud;
}

std::vector<Object> recording(int scans)
{
  std::vector<Object> objects;
  for (int i = 0; i < scans; ++i)
  {
    objects.push_back(cloudAt(0.1 * i));
    for (int k = 0; k < 20; ++k)
      objects.push_back(imuAt(0.1 * i + 0.005 * k));
  }
  return objects;
}

std::string BridgeTest::fileOf(const std::vector<Object>& objects)
{
  std::string name = folder_.file("log.rawlog");
  write(name, gzip(serialize(objects)));
  return name;
}

fastlio::SensorSelection BridgeTest::select(
    const std::vector<Object>& objects, const fastlio::SensorPatterns& patterns)
{
  return fastlio::selectSensors(fastlio::surveySensors({fileOf(objects)}, patterns), patterns);
}

}  // namespace fastlio::testing
