// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/consistency.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr double kConfidence = 0.95;

/** e^T P^-1 e; nothing when P is not positive definite. */
template <int N>
std::optional<double> normalizedSquare(
    const Eigen::Matrix<double, N, N>& P, const Eigen::Matrix<double, N, 1>& e)
{
  const Eigen::LLT<Eigen::Matrix<double, N, N>> llt(P);
  if (llt.info() != Eigen::Success) return std::nullopt;
  return llt.matrixL().solve(e).squaredNorm();
}

/** Truth minus estimate in the error state of Trajectory::covariances. */
Eigen::Matrix<double, 6, 1> poseError(const Pose& mean, const Pose& truth)
{
  Eigen::Matrix<double, 6, 1> e;
  e << logSO3(mean.R.transpose() * truth.R), truth.p - mean.p;
  return e;
}

std::optional<NeesSample> sampleOf(
    std::int64_t stamp_ns, const Eigen::Matrix<double, 6, 1>& e, const Matrix6& P)
{
  const auto pose = normalizedSquare<6>(P, e);
  const auto rotation = normalizedSquare<3>(P.topLeftCorner<3, 3>(), e.head<3>());
  const auto position = normalizedSquare<3>(P.bottomRightCorner<3, 3>(), e.tail<3>());
  if (!pose || !rotation || !position) return std::nullopt;
  return NeesSample{stamp_ns, *pose, *position, *rotation};
}

/** World frame of the reference to that of the estimate. */
Pose worldTransform(const AssociatedTrajectories& t, NeesAlignment alignment)
{
  if (alignment == NeesAlignment::None) return {};
  return t.estimate.front().T_world_body * t.reference.front().T_world_body.inverse();
}

double chiSquareQuantile(double probability, double degrees)
{
  return boost::math::quantile(boost::math::chi_squared(degrees), probability);
}

NeesSummary summarizeMember(
    const std::vector<NeesSample>& samples, double NeesSample::*member, int degrees)
{
  std::vector<double> values;
  values.reserve(samples.size());
  for (const NeesSample& sample : samples)
    values.push_back(sample.*member);
  return summarizeNees(values, degrees);
}

}  // namespace

NeesSummary summarizeNees(const std::vector<double>& nees, int degrees)
{
  if (nees.empty()) throw std::invalid_argument("NEES: there is no sample to summarise");
  if (degrees < 1) throw std::invalid_argument("NEES: degrees of freedom must be at least 1");
  NeesSummary s;
  s.count = nees.size();
  s.degrees = degrees;
  const auto n = static_cast<double>(nees.size());
  const double tail = 0.5 * (1.0 - kConfidence);
  s.mean_lower = chiSquareQuantile(tail, n * degrees) / n;
  s.mean_upper = chiSquareQuantile(1.0 - tail, n * degrees) / n;
  s.sample_bound = chiSquareQuantile(kConfidence, degrees);
  for (const double value : nees)
    s.mean += value / n;
  s.coverage =
      static_cast<double>(std::count_if(
          nees.begin(), nees.end(), [&](double value) { return value <= s.sample_bound; })) /
      n;
  return s;
}

std::vector<Deviation> deviations(
    const AssociatedTrajectories& trajectories, NeesAlignment alignment)
{
  const Pose T_est_ref = worldTransform(trajectories, alignment);
  std::vector<Deviation> result;
  result.reserve(trajectories.estimate.size());
  for (std::size_t i = 0; i < trajectories.estimate.size(); ++i)
  {
    Deviation deviation;
    deviation.stamp_ns = trajectories.estimate[i].stamp_ns;
    deviation.error = poseError(
        trajectories.estimate[i].T_world_body, T_est_ref * trajectories.reference[i].T_world_body);
    if (i < trajectories.covariances.size())
      deviation.sigma = trajectories.covariances[i].diagonal().cwiseMax(0.0).cwiseSqrt();
    result.push_back(deviation);
  }
  return result;
}

std::optional<Consistency> consistency(
    const AssociatedTrajectories& trajectories, NeesAlignment alignment)
{
  Consistency result;
  const Pose T_est_ref = worldTransform(trajectories, alignment);
  const std::size_t first = alignment == NeesAlignment::First ? 1 : 0;
  for (std::size_t i = first; i < trajectories.covariances.size(); ++i)
  {
    const StampedPose& mean = trajectories.estimate[i];
    const Pose truth = T_est_ref * trajectories.reference[i].T_world_body;
    const auto sample =
        sampleOf(mean.stamp_ns, poseError(mean.T_world_body, truth), trajectories.covariances[i]);
    if (sample)
      result.samples.push_back(*sample);
    else
      ++result.singular;
  }
  if (result.samples.empty()) return std::nullopt;
  result.pose = summarizeMember(result.samples, &NeesSample::pose, 6);
  result.position = summarizeMember(result.samples, &NeesSample::position, 3);
  result.rotation = summarizeMember(result.samples, &NeesSample::rotation, 3);
  return result;
}

}  // namespace fastlio
