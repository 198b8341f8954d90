// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/submaps/place_recognition.h>

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/FFT>

namespace fastlio
{
namespace
{
constexpr int kSize = BirdsEyeView::kCells;
constexpr int kHeadings = 45;            // of a full turn: 8 deg apart
constexpr float kUpright = 0.5F;         // |n_z| of what counts
constexpr float kMostPerCell = 6.0F;     // more surfaces in a cell are no more of a landmark
constexpr double kMiddle = 0.5 * kSize;  // of a view [cells]
constexpr int kFarthest = kSize / 4;     // between the frames [cells]
constexpr std::size_t kNeighbours = 3;   // places whose numbers are this near are one

std::size_t at(int row, int column)
{
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(kSize) +
         static_cast<std::size_t>(column);
}

using Spectrum = BirdsEyeView::Spectrum;

/** Transforms rows, then columns, in place. */
void transform(Spectrum& grid, bool inverse)
{
  thread_local Eigen::FFT<float> fft;
  Spectrum line(static_cast<std::size_t>(kSize)), out(line.size());
  const auto apply = [&](const auto& index)
  {
    for (int i = 0; i < kSize; ++i)
    {
      for (int j = 0; j < kSize; ++j)
        line[static_cast<std::size_t>(j)] = grid[index(i, j)];
      if (inverse)
        fft.inv(out, line);
      else
        fft.fwd(out, line);
      for (int j = 0; j < kSize; ++j)
        grid[index(i, j)] = out[static_cast<std::size_t>(j)];
    }
  };
  apply([](int i, int j) { return at(i, j); });
  apply([](int i, int j) { return at(j, i); });
}

/** Where two views agree best. */
struct Peak
{
  int row = 0, column = 0;  //!< signed
  float value = 0.0F;
};

Peak peakOf(const Spectrum& place, const Spectrum& query)
{
  Spectrum product(place.size());
  for (std::size_t i = 0; i < place.size(); ++i)
    product[i] = place[i] * std::conj(query[i]);
  transform(product, true);
  Peak peak;
  for (int row = -kFarthest; row <= kFarthest; ++row)
    for (int column = -kFarthest; column <= kFarthest; ++column)
    {
      const float value = product[at((row + kSize) % kSize, (column + kSize) % kSize)].real();
      if (value > peak.value) peak = {row, column, value};
    }
  return peak;
}
}  // namespace

BirdsEyeView::BirdsEyeView(
    const std::vector<VoxelPlane>& planes, const Mat3& R_level_submap, double cell, double heading)
    : cells_(static_cast<std::size_t>(kCells) * kCells, 0.0F)
{
  const Mat3 R = expSO3({0.0, 0.0, heading}) * R_level_submap;
  for (const VoxelPlane& plane : planes)
  {
    const Vec3 n = R * plane.normal();
    if (std::abs(n.z()) > static_cast<double>(kUpright)) continue;
    const Vec3 q = R * plane.centroid();
    const double column = std::floor(q.x() / cell) + kMiddle;
    const double row = std::floor(q.y() / cell) + kMiddle;
    if (column < 0 || row < 0 || column >= kCells || row >= kCells) continue;
    float& value = cells_[at(static_cast<int>(row), static_cast<int>(column))];
    value = std::min(value + 1.0F, kMostPerCell);
  }
}

BirdsEyeView::Spectrum BirdsEyeView::spectrum() const
{
  double sum = 0.0, energy = 0.0;
  for (const float value : cells_)
    sum += static_cast<double>(value);
  const auto mean = static_cast<float>(sum / static_cast<double>(cells_.size()));
  for (const float value : cells_)
    energy += std::pow(static_cast<double>(value - mean), 2);
  const auto scale = static_cast<float>(energy > 0.0 ? 1.0 / std::sqrt(energy) : 0.0);
  Spectrum grid(cells_.size());
  for (std::size_t i = 0; i < grid.size(); ++i)
    grid[i] = (cells_[i] - mean) * scale;
  transform(grid, false);
  return grid;
}

void PlaceIndex::add(const std::vector<VoxelPlane>& planes, const Mat3& R_level_submap)
{
  spectra_.push_back(BirdsEyeView(planes, R_level_submap, cell_).spectrum());
}

std::vector<PlaceMatch> PlaceIndex::find(
    const std::vector<VoxelPlane>& planes, const Mat3& R_level_submap, std::size_t most) const
{
  std::vector<PlaceMatch> best(spectra_.size());
  for (int i = 0; i < kHeadings; ++i)
  {
    const double heading = kTwoPi * i / kHeadings;
    const Spectrum query = BirdsEyeView(planes, R_level_submap, cell_, heading).spectrum();
    for (std::size_t place = 0; place < spectra_.size(); ++place)
    {
      const Peak peak = peakOf(spectra_[place], query);
      if (static_cast<double>(peak.value) <= best[place].similarity) continue;
      best[place] = {
          place,
          {expSO3({0.0, 0.0, heading}), {peak.column * cell_, peak.row * cell_, 0.0}},
          static_cast<double>(peak.value)};
    }
  }
  std::stable_sort(
      best.begin(), best.end(),
      [](const PlaceMatch& a, const PlaceMatch& b) { return a.similarity > b.similarity; });
  std::vector<PlaceMatch> chosen;
  for (const PlaceMatch& match : best)
  {
    const auto is_near = [&match](const PlaceMatch& other) {
      return std::max(match.place, other.place) - std::min(match.place, other.place) < kNeighbours;
    };
    if (match.similarity <= 0.0 || std::any_of(chosen.begin(), chosen.end(), is_near)) continue;
    chosen.push_back(match);
    if (chosen.size() == most) break;
  }
  return chosen;
}

Mat3 levelingRotation(const Mat3& R_world_submap)
{
  const double heading = std::atan2(R_world_submap(1, 0), R_world_submap(0, 0));
  return expSO3({0.0, 0.0, -heading}) * R_world_submap;
}

}  // namespace fastlio
