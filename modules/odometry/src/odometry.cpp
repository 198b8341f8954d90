// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "odometry_impl.h"

#include <utility>

namespace fastlio
{
Odometry::Odometry(const OdometryOptions& options) : impl_(std::make_unique<Impl>(options)) {}
Odometry::~Odometry() = default;
Odometry::Odometry(Odometry&&) noexcept = default;
Odometry& Odometry::operator=(Odometry&&) noexcept = default;

void Odometry::startIn(const SavedMap& map)
{
  impl_->startIn(map);
}

bool Odometry::relocalize(const PoseGuess& guess, const SavedMap* other)
{
  return impl_->relocalize(guess, other);
}

void Odometry::addImu(const ImuSample& sample)
{
  impl_->addImu(sample);
}
void Odometry::setSampleCallback(std::function<void(const ImuSample&)> callback)
{
  impl_->sample_callback_ = std::move(callback);
}
void Odometry::addScan(LidarScan scan)
{
  impl_->addScan(std::move(scan));
}
std::optional<ScanResult> Odometry::next()
{
  return impl_->handedOver(impl_->next(false));
}
std::optional<ScanResult> Odometry::flush()
{
  return impl_->handedOver(impl_->next(true));
}
const SurfaceMap& Odometry::map() const
{
  return impl_->estimator_.map();
}
const Vec3& Odometry::mapOrigin() const
{
  return impl_->map_origin_;
}
const WorldPoints& Odometry::registeredPoints() const
{
  return impl_->estimator_.registered().points;
}
const RegisteredFields& Odometry::registeredFields() const
{
  return impl_->estimator_.registered().fields;
}
const std::vector<ImuRateState>& Odometry::imuRateStates() const
{
  return impl_->imuRateStates();
}
std::optional<ImuRateState> Odometry::stateAtNewestSample()
{
  return impl_->stateAtNewestSample();
}
CalibrationFindings Odometry::calibrationFindings() const
{
  return impl_->estimator_.calibrationFindings();
}
const OdometryOptions& Odometry::parameters() const
{
  return impl_->options_;
}
const InputStatistics& Odometry::inputStatistics() const
{
  return impl_->inputStatistics();
}
ImuReport Odometry::imuReport() const
{
  return impl_->imuReport();
}
const std::vector<Diagnostic>& Odometry::diagnostics() const
{
  return impl_->diagnostics_.all();
}

}  // namespace fastlio
