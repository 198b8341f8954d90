// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "initialization.h"
#include "scan_pipeline.h"
#include <fastlio/odometry/imu_buffer.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/odometry/parameter_yaml.h>

#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kNsToS = 1e-9;
constexpr double kSToNs = 1e9;

ScanResult waitingResult(const QueuedScan& queued, const std::string& why)
{
  ScanResult waiting;
  waiting.begin_ns = queued.span.begin_ns;
  waiting.stamp_ns = queued.span.end_ns;
  waiting.statistics.points_in = queued.scan.points.size();
  waiting.message = why;
  return waiting;
}

const Parameters& validated(const Parameters& parameters)
{
  validate(parameters);
  return parameters;
}
}  // namespace

/** Queues, the order of events, and who processes what. */
class Odometry::Impl
{
 public:
  explicit Impl(const Parameters& parameters)
      : parameters_(validated(parameters)), pipeline_(parameters), start_finder_(parameters)
  {
  }

  void addImu(const ImuSample& sample);
  void addScan(LidarScan scan);
  std::optional<ScanResult> next(bool at_end);
  [[nodiscard]] std::optional<ImuRateState> stateAtNewestSample();

  const Parameters parameters_;
  InputStatistics statistics_;
  ScanPipeline pipeline_;

 private:
  [[nodiscard]] std::optional<ScanResult> waitForStart(bool at_end);
  [[nodiscard]] std::optional<ScanResult> giveUpOldest(bool at_end);
  [[nodiscard]] bool usable(const ScanSpan& span);
  [[nodiscard]] QueuedScan popScan();

  ImuBuffer imu_;
  ScanQueue scans_;
  StartFinder start_finder_;
};

void Odometry::Impl::addImu(const ImuSample& sample)
{
  ++statistics_.imu_in;
  switch (imu_.add(sample))
  {
    case ImuBuffer::Verdict::Accepted:
      break;
    case ImuBuffer::Verdict::NotFinite:
      ++statistics_.imu_not_finite;
      break;
    case ImuBuffer::Verdict::OutOfOrder:
      ++statistics_.imu_out_of_order;
      break;
    case ImuBuffer::Verdict::Duplicate:
      ++statistics_.imu_duplicate;
      break;
  }
}

void Odometry::Impl::addScan(LidarScan scan)
{
  ++statistics_.scans_in;
  if (scan.points.size() == 0)
  {
    ++statistics_.scans_empty;
    return;
  }
  scan.stamp_ns += static_cast<std::int64_t>(parameters_.lidar.time_offset * kSToNs);
  const ScanSpan span = spanOf(scan);
  scans_.push_back({std::move(scan), span});
}

QueuedScan Odometry::Impl::popScan()
{
  QueuedScan scan = std::move(scans_.front());
  scans_.pop_front();
  return scan;
}

std::optional<ScanResult> Odometry::Impl::waitForStart(bool at_end)
{
  while (!scans_.empty() && !pipeline_.started())
  {
    const StartDecision start = start_finder_.decide(scans_, imu_, at_end);
    if (start.drop_oldest) return waitingResult(popScan(), start.message);
    if (!start.state) break;
    pipeline_.start(*start.state, start.stamp_ns, start.young_map);
  }
  return std::nullopt;
}

bool Odometry::Impl::usable(const ScanSpan& span)
{
  const double missing_s = static_cast<double>(span.end_ns - imu_.newestStamp()) * kNsToS;
  if (missing_s > parameters_.imu.max_gap || span.end_ns <= pipeline_.stamp())
  {
    ++(missing_s > 0.0 ? statistics_.scans_without_imu : statistics_.scans_out_of_order);
    return false;
  }
  return true;
}

/** Scans that no inertial sample reaches must not pile up. */
std::optional<ScanResult> Odometry::Impl::giveUpOldest(bool at_end)
{
  if (scans_.empty()) return std::nullopt;
  const std::int64_t end_ns = scans_.front().span.end_ns;
  if (!imu_.empty() && end_ns <= imu_.newestStamp()) return std::nullopt;
  const double waits_s = static_cast<double>(scans_.back().span.end_ns - end_ns) * kNsToS;
  const bool never = at_end && imu_.empty();
  if (!never && waits_s <= parameters_.lidar.max_waiting) return std::nullopt;
  pipeline_.skipScan();
  ScanResult result = waitingResult(
      popScan(),
      (imu_.empty() ? "no inertial sample has arrived" : "the inertial data have ended") +
          std::string(", but scans of ") + std::to_string(waits_s) +
          " s have after this one (lidar.max_waiting); is the IMU running, does it share "
          "the LiDAR's clock (lidar.time_offset)?");
  if (pipeline_.started()) result.status = ScanStatus::Diverged;
  return result;
}

std::optional<ScanResult> Odometry::Impl::next(bool at_end)
{
  if (auto given_up = giveUpOldest(at_end)) return given_up;
  if (imu_.empty()) return std::nullopt;
  if (!pipeline_.started())
  {
    if (auto waiting = waitForStart(at_end)) return waiting;
  }
  while (pipeline_.started() && !scans_.empty())
  {
    if (scans_.front().span.end_ns + pipeline_.timeShift() > imu_.newestStamp() && !at_end) break;
    QueuedScan queued = popScan();
    pipeline_.applyCalibration(queued.scan, queued.span);
    if (!usable(queued.span)) continue;
    ScanResult result = pipeline_.process(queued.scan, queued.span, imu_);
    imu_.forgetBefore(queued.span.end_ns);
    return result;
  }
  return std::nullopt;
}

std::optional<ImuRateState> Odometry::Impl::stateAtNewestSample()
{
  if (imu_.empty() || !pipeline_.started()) return std::nullopt;
  return pipeline_.stateAtNewestSample(imu_);
}

Odometry::Odometry(const Parameters& parameters) : impl_(std::make_unique<Impl>(parameters)) {}
Odometry::~Odometry() = default;
Odometry::Odometry(Odometry&&) noexcept = default;
Odometry& Odometry::operator=(Odometry&&) noexcept = default;

void Odometry::startIn(const SavedMap& map)
{
  if (map.empty())
    throw std::invalid_argument("Odometry::startIn: the map has no points; was it saved?");
  if (impl_->pipeline_.started())
    throw std::logic_error("Odometry::startIn: call it before the first scan.");
  impl_->pipeline_.useSavedMap(map);
}

void Odometry::addImu(const ImuSample& sample)
{
  impl_->addImu(sample);
}
void Odometry::addScan(LidarScan scan)
{
  impl_->addScan(std::move(scan));
}
std::optional<ScanResult> Odometry::next()
{
  return impl_->next(false);
}
std::optional<ScanResult> Odometry::flush()
{
  return impl_->next(true);
}
const SurfaceMap& Odometry::map() const
{
  return impl_->pipeline_.map();
}
const WorldPoints& Odometry::registeredPoints() const
{
  return impl_->pipeline_.registeredPoints();
}
const RegisteredFields& Odometry::registeredFields() const
{
  return impl_->pipeline_.registeredFields();
}
const std::vector<ImuRateState>& Odometry::imuRateStates() const
{
  return impl_->pipeline_.imuRateStates();
}
std::optional<ImuRateState> Odometry::stateAtNewestSample()
{
  return impl_->stateAtNewestSample();
}
const Parameters& Odometry::parameters() const
{
  return impl_->parameters_;
}
const InputStatistics& Odometry::inputStatistics() const
{
  return impl_->statistics_;
}

}  // namespace fastlio
