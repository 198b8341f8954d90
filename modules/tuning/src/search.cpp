// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/search.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace fastlio
{
namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

/** Own formulas: those of the standard library differ between its versions. */
class Random
{
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double uniform() { return static_cast<double>(bits_() >> 11U) * 0x1p-53; }
  double normal()
  {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * M_PI * uniform());
  }

 private:
  std::mt19937_64 bits_;
};

/** One batch of points that no score changes. */
class FixedSearch : public Search
{
 public:
  explicit FixedSearch(std::vector<Places> points) : points_(std::move(points)) {}
  std::vector<Places> ask() override { return std::exchange(points_, {}); }
  void tell(const std::vector<double>& /*scores*/) override {}

 private:
  std::vector<Places> points_;
};

double mirrored(double x)
{
  const double folded = std::fmod(std::abs(x), 2.0);
  return folded > 1.0 ? 2.0 - folded : folded;
}

/** Constants that follow from the number of keys; names as in Hansen's tutorial. */
struct CmaConstants
{
  explicit CmaConstants(double n)
      : lambda(4 + static_cast<std::size_t>(3.0 * std::log(n))), weights(lambda / 2)
  {
    for (Eigen::Index i = 0; i < weights.size(); ++i)
      weights[i] =
          std::log(0.5 * static_cast<double>(lambda + 1)) - std::log(static_cast<double>(i + 1));
    weights /= weights.sum();
    mu_eff = 1.0 / weights.squaredNorm();
    c_sigma = (mu_eff + 2) / (n + mu_eff + 5);
    damping = 1 + 2 * std::max(0.0, std::sqrt((mu_eff - 1) / (n + 1)) - 1) + c_sigma;
    c_c = (4 + mu_eff / n) / (n + 4 + 2 * mu_eff / n);
    c_1 = 2 / ((n + 1.3) * (n + 1.3) + mu_eff);
    c_mu = std::min(1 - c_1, 2 * (mu_eff - 2 + 1 / mu_eff) / ((n + 2) * (n + 2) + mu_eff));
    expected_length = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
  }
  std::size_t lambda;
  VectorXd weights;
  double mu_eff, c_sigma, damping, c_c, c_1, c_mu, expected_length;
};

class CmaesSearch : public Search
{
 public:
  CmaesSearch(std::size_t keys, std::size_t budget, std::uint64_t seed)
      : constants_(static_cast<double>(keys)),
        left_(budget),
        random_(seed),
        mean_(VectorXd::Constant(static_cast<Eigen::Index>(keys), 0.5)),
        path_sigma_(VectorXd::Zero(mean_.size())),
        path_c_(VectorXd::Zero(mean_.size())),
        covariance_(MatrixXd::Identity(mean_.size(), mean_.size()))
  {
  }

  std::vector<Places> ask() override
  {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(covariance_);
    const VectorXd root = solver.eigenvalues().cwiseMax(1e-14).cwiseSqrt();
    inverse_root_ = solver.eigenvectors() * root.cwiseInverse().asDiagonal() *
                    solver.eigenvectors().transpose();
    points_.clear();
    const std::size_t count = std::min(left_, constants_.lambda);
    for (std::size_t k = 0; k < count; ++k)
    {
      VectorXd z(mean_.size());
      for (double& element : z)
        element = random_.normal();
      const VectorXd step = solver.eigenvectors() * root.cwiseProduct(z);
      const VectorXd x = mean_ + sigma_ * step;
      points_.emplace_back(x.unaryExpr(&mirrored));
    }
    left_ -= count;
    std::vector<Places> places;
    for (const VectorXd& x : points_)
      places.emplace_back(x.begin(), x.end());
    return places;
  }

  void tell(const std::vector<double>& scores) override
  {
    if (points_.size() < constants_.lambda) return;  // the budget's rest: nothing follows
    std::vector<std::size_t> order(points_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(
        order.begin(), order.end(), [&](auto a, auto b) { return scores[a] < scores[b]; });
    update(order);
  }

 private:
  void update(const std::vector<std::size_t>& order)
  {
    const CmaConstants& c = constants_;
    VectorXd shift = VectorXd::Zero(mean_.size());
    MatrixXd spread = MatrixXd::Zero(mean_.size(), mean_.size());
    for (Eigen::Index i = 0; i < c.weights.size(); ++i)
    {
      const VectorXd y = (points_[order[static_cast<std::size_t>(i)]] - mean_) / sigma_;
      shift += c.weights[i] * y;
      spread += c.weights[i] * y * y.transpose();
    }
    mean_ += sigma_ * shift;
    path_sigma_ = (1 - c.c_sigma) * path_sigma_ +
                  std::sqrt(c.c_sigma * (2 - c.c_sigma) * c.mu_eff) * (inverse_root_ * shift);
    path_c_ = (1 - c.c_c) * path_c_ + std::sqrt(c.c_c * (2 - c.c_c) * c.mu_eff) * shift;
    covariance_ = (1 - c.c_1 - c.c_mu) * covariance_ + c.c_1 * path_c_ * path_c_.transpose() +
                  c.c_mu * spread;
    sigma_ *= std::exp(c.c_sigma / c.damping * (path_sigma_.norm() / c.expected_length - 1));
    sigma_ = std::clamp(sigma_, 1e-9, 1.0);
  }

  CmaConstants constants_;
  std::size_t left_;
  Random random_;
  VectorXd mean_, path_sigma_, path_c_;
  MatrixXd covariance_, inverse_root_;
  double sigma_ = 0.3;
  std::vector<VectorXd> points_;
};
}  // namespace

std::unique_ptr<Search> gridSearch(const std::vector<std::size_t>& steps)
{
  std::vector<Places> points(1);
  for (const std::size_t count : steps)
  {
    std::vector<Places> longer;
    for (const Places& point : points)
      for (std::size_t i = 0; i < count; ++i)
      {
        longer.push_back(point);
        longer.back().push_back(
            count == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(count - 1));
      }
    points = std::move(longer);
  }
  return std::make_unique<FixedSearch>(std::move(points));
}

std::unique_ptr<Search> randomSearch(std::size_t keys, std::size_t budget, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Places> points(budget, Places(keys));
  for (Places& point : points)
    for (double& place : point)
      place = random.uniform();
  return std::make_unique<FixedSearch>(std::move(points));
}

std::unique_ptr<Search> cmaesSearch(std::size_t keys, std::size_t budget, std::uint64_t seed)
{
  return std::make_unique<CmaesSearch>(keys, budget, seed);
}

}  // namespace fastlio
