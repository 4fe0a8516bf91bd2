// SPDX-License-Identifier: BSD-3-Clause
// Pictures that were interrupted: which of them are there, and of what they were made.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/output_file.h"
#include "core/scene/scene.h"

namespace meniscus {

/// Of what pictures are made: 64 hexadecimal digits of the scene, the program's version, and the sizes and
/// times of the files that the scene names. Each picture has them as a note, so that it is known again.
std::string made_of(const Scene& scene);

/// Of these pictures the places of those that are not there. Throws UsageError for pictures of something else, unless
/// they may be replaced; and unless they are PNG files, which have notes.
std::vector<std::size_t> missing_pictures(const std::vector<std::string>& paths, const std::string& made_of,
                                          Existing existing);

}  // namespace meniscus
