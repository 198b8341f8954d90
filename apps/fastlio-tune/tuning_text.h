// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file tuning_text.h Texts that table, parameter file and page have in common. */
#pragma once

#include "tuning_result.h"

#include <string>

namespace fastlio
{
/** "0.0123", "0.0123 degraded", "failed". */
[[nodiscard]] std::string textOf(const Judged& run);

/** "0.512", with the state where it is another than that of the base; that alone without a number.
 */
[[nodiscard]] std::string ratioText(const Judged& base, const Judged& run);

/** Without its folder, printable. */
[[nodiscard]] std::string fileNameOf(const std::string& path);

/** "1.20", "1.20 (may be chance)". */
[[nodiscard]] std::string sizeText(const KeyEffect& effect);
/** "0.1 to 0.2: 1.20, 0.2 to 0.4: lost". */
[[nodiscard]] std::string levelsText(const KeyEffect& effect);
/** The meaning of the numbers of the effects. */
[[nodiscard]] std::string effectsTitle(const TuneCommand& command);

/** Which keys keep the value of the base, and why; empty: none does. */
[[nodiscard]] std::string atBaseText(const TuningResult& result);

/** A sentence. */
[[nodiscard]] std::string conclusionText(const TuneCommand& command, const TuningResult& result);

/** A better mean that costs one recording is not taken; the user may want to know. */
[[nodiscard]] std::string costText(const SearchInputs& inputs, const TuningResult& result);
}  // namespace fastlio
