// SPDX-License-Identifier: BSD-3-Clause
// Options that have nothing to work on: refused where the result would be taken for another one, else said.
#pragma once

#include <string>
#include <vector>

namespace meniscus {

class SceneOptions;

/// Of a command whose options are parsed: a sentence for each group of its options that change nothing for want of
/// another one, and for each value that looks like one of another unit. Throws UsageError where an option would have
/// changed the numbers or the frames.
std::vector<std::string> idle_options(const SceneOptions& options);

}  // namespace meniscus
