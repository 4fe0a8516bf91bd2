// SPDX-License-Identifier: BSD-3-Clause
// Where the frames of a text file (PDB, GRO, XYZ) begin and end, found without parsing their atoms.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/structure/formats/structure_formats.h"
#include "core/trajectory/formats/binary_file.h"

namespace meniscus {

inline constexpr std::uint64_t kNoBox = ~std::uint64_t{0};

/// A piece of the file that the reader of its format takes for one model.
struct TextFrame {
  std::uint64_t begin = 0, end = 0;
  std::uint64_t box = kNoBox;  ///< PDB: where the CRYST1 record that holds for it begins
};

struct TextFrames {
  std::vector<TextFrame> frames;
  std::string cut_short;  ///< as Trajectory::cut_short()
};

/// Can the frames of this format be found so? The file's text must not be packed and its lines must end in LF or CR LF.
bool can_find_text_frames(const Reader& reader, std::string_view start);

/// Walks through the file once, line by line. Where a count is no number the last frame begins; its reader says what is
/// wrong. A last frame that is not whole is left out, unless it is the only one.
TextFrames find_text_frames(const BinaryFile& file, const Reader& reader);

/// The box a frame names: the CRYST1 record given (PDB), the last line (GRO), Lattice="..." (extended XYZ). The record
/// 1 1 1 90 90 90, which stands for no crystal, is none.
std::optional<glm::dmat3> cell_of_text(const Reader& reader, std::string_view frame, std::string_view box_record);

/// The number behind "t=" (ps) and the one behind "step=" in the title of a GRO frame.
std::optional<double> time_of_title(std::string_view frame);
std::optional<std::int64_t> step_of_title(std::string_view frame);

}  // namespace meniscus
