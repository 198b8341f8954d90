// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/own_body.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/so3.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr float kBodyEnd = 2.0F;  // a body ends before it [m]
constexpr float kSame = 0.06F;    // clothes move, ranges have noise [m]
constexpr float kMargin = 0.15F;  // of the mask: folds, and the edges of a cell [m]

// A scan is looked at when the LiDAR has moved so far, and not every one of a fast ride.
constexpr double kStep = 0.3;                // [m]
constexpr double kTurn = 10.0 * kRadPerDeg;  // [rad]
constexpr int kScansBetweenLooks = 5;
constexpr std::size_t kEnoughPoints = 4000;  // of a scan: more do not fill more cells

// Points are not deskewed: while the LiDAR moves faster between two scans, places are not judged.
constexpr double kSlowStep = 0.15;              // [m]
constexpr double kSlowTurn = 5.0 * kRadPerDeg;  // [rad]

// A place is looked at again from at least so far away, and up to so far.
constexpr double kLeastParallax = 1.0, kFarthestPlace = 8.0;  // [m]
// Beams that end so much farther have passed through it; so much nearer, they do not reach it [m].
constexpr float kClear = 0.3F;

// What makes a cell one of the body: so many scans, nearly all with the same range, and places that
// were empty later, in it and in the cells around it.
// The nine cells around a direction are seen empty in the same scan at best: twelve take two.
constexpr int kLeastSame = 12, kLeastEmpty = 12;
constexpr int kSamePerOther = 8, kEmptyPerFilled = 4;
constexpr int kSameBeforePlace = 3;

constexpr int kQuietLooks = 10;          // without more of the body, before it is reported
constexpr std::size_t kFewestCells = 3;  // that are worth a report

bool differs(const Pose& a, const Pose& b, double step, double turn)
{
  return (a.p - b.p).norm() > step || logSO3(a.R.transpose() * b.R).norm() > turn;
}
}  // namespace

void OwnBody::look(const PointColumns& points)
{
  if (!due_) return;
  due_ = false;
  looked_ = true;
  nearest_.assign(DirectionCells::kCount, 0.0F);
  cells_.resize(DirectionCells::kCount);
  // Odd, so that all lasers have their turn where they follow each other.
  const std::size_t stride = points.size() / kEnoughPoints | 1U;
  for (std::size_t i = 0; i < points.size(); i += stride)
  {
    const float x = points.x[i], y = points.y[i], z = points.z[i];
    const float squared = x * x + y * y + z * z;
    if (!(squared > 0.0F) || !std::isfinite(squared)) continue;
    float& nearest = nearest_[DirectionCells::of(x, y, z)];
    if (nearest == 0.0F || squared < nearest * nearest) nearest = std::sqrt(squared);
  }
}

std::size_t OwnBody::mask(PointColumns& points) const
{
  if (!found()) return 0;
  constexpr float kLimit = (kBodyEnd + kMargin) * (kBodyEnd + kMargin);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const float x = points.x[i], y = points.y[i], z = points.z[i];
    const float squared = x * x + y * y + z * z;
    if (squared > 0.0F && squared < kLimit)
    {
      const float range = body_range_[DirectionCells::of(x, y, z)];
      if (range > 0.0F && std::abs(std::sqrt(squared) - range) < kMargin) continue;
    }
    if (kept < i) points.copy(i, kept);
    ++kept;
  }
  const std::size_t masked = points.size() - kept;
  points.resize(kept);
  return masked;
}

void OwnBody::judge(const Pose& T_world_lidar, bool tracked)
{
  if (looked_ && tracked)
  {
    judgeCells(T_world_lidar);
    looked_from_ = T_world_lidar;
    scans_since_look_ = 0;
  }
  else if (!tracked)
    for (Cell& cell : cells_)
      cell.waits = false;  // the world may be another one from here on
  looked_ = false;
  before_ = T_world_lidar;
  ++scans_since_look_;
  due_ = cells_.empty() || (scans_since_look_ >= kScansBetweenLooks &&
                            differs(T_world_lidar, looked_from_, kStep, kTurn));
}

void OwnBody::judgeCells(const Pose& T_world_lidar)
{
  const bool slow = !differs(T_world_lidar, before_, kSlowStep, kSlowTurn);
  ++looks_since_found_;
  for (std::size_t i = 0; i < cells_.size(); ++i)
  {
    Cell& cell = cells_[i];
    if (cell.body || (cell.same == 0 && !(nearest_[i] > 0.0F && nearest_[i] < kBodyEnd))) continue;
    judgeRange(cell, nearest_[i]);
    if (slow) judgePlace(cell, DirectionCells::middle(i), T_world_lidar);
    if (stays(cell) && wasSeenEmpty(i)) addToBody(i);
  }
}

bool OwnBody::stays(const Cell& cell)
{
  return cell.same >= kLeastSame && cell.same >= kSamePerOther * cell.other;
}

/** With the cells around that stay at about the same range: the LiDAR turns rarely. */
bool OwnBody::wasSeenEmpty(std::size_t index) const
{
  const Cell& own = cells_[index];
  if (own.empty == 0) return false;
  int empty = 0, filled = 0;
  for (const std::size_t near : DirectionCells::around(index))
  {
    const Cell& cell = cells_[near];
    if (!stays(cell) || std::abs(cell.range - own.range) > kMargin) continue;
    empty += cell.empty;
    filled += cell.filled;
  }
  return empty >= kLeastEmpty && empty >= kEmptyPerFilled * filled;
}

/** A cell without a return tells nothing. */
void OwnBody::judgeRange(Cell& cell, float range) const
{
  if (range == 0.0F) return;
  if (cell.same > 0 && std::abs(range - cell.range) < kSame)
  {
    ++cell.same;
    cell.range += (range - cell.range) / static_cast<float>(std::min(cell.same, kLeastSame));
    return;
  }
  ++cell.other;
  if (kSamePerOther * cell.other <= cell.same + kSamePerOther) return;
  cell = Cell{};
  if (range >= kBodyEnd) return;
  cell.range = range;
  cell.same = 1;
}

void OwnBody::judgePlace(Cell& cell, const Vec3& middle, const Pose& T_world_lidar) const
{
  if (!cell.waits)
  {
    cell.waits = cell.same >= kSameBeforePlace;
    cell.place = T_world_lidar * (static_cast<double>(cell.range) * middle);
    cell.seen_from = T_world_lidar.p;
    return;
  }
  if ((T_world_lidar.p - cell.seen_from).norm() < kLeastParallax) return;
  const Vec3 in_lidar = T_world_lidar.inverse() * cell.place;
  if (in_lidar.norm() > kFarthestPlace)
  {
    cell.waits = false;
    return;
  }
  const Sight sight = sightOf(in_lidar);
  if (sight == Sight::Hidden) return;
  ++(sight == Sight::Empty ? cell.empty : cell.filled);
  cell.waits = false;
}

OwnBody::Sight OwnBody::sightOf(const Vec3& in_lidar) const
{
  const Eigen::Vector3f p = in_lidar.cast<float>();
  const float distance = p.norm();
  if (!(distance > 0.0F)) return Sight::Hidden;
  const auto cells = DirectionCells::around(DirectionCells::of(p.x(), p.y(), p.z()));
  if (nearest_[cells[0]] == 0.0F) return Sight::Hidden;
  float nearest = nearest_[cells[0]];
  for (const std::size_t cell : cells)
    if (nearest_[cell] > 0.0F) nearest = std::min(nearest, nearest_[cell]);
  if (nearest < distance - kClear) return Sight::Hidden;
  return nearest > distance + kClear ? Sight::Empty : Sight::Filled;
}

void OwnBody::addToBody(std::size_t cell)
{
  cells_[cell].body = true;
  body_.push_back(cell);
  body_range_.resize(DirectionCells::kCount, 0.0F);
  const float range = cells_[cell].range;
  for (const std::size_t near : DirectionCells::around(cell))
    if (!cells_[near].body || near == cell) body_range_[near] = range;
  looks_since_found_ = 0;
}

std::optional<OwnBodyPlace> OwnBody::takeReport()
{
  if (reported_ || body_.size() < kFewestCells || looks_since_found_ < kQuietLooks)
    return std::nullopt;
  reported_ = true;
  Vec3 direction = Vec3::Zero();
  OwnBodyPlace place;
  place.nearest = static_cast<double>(kBodyEnd);
  for (const std::size_t cell : body_)
  {
    direction += DirectionCells::middle(cell);
    place.nearest = std::min(place.nearest, static_cast<double>(cells_[cell].range));
    place.farthest = std::max(place.farthest, static_cast<double>(cells_[cell].range));
  }
  place.azimuth = std::atan2(direction.y(), direction.x());
  return place;
}

}  // namespace fastlio
