// SPDX-License-Identifier: BSD-3-Clause
// Two commands of a drag as one.
#pragma once

#include <nlohmann/json.hpp>

namespace meniscus {

/// The most by which one command zooms in, and its reciprocal out, however many turns of a wheel became one.
inline constexpr double kMostZoom = 1e300;

/// Makes one command of two that follow each other, `first` then `second`; false if both are needed.
bool merge_commands(nlohmann::json& first, const nlohmann::json& second);

}  // namespace meniscus
