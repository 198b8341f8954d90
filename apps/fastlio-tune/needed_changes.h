// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file needed_changes.h Of the values that a search has found, those that are needed. */
#pragma once

#include "tuning_result.h"

namespace fastlio
{
/** Gives keys whose effect may be chance the value of the base again, one after the other, where
 * the parameters do not get worse by that: where the conclusion stays, and no recording gets worse
 * than with the best set. What is left becomes the best set; TuningResult::at_base lists the keys.
 * Does nothing when the conclusion is not Conclusion::Better. */
void keepNeededChanges(const SearchInputs& inputs, Evaluator& evaluator, TuningResult& result);
}  // namespace fastlio
