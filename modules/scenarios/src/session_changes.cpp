// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/scenarios/random_stream.h>
#include <fastlio/scenarios/session_changes.h>
#include <fastlio/worlds/world_parts.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace fastlio
{
namespace
{
/** Where the platform goes, for questions of what is in its way. */
class KeptWay
{
 public:
  explicit KeptWay(const CarrierPath& path)
  {
    constexpr double kStep = 0.04;  // [s]
    const auto& c = path.channels;
    for (double u = 0.0; u <= path.loop_time; u += kStep)
    {
      const Vec3 p(
          c[CarrierPath::kX].value(u), c[CarrierPath::kY].value(u), c[CarrierPath::kZ].value(u));
      cells_[cellOf(p)].push_back(p);
    }
  }

  [[nodiscard]] bool isBlockedBy(const Primitive& body) const
  {
    const Cell middle = cellOf(body.T_world_local.p);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
      {
        const auto cell = cells_.find({middle.first + i, middle.second + j});
        if (cell == cells_.end()) continue;
        if (std::any_of(
                cell->second.begin(), cell->second.end(),
                [&](const Vec3& p) { return isClose(body, p); }))
          return true;
      }
    return false;
  }

 private:
  using Cell = std::pair<long, long>;
  static constexpr double kCell = 4.0;  // more than half a car and the room to keep [m]

  static Cell cellOf(const Vec3& p)
  {
    return {std::lround(p.x() / kCell), std::lround(p.y() / kCell)};
  }

  static bool isClose(const Primitive& body, const Vec3& p)
  {
    constexpr double kRoom = 0.45, kBelow = 2.0;  // beside and below the sensors [m]
    const Vec3 local = body.T_world_local.R.transpose() * (p - body.T_world_local.p);
    const Vec3 outside = (local.cwiseAbs() - body.size).cwiseMax(0.0);
    return outside.head<2>().norm() < kRoom && outside.z() < kBelow;
  }

  std::map<Cell, std::vector<Vec3>> cells_;
};

/** Another place for a thing on the same ground, a little turned. */
Bodies moved(Bodies thing, const std::optional<HeightField>& ground, RandomStream& random)
{
  constexpr double kNearest = 0.4, kFarthest = 1.2, kAcross = 0.1, kTurn = 0.1;
  const auto between = [&](double low, double high)
  { return low + (high - low) * random.uniform(); };
  const Vec3 from = thing.front().T_world_local.p;
  const Mat3& R = thing.front().T_world_local.R;
  const double way = between(kNearest, kFarthest);
  const double along = random.uniform() < 0.5 ? -way : way;
  Vec3 shift = along * R.col(0) + between(-kAcross, kAcross) * R.col(1);
  if (ground)
    shift.z() += ground->height(from.x() + shift.x(), from.y() + shift.y()) -
                 ground->height(from.x(), from.y());
  const Pose turn{expSO3({0.0, 0.0, between(-kTurn, kTurn)}), Vec3::Zero()};
  for (Primitive& body : thing)
  {
    body.T_world_local.p -= from;
    body.T_world_local = turn * body.T_world_local;
    body.T_world_local.p += from + shift;
  }
  return thing;
}

/** A thing in another session; nothing when it is gone. */
Bodies onThatDay(
    const Bodies& thing, const Scene& scene, const KeptWay& way, double changes,
    RandomStream& random)
{
  constexpr int kTrials = 10;
  if (random.uniform() >= changes) return thing;
  if (random.uniform() < 0.5) return {};
  for (int trial = 0; trial < kTrials; ++trial)
  {
    Bodies there = moved(thing, scene.world.ground, random);
    const auto blocks = [&](const Primitive& body) { return way.isBlockedBy(body); };
    if (std::none_of(there.begin(), there.end(), blocks)) return there;
  }
  return {};
}
}  // namespace

void noteMovable(Scene& scene, std::size_t bodies_before)
{
  scene.movable.push_back({bodies_before, scene.world.bodies.size() - bodies_before});
}

void applySession(Scene& scene, const WorldSettings& settings)
{
  if (settings.session == 0 || settings.changes <= 0.0) return;
  const KeptWay way(scene.path);
  const auto session = static_cast<std::uint64_t>(settings.session);
  const Bodies& before = scene.world.bodies;
  Bodies after;
  std::size_t copied = 0, number = 0;
  const auto at = [&](std::size_t i) { return before.begin() + static_cast<std::ptrdiff_t>(i); };
  for (const Movable& m : scene.movable)
  {
    RandomStream random(session, NoiseSource::Session, number++);
    after.insert(after.end(), at(copied), at(m.first));
    copied = m.first + m.count;
    const Bodies there = onThatDay({at(m.first), at(copied)}, scene, way, settings.changes, random);
    after.insert(after.end(), there.begin(), there.end());
  }
  after.insert(after.end(), at(copied), before.end());
  for (const Bodies& thing : scene.spare)
  {
    RandomStream random(session, NoiseSource::Session, number++);
    if (random.uniform() < 0.5 * settings.changes)
      after.insert(after.end(), thing.begin(), thing.end());
  }
  scene.world.bodies = std::move(after);
  scene.movable.clear();
}

}  // namespace fastlio
