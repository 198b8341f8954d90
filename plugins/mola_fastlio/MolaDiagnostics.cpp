// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "MolaDiagnostics.h"

#if FASTLIO_MOLA_HAS_DIAGNOSTICS

#include <fastlio/options/number_text.h>
#include <fastlio/run/run_health.h>

#include <string>

namespace fastlio
{
void MolaDiagnostics::getDiagnostics(std::vector<mola::DiagnosticStatusMsg>& status)
{
  const std::lock_guard lock(mutex_);
  mola::DiagnosticStatusMsg& message = status.emplace_back();
  message.name = "odometry";
  if (!latest_)
  {
    message.level = mola::DiagnosticLevel::STALE;
    message.message = "no scan has come";
    return;
  }
  const ScanHealth& health = latest_->health;
  message.level = latest_->status == ScanStatus::Diverged ? mola::DiagnosticLevel::ERROR
                  : health.value < kTroubledHealth        ? mola::DiagnosticLevel::WARN
                                                          : mola::DiagnosticLevel::OK;
  message.message = health.value < kTroubledHealth ? health.reason : toString(latest_->status);
  const ScanStatistics& s = latest_->statistics;
  message.values = {
      {"status", toString(latest_->status)},
      {"health", fixedText(health.value, 3)},
      {"health_cause", toString(health.cause)},
      {"points_effective", std::to_string(s.points_effective)},
      {"residual_rms", fixedText(s.residual_rms, 4)},
      {"normalized_innovation", fixedText(s.normalized_innovation, 3)}};
}

}  // namespace fastlio

#endif
