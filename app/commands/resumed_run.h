// SPDX-License-Identifier: BSD-3-Clause
// Finds what is left to do for `--resume`: a run's missing pictures, and whether those that are there belong to it.
#pragma once

#include "core/base/output_file.h"
#include "core/scene/scene.h"

namespace meniscus {

/// Returns what pictures or tables are made of as 64 hexadecimal digits: a digest of the scene, the program's version,
/// and the sizes and times of the files that the scene names. Each picture of a run that may be resumed has it as a
/// note.
std::string made_of(const Scene& scene);

/// Returns the places, in order, of paths whose picture is not there whole or has another note. Throws UsageError for
/// pictures with another note, unless they may be replaced; and for files that are not PNG, which have no notes.
std::vector<std::size_t> missing_pictures(const std::vector<std::string>& paths, const std::string& made_of,
                                          Existing existing);

}  // namespace meniscus
