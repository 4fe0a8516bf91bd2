// SPDX-License-Identifier: BSD-3-Clause
// Reads XYZR: one ball a line, as MSMS and NanoShaper take it.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/molecule/reader.h"

namespace meniscus {
namespace {

constexpr double kLargestRadius = 1000.0;

std::string_view next_field(std::string_view& rest) {
  const std::size_t first = rest.find_first_not_of(" \t");
  if (first == std::string_view::npos) {
    rest = {};
    return {};
  }
  rest.remove_prefix(first);
  const std::string_view field = rest.substr(0, rest.find_first_of(" \t"));
  rest.remove_prefix(field.size());
  return field;
}

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

template <class Visit>
void for_each_line(std::string_view text, Visit visit) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    if (!visit(text.substr(0, end), number)) return;
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

double parse_radius(const TextFile& file, std::size_t line, std::string_view field) {
  double radius = 0.0;
  if (!parse_number(field, radius)) {
    throw InputError(
        file.path, line,
        fmt::format("radius is {}, not a finite number; a line is: x y z radius [name]", in_quotes(field)));
  }
  if (radius < 0.0) throw InputError(file.path, line, fmt::format("radius is {} Å; it must not be negative", radius));
  if (radius > kLargestRadius) {
    throw InputError(
        file.path, line,
        fmt::format("radius is {} Å, above the limit of {} Å; is the unit right?", radius, kLargestRadius));
  }
  return radius;
}

bool recognizes(std::string_view text) {
  bool found = false;
  for_each_line(text, [&](std::string_view line, std::size_t) {
    std::string_view rest = without_comment(line);
    std::array<std::string_view, 4> field;
    for (auto& f : field) f = next_field(rest);
    if (field[0].empty()) return true;
    double ignored = 0.0;
    found = !field[3].empty() && parse_number(field[0], ignored) && parse_number(field[1], ignored);
    return false;
  });
  return found;
}

FileContents read(const TextFile& file) {
  FileContents contents;
  contents.radii_from_file = true;
  for_each_line(file.text, [&](std::string_view line, std::size_t number) {
    std::string_view rest = without_comment(line);
    std::array<std::string_view, 4> field;
    for (auto& f : field) f = next_field(rest);
    if (field[0].empty()) return true;
    if (field[3].empty()) {
      throw InputError(file.path, number,
                       fmt::format("{} has fewer than four columns; a line is: x y z radius [name]", in_quotes(line)));
    }
    Atom atom;
    atom.index = atom.residue = static_cast<std::uint32_t>(contents.atoms.size());
    for (int axis = 0; axis < 3; ++axis) {
      atom.position[axis] = parse_coordinate(file, number, "xyz"[axis], field[static_cast<std::size_t>(axis)]);
    }
    atom.radius = parse_radius(file, number, field[3]);
    atom.name = next_field(rest);
    contents.atoms.push_back(std::move(atom));
    return true;
  });
  return contents;
}

}  // namespace

const Reader kXyzrReader{
    {"XYZR", ".xyzr", "balls: centre and radius in Å, one a line", "Sanner, Olson & Spehner 1996 (input of MSMS)",
     "x y z radius [name]; # begins a comment; radii as they are"},
    recognizes,
    read};

}  // namespace meniscus
