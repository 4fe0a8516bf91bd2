// SPDX-License-Identifier: BSD-3-Clause
// A run of pictures that was interrupted: which of them are there, and of what they were made.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/options/numbered_path.h"
#include "core/base/output_file.h"
#include "core/scene/scene.h"

namespace meniscus {

/// Of what the pictures of a run are made: 64 hexadecimal digits of the scene, the program's version, and the sizes and
/// times of the files that the scene names. Each picture has them as a note, so that it is known again.
std::string made_of(const Scene& scene);

/// Of these frames those whose pictures are not there. Throws UsageError for pictures of something else, unless they
/// may be replaced; and unless the pictures are PNG files, which have notes.
std::vector<std::uint64_t> missing_frames(const NumberedPath& pictures, const std::vector<std::uint64_t>& frames,
                                          const std::string& made_of, Existing existing);

}  // namespace meniscus
