// SPDX-License-Identifier: BSD-3-Clause
// A scene that shows pockets: the atoms around each in a colour of its own, and what was taken out as sticks.
#pragma once

#include <string>

#include "app/reports/pocket_report.h"

namespace meniscus {

/// scene: of the command that found the pockets (scene_text()). left_out: the expression by which atoms were taken out.
/// Atoms that line several pockets have the colour of the first; later than the 21st colours begin again.
std::string pocket_figure(const PocketReport& report, const std::string& scene, const std::string& left_out);

}  // namespace meniscus
