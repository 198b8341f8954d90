// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mapper_parts.h"
#include <fastlio/loops/mapper.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace fastlio
{
namespace
{
// Rooms, doors and pillars that look the same are farther apart.
constexpr double kAgreement = 0.3;  // [m]
}  // namespace

/** Where submap b is as seen from a, in any order. */
RelativePose Mapper::motionBetween(std::size_t a, std::size_t b) const
{
  if (a == b) return {};
  return a < b ? predictedMotion(a, b) : reversed(predictedMotion(b, a));
}

/** Whether two closures put the stretch between their later submaps at the same place. \return
 * nothing where the way between them is not known well enough to tell places apart */
std::optional<bool> Mapper::closuresAgree(const Closure& one, const Closure& other) const
{
  OdometryChain way(Pose{}, Matrix6::Zero());
  way.advance(motionBetween(other.a, one.a));
  way.advance(one.registration.motion);
  way.advance(motionBetween(one.b, other.b));
  const double range = std::min(result_.submaps[one.b].range, result_.submaps[other.b].range);
  if (largestPositionStd(way.covariance()) > limits_.maxStd(range)) return std::nullopt;
  return (way.pose().p - other.registration.motion.T_a_b.p).norm() < kAgreement;
}

/** Accepts a closure for which only the prediction is missing, and those that agree with it: of two
 * submaps at least, and of two more than contradict. */
void Mapper::acceptAgreeing(const Closure& latest)
{
  std::vector<Closure*> agreeing;
  std::set<std::size_t> for_it, against_it;
  for (Closure& other : result_.closures)
  {
    if (!other.needs_agreement) continue;
    const std::optional<bool> agrees = &other == &latest ? true : closuresAgree(other, latest);
    if (!agrees) continue;
    (*agrees ? for_it : against_it).insert(other.b);
    if (*agrees) agreeing.push_back(&other);
  }
  if (for_it.size() < 2 + against_it.size()) return;
  const std::string remark =
      mrpt::format("; the odometry was lost, and closures of %zu submaps agree", for_it.size());
  for (Closure* closure : agreeing)
  {
    closure->needs_agreement = false;
    accept(*closure, remark);
    addEdge(*closure);
  }
  settle();
}

}  // namespace fastlio
