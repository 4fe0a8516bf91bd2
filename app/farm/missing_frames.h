// SPDX-License-Identifier: BSD-3-Clause
// Which frames of a run are there: one answer for the workers of a bundle and for `render --resume`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/output_file.h"
#include "core/scene/scene.h"

namespace meniscus::farm {

/// The places, in order, of paths whose files are not there. A PNG file without its end counts as missing: frames are
/// written whole or not at all, but a machine that loses its power may cut them. Folders are listed, which asks a file
/// server anew; a look at a single name may be answered from memory.
std::vector<std::size_t> missing_files(const std::vector<std::string>& paths);

/// What pictures are made of: 64 hexadecimal digits of the scene, the program's version, and the sizes and times of the
/// files that the scene names. Each picture of a run that may be resumed has them as a note.
std::string made_of(const Scene& scene);

/// The same as missing_files() for pictures that have this note. Throws UsageError for pictures of something else,
/// unless they may be replaced; and for files that are not PNG, as these have no notes.
std::vector<std::size_t> missing_pictures(const std::vector<std::string>& paths, const std::string& made_of,
                                          Existing existing);

}  // namespace meniscus::farm
