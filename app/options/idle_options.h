// SPDX-License-Identifier: BSD-3-Clause
// Options without effect: refused where the result would be taken for another one, else reported.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/scene/scene.h"

namespace meniscus {

/// A command whose options are taken.
struct TakenOptions {
  const CLI::App& command;
  const Scene& scene;
  std::function<bool(std::string_view key)> is_given;  ///< by the command line or the scene file
};

/// Of a command whose options are parsed: a sentence for each group of its options that change nothing without
/// another one, and for each value that looks like one of another unit. Throws UsageError where an option would have
/// changed the numbers or the frames.
std::vector<std::string> idle_options(const TakenOptions& options);

}  // namespace meniscus
