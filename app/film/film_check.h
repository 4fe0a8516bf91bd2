// SPDX-License-Identifier: BSD-3-Clause
// Is a film file whole? Asked of its container alone; no picture is decoded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace meniscus {

/// Why the file is not a whole film of this many pictures; empty if it is. MP4 and MOV (ISO/IEC 14496-12): the boxes
/// fill the file, and the table of samples has all pictures and no more bytes than the media data. Matroska (RFC 9559)
/// for names in .mkv and .webm: the elements fill the file, the clusters hold all pictures, and there are cues to seek
/// by. GIF (CompuServe 1990) for names in .gif: the blocks fill the file, and the trailer ends it.
std::string film_fault(const std::filesystem::path& path, std::uint64_t pictures);

}  // namespace meniscus
