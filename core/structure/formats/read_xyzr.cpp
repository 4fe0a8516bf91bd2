// SPDX-License-Identifier: BSD-3-Clause
// Reads XYZR and XYZRN of MSMS and NanoShaper, which have one ball per line.

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/formats/structure_formats.h"

namespace meniscus {
namespace {

constexpr std::string_view kLine = "x y z radius [[1] name]";

std::vector<std::string_view> fields_before_comment(std::string_view line) {
  return fields_of(line.substr(0, line.find('#')), 7);
}

bool recognizes(std::string_view text) {
  LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::vector<std::string_view> fields = fields_before_comment(line);
    if (fields.empty()) continue;
    double ignored = 0.0;
    return fields.size() >= 4 && fields.size() < 7 &&
           std::all_of(fields.begin(), fields.begin() + 4,
                       [&](std::string_view field) { return parse_number(field, ignored); });
  }
  return false;
}

FileContents read(const TextFile& file, const ModelChoice& models) {
  FileContents contents;
  contents.models = 1;
  contents.radii = FileRadii::usual;
  LineReader lines(file.text);
  for (std::string_view line; lines.next(line);) {
    const std::vector<std::string_view> fields = fields_before_comment(line);
    if (fields.empty()) continue;
    if (fields.size() < 4) {
      throw InputError(file.path, lines.number(),
                       fmt::format("{} has fewer than four columns; the expected line is: {}", in_quotes(line), kLine));
    }
    Atom atom;
    atom.index = atom.residue = static_cast<std::uint32_t>(contents.atoms.size());
    for (int axis = 0; axis < 3; ++axis) {
      atom.position[axis] = parse_coordinate(file, lines.number(), "xyz"[axis], fields[static_cast<std::size_t>(axis)]);
    }
    atom.radius = parse_radius(file, lines.number(), fields[3], kLine);
    // MSMS has a number before the name. 1 means that the ball is part of the surface.
    std::int64_t flag = 1;
    const bool flagged = fields.size() > 5 && parse_whole_number(fields[4], flag);
    if (flag != 1) {
      throw InputError(
          file.path, lines.number(),
          fmt::format(
              "the fifth column is {}: only 1, for a ball of the surface, is understood; the expected line is: {}",
              flag, kLine));
    }
    if (fields.size() > 4) atom.name = fields[flagged ? 5 : 4];
    if (models.takes(1)) {
      contents.atoms.push_back(std::move(atom));
    } else {
      ++contents.other_model_atoms;
    }
  }
  return contents;
}

}  // namespace

const Reader kXyzrReader{
    {"XYZR", ".xyzr", "balls: centre and radius in Å, one a line", "Sanner, Olson & Spehner 1996 (input of MSMS)",
     "x y z radius [[1] name]; # begins a comment; radii as they are"},
    recognizes,
    read};

}  // namespace meniscus
