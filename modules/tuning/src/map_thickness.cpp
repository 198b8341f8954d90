// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/map_thickness.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <unordered_map>

namespace fastlio
{
namespace
{
constexpr double kCell0 = 0.8;       // [m]
constexpr double kSmallCell = 0.1;  // [m]
constexpr std::size_t kLeastPoints = 15;
constexpr double kFlat = 0.1;      // thickness by width of a surface, at most
constexpr double kRevisit = 10.0;  // [s]

struct Moments
{
  std::size_t count = 0;
  Vec3 sum = Vec3::Zero();
  Mat3 squares = Mat3::Zero();
  double first = INFINITY, last = -INFINITY;
};

std::uint64_t keyOf(const Vec3& p, double size)
{
  std::uint64_t key = 0;
  for (int i = 0; i < 3; ++i)
    key = (key << 21U) |
          (static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(p[i] / size))) &
           0x1FFFFFU);
  return key;
}

}  // namespace

MapSharpness mapSharpness(const std::vector<TimedPoint>& points, double kCell)
{
  std::unordered_map<std::uint64_t, Moments> cells;
  std::unordered_map<std::uint64_t, bool> small;
  for (const TimedPoint& point : points)
  {
    Moments& cell = cells[keyOf(point.position, kCell)];
    const Vec3 local = point.position - kCell * (point.position / kCell).array().floor().matrix();
    ++cell.count;
    cell.sum += local;
    cell.squares += local * local.transpose();
    cell.first = std::min(cell.first, point.time);
    cell.last = std::max(cell.last, point.time);
    small[keyOf(point.position, kSmallCell)] = true;
  }
  MapSharpness result;
  double squares = 0.0, weight = 0.0, revisit = 0.0, revisit_weight = 0.0, entropy = 0.0,
         entropy_weight = 0.0;
  for (const auto& [key, cell] : cells)
  {
    if (cell.count < kLeastPoints) continue;
    const auto n = static_cast<double>(cell.count);
    const Vec3 mean = cell.sum / n;
    const Mat3 covariance = cell.squares / n - mean * mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance);
    const Vec3 values = solver.eigenvalues().cwiseMax(1e-8);
    entropy += std::log(values.prod());
    entropy_weight += 1;
    if (values[0] > kFlat * kFlat * values[1]) continue;
    squares += values[0];
    weight += 1;
    result.surfaces += 1;
    if (cell.last - cell.first > kRevisit) revisit += values[0], revisit_weight += 1;
  }
  if (weight > 0) result.thickness = std::sqrt(squares / weight);
  if (revisit_weight > 0) result.revisit = std::sqrt(revisit / revisit_weight);
  if (entropy_weight > 0) result.entropy = entropy / entropy_weight;
  result.cells = static_cast<double>(small.size());
  return result;
}

std::vector<TimedPoint> readRunMap(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  std::size_t count = 0;
  bool wide = false;
  std::string line;
  while (std::getline(in, line) && line != "end_header")
  {
    if (line.rfind("element vertex ", 0) == 0) count = std::stoul(line.substr(15));
    wide = wide || line == "property double x";
  }
  if (!in) throw std::runtime_error("'" + path + "' is no map of a run");
  const std::size_t size = (wide ? 24 : 12) + 4 + 8;
  std::vector<TimedPoint> points(count);
  std::string bytes(size, '\0');
  for (TimedPoint& point : points)
  {
    if (!in.read(bytes.data(), static_cast<std::streamsize>(size)))
      throw std::runtime_error("'" + path + "' is cut short");
    if (wide)
      std::memcpy(point.position.data(), bytes.data(), 24);
    else
    {
      Eigen::Vector3f narrow;
      std::memcpy(narrow.data(), bytes.data(), 12);
      point.position = narrow.cast<double>();
    }
    std::memcpy(&point.time, bytes.data() + size - 8, 8);
  }
  return points;
}

}  // namespace fastlio
