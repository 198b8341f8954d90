// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/messages/ros2_definitions.h>

#include <array>
#include <string_view>

namespace fastlio
{
namespace
{
/** A type, its fields, and the types of these that are no numbers or texts. */
struct Definition
{
  std::string_view type, fields;
  std::array<std::string_view, 4> parts;
};

constexpr std::array<Definition, 20> kDefinitions{{
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n", {}},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n", {}},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n", {}},
    {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n", {}},
    {"geometry_msgs/Pose",
     "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n",
     {"geometry_msgs/Point", "geometry_msgs/Quaternion"}},
    {"geometry_msgs/Twist",
     "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n",
     {"geometry_msgs/Vector3"}},
    {"geometry_msgs/PoseWithCovariance",
     "geometry_msgs/Pose pose\nfloat64[36] covariance\n",
     {"geometry_msgs/Pose"}},
    {"geometry_msgs/TwistWithCovariance",
     "geometry_msgs/Twist twist\nfloat64[36] covariance\n",
     {"geometry_msgs/Twist"}},
    {"geometry_msgs/Transform",
     "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n",
     {"geometry_msgs/Vector3", "geometry_msgs/Quaternion"}},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n",
     {"std_msgs/Header", "geometry_msgs/Transform"}},
    {"sensor_msgs/PointField", "string name\nuint32 offset\nuint8 datatype\nuint32 count\n", {}},
    {"sensor_msgs/Imu",
     "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
     "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
     "float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n"
     "float64[9] linear_acceleration_covariance\n",
     {"std_msgs/Header", "geometry_msgs/Quaternion", "geometry_msgs/Vector3"}},
    {"sensor_msgs/PointCloud2",
     "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
     "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n",
     {"std_msgs/Header", "sensor_msgs/PointField"}},
    {"tf2_msgs/TFMessage",
     "geometry_msgs/TransformStamped[] transforms\n",
     {"geometry_msgs/TransformStamped"}},
    {"nav_msgs/Odometry",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
     "geometry_msgs/TwistWithCovariance twist\n",
     {"std_msgs/Header", "geometry_msgs/PoseWithCovariance", "geometry_msgs/TwistWithCovariance"}},
    {"diagnostic_msgs/KeyValue", "string key\nstring value\n", {}},
    {"diagnostic_msgs/DiagnosticStatus",
     "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\n"
     "string message\nstring hardware_id\ndiagnostic_msgs/KeyValue[] values\n",
     {"diagnostic_msgs/KeyValue"}},
    {"diagnostic_msgs/DiagnosticArray",
     "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n",
     {"std_msgs/Header", "diagnostic_msgs/DiagnosticStatus"}},
    {"velodyne_msgs/VelodyneScan",
     "std_msgs/Header header\nvelodyne_msgs/VelodynePacket[] packets\n",
     {"velodyne_msgs/VelodynePacket", "std_msgs/Header"}},
    {"velodyne_msgs/VelodynePacket", "builtin_interfaces/Time stamp\nuint8[1206] data\n", {}},
}};

const Definition* definitionOf(std::string_view type)
{
  for (const Definition& definition : kDefinitions)
    if (definition.type == type) return &definition;
  return nullptr;
}

void addParts(std::string& text, const Definition& definition)
{
  const std::string line = std::string(80, '=') + "\nMSG: ";
  for (const std::string_view part : definition.parts)
  {
    const Definition* found = definitionOf(part);
    if (found == nullptr || text.find("MSG: " + std::string(part) + "\n") != std::string::npos)
      continue;
    text += line + std::string(part) + "\n" + std::string(found->fields);
    addParts(text, *found);
  }
}
}  // namespace

std::string ros2DefinitionOf(const std::string& type)
{
  std::string plain = type;
  if (const auto at = plain.find("/msg/"); at != std::string::npos) plain.erase(at, 4);
  const Definition* definition = definitionOf(plain);
  if (definition == nullptr) return {};
  std::string text(definition->fields);
  addParts(text, *definition);
  return text;
}

}  // namespace fastlio
