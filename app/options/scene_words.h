// SPDX-License-Identifier: BSD-3-Clause
// A scene as words of a command line.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/properties/property.h"
#include "core/scene/scene.h"

namespace meniscus {

/// Returns FILE, and an option for each value that differs from Scene{}, but for where its output goes. path: what is
/// written instead of the path of a file that is read.
std::vector<std::string> scene_words(const Scene& scene,
                                     const std::function<std::string(const std::string& path)>& path = {});

/// "meniscus", "render" and the same, with the output.
std::vector<std::string> render_words(const Scene& scene);

/// As a shell takes them, in one line.
std::string shell_line(std::span<const std::string> words);

}  // namespace meniscus
