// SPDX-License-Identifier: BSD-3-Clause
// The status of a bundle for people, for programs, and for a monitor.
#pragma once

#include <filesystem>
#include <string>

#include "app/farm/status.h"

namespace meniscus::farm {

/// A table, who works and how long still, and the last failures.
std::string status_table(const Bundle& bundle, const BundleStatus& status, const std::filesystem::path& folder);

/// The same as one JSON object.
std::string status_json(const Bundle& bundle, const BundleStatus& status);

/// The same as gauges in the text format of Prometheus (version 0.0.4), labelled with the last name of the folder.
std::string status_metrics(const Bundle& bundle, const BundleStatus& status, const std::filesystem::path& folder);

}  // namespace meniscus::farm
