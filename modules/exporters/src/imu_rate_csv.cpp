// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/split_text.h>

#include <Eigen/Geometry>

namespace fastlio
{
namespace
{
constexpr int kVelocityDecimals = 6;

std::string imuRateHeader(const std::string& frame)
{
  return "# Pose and velocity of the " + frame +
         " frame in the world at each inertial sample, predicted from the latest scan before it,\n"
         "# and the covariance of the pose as in covariance.csv. Velocity in the world frame "
         "[m/s].\n"
         "stamp_ns,x,y,z,qx,qy,qz,qw,vx,vy,vz," +
         joined(covarianceColumns(), ",") + "\n";
}

/** Velocity of the body's origin, in the world: v + R (w x p_imu_body). */
Vec3 bodyVelocity(const ImuRateState& state, const Vec3& p_imu_body)
{
  return state.x.v + state.x.R * state.angular_rate.cross(p_imu_body);
}

class ImuRateExporter : public Exporter
{
 public:
  ImuRateExporter(const std::string& path, const OutputFrame& frame)
      : file_(path), T_imu_body_(frame.T_imu_body)
  {
    file_.write(imuRateHeader(frame.name));
  }

  void onImuRate(const std::vector<ImuRateState>& states) override
  {
    for (const ImuRateState& state : states)
      writeRow(state);
  }

  std::vector<OutputFile> finish(const RunEnd& /*end*/) override { return {file_.commit()}; }

 private:
  void writeRow(const ImuRateState& state)
  {
    const PoseEstimate estimate =
        poseEstimateOf(state.x.pose(), state.pose_covariance, T_imu_body_);
    std::string row =
        std::to_string(state.stamp_ns) + "," + poseColumns(estimate.T_world_body, ',');
    const Vec3 velocity = bodyVelocity(state, T_imu_body_.p);
    for (const double v : {velocity.x(), velocity.y(), velocity.z()})
      row += "," + fixedText(v, kVelocityDecimals);
    file_.write(row + covarianceText(estimate.covariance) + "\n");
  }

  AtomicFile file_;
  Pose T_imu_body_;
};
}  // namespace

std::unique_ptr<Exporter> makeImuRateExporter(const std::string& path, const OutputFrame& frame)
{
  return std::make_unique<ImuRateExporter>(path, frame);
}

}  // namespace fastlio
