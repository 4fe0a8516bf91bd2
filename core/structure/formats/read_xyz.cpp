// SPDX-License-Identifier: BSD-3-Clause
// Reads XYZ: frames with a count, a comment and one line for each atom; and XYZR and XYZRN of MSMS and NanoShaper,
// which have one ball per line.

#include <algorithm>
#include <bitset>
#include <cctype>
#include <charconv>

#include <gemmi/elem.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/formats/structure_formats.h"

namespace meniscus {
namespace {

/// The places of the fields in a line, counted from 0.
struct Columns {
  std::size_t element = 0;
  std::size_t position = 1;  ///< place of x, which y and z follow
  std::size_t count() const { return std::max(element + 1, position + 3); }
};

/// Returns the columns of a frame. In extended XYZ the comment has Properties=species:S:1:pos:R:3:..., where each
/// property has a name, a kind and a number of columns.
Columns columns_of(std::string_view comment) {
  Columns columns;
  constexpr std::string_view kKey = "Properties=";
  const std::size_t at = comment.find(kKey);
  if (at == std::string_view::npos) return columns;
  std::string_view rest = comment.substr(at + kKey.size());
  if (rest.starts_with('"')) rest.remove_prefix(1);
  rest = rest.substr(0, rest.find_first_of(" \t\""));
  const auto take = [&rest] {
    const std::string_view part = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    return part;
  };
  std::optional<std::size_t> species, number, position;
  for (std::size_t column = 0; !rest.empty() && column < 1000;) {
    const std::string_view name = take();
    take();
    std::int64_t width = 0;
    if (!parse_whole_number(take(), width) || width < 1 || width > 1000) return columns;
    if (name == "species") species = column;
    if (name == "Z") number = column;
    if (name == "pos" && width == 3) position = column;
    column += static_cast<std::size_t>(width);
  }
  if ((!species && !number) || !position) return columns;
  return {species ? *species : *number, *position};
}

/// Parses a number. Fortran writes exponents with D.
bool parse_fortran_number(std::string_view field, double& number) {
  if (parse_number(field, number)) return true;
  std::string text(field);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
  return parse_number(text, number);
}

/// Returns the element of a symbol in upper or lower case, which digits may follow ("C", "CL", "H12"), or of an atomic
/// number. Returns 0 if the word is neither.
std::uint8_t element_of(std::string_view word) {
  std::int64_t number = 0;
  if (parse_whole_number(word, number)) return static_cast<std::uint8_t>(number > 0 && number <= 118 ? number : 0);
  const std::string symbol(word.substr(0, word.find_first_of("0123456789_")));
  return static_cast<std::uint8_t>(symbol.size() > 2 ? 0 : gemmi::Element(symbol).atomic_number());
}

bool is_atom_line(std::string_view line, const Columns& columns) {
  const std::vector<std::string_view> fields = fields_of(line, columns.count());
  if (fields.size() < columns.count()) return false;
  double ignored = 0.0;
  return std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(columns.position),
                     fields.begin() + static_cast<std::ptrdiff_t>(columns.position) + 3,
                     [&](std::string_view field) { return parse_fortran_number(field, ignored); });
}

class XyzReader {
 public:
  XyzReader(const TextFile& file, const ModelChoice& models) : file_(file), choice_(models), lines_(file) {}

  FileContents run() {
    for (std::string_view line; lines_.next(line);) {
      if (trimmed(line).empty()) continue;
      read_frame(count_of(line));
    }
    if (contents_.atoms.empty() && contents_.other_model_atoms == 0) throw InputError(file_.path, 0, "holds no atoms");
    warn_of_types();
    return std::move(contents_);
  }

 private:
  /// Returns the number of atoms of a frame. The shortest line of an atom is "H 0 0 0", without its line end.
  std::size_t count_of(std::string_view line) const {
    constexpr std::size_t kShortestLine = 8;
    std::int64_t count = 0;
    if (!parse_whole_number(line, count) || count < 0)
      throw lines_.error("{} should be the number of atoms of {}; {}", in_quotes(line),
                         contents_.models == 0 ? "the file" : "a further frame",
                         contents_.models == 0 ? "XYZ begins with it" : "does the count above say too few?");
    if (static_cast<std::uint64_t>(count) > (lines_.bytes_left() + 1) / kShortestLine)
      throw lines_.error("the count says {} atoms, more than the {} bytes after it can hold; correct it",
                         with_thousands(static_cast<std::uint64_t>(count)), with_thousands(lines_.bytes_left()));
    return static_cast<std::size_t>(count);
  }

  void read_frame(std::size_t count) {
    const std::size_t count_line = lines_.number();
    ++contents_.models;
    std::string_view line;
    const Columns columns = lines_.next(line) ? columns_of(line) : Columns{};
    is_lammps_ = line.starts_with("Atoms. Timestep:") || trimmed(line) == "Atoms";  // old versions write "Atoms"
    const bool wanted = choice_.takes(static_cast<std::int32_t>(contents_.models));
    for (std::size_t n = 0; n < count; ++n) {
      if (!lines_.next(line)) refuse_short_frame(file_, count_line, count, n);
      if (wanted) {
        take_atom(line, columns);
      } else {
        ++contents_.other_model_atoms;
      }
    }
  }

  void take_atom(std::string_view line, const Columns& columns) {
    const std::vector<std::string_view> fields = fields_of(line, columns.count());
    if (fields.size() < columns.count())
      throw lines_.error(
          "{} has {} columns where an atom needs {} (element x y z); does the count of the "
          "frame say too many?",
          in_quotes(line), fields.size(), columns.count());
    Atom atom;
    atom.model = static_cast<std::int32_t>(contents_.models);
    atom.index = static_cast<std::uint32_t>(contents_.atoms.size());
    atom.residue = choice_.all ? static_cast<std::uint32_t>(contents_.models - 1) : 0;
    atom.name = fields[columns.element];
    std::int64_t ignored = 0;
    const bool is_number = parse_whole_number(atom.name, ignored);
    const bool is_type = is_number && is_lammps_;
    if (!is_type) atom.element = element_of(atom.name);
    if (is_number) numbers_.set(atom.element);
    has_symbols_ = has_symbols_ || !is_number;
    has_types_ = has_types_ || is_type;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view field = fields[columns.position + static_cast<std::size_t>(axis)];
      double number = 0.0;
      atom.position[axis] = parse_fortran_number(field, number)
                                ? check_extent(file_, lines_.number(), "xyz"[axis], number)
                                : parse_coordinate(file_, lines_.number(), "xyz"[axis], field);
    }
    contents_.atoms.push_back(std::move(atom));
  }

  /// Warns if the numbers of elements may be types of atoms. Types count from 1, while few molecules contain helium.
  void warn_of_types() {
    if (has_types_)
      contents_.unknown_elements =
          "the numbers are LAMMPS' types of atoms; write the file again after 'dump_modify ID element C H O ...', one "
          "symbol a type, or put symbols in their place";
    const std::size_t last = numbers_.count();
    if (has_symbols_ || last < 2 || numbers_ != (~std::bitset<128>() >> (127 - last)).reset(0)) return;
    contents_.warnings.emplace_back(
        fmt::format("the elements are numbers from 1 to {}, and count as H, He and so on; if these are types of a "
                    "simulation, put symbols in their place",
                    last));
  }

  const TextFile& file_;
  const ModelChoice& choice_;
  LineReader lines_;
  FileContents contents_;
  std::bitset<128> numbers_;  ///< elements that are written as numbers
  bool has_symbols_ = false, has_types_ = false, is_lammps_ = false;
};

bool recognizes(std::string_view text) {
  LineReader lines(text);
  std::string_view line;
  std::int64_t count = 0;
  if (!lines.next(line) || !parse_whole_number(line, count) || count < 0 || !lines.next(line)) return false;
  const Columns columns = columns_of(line);
  return lines.next(line) && is_atom_line(line, columns);
}

/// True for XYZ of Tinker, whose rows begin with the number and the name of the atom. A line with the box may precede
/// them.
bool is_of_tinker(std::string_view text) {
  LineReader lines(text);
  std::string_view line;
  std::int64_t number = 0;
  double ignored = 0.0;
  for (int n = 0; n < 3 && lines.next(line); ++n) {
    const std::vector<std::string_view> fields = fields_of(line, 6);
    if (n > 0 && fields.size() == 6 && parse_whole_number(fields[0], number) && !parse_number(fields[1], ignored) &&
        parse_whole_number(fields[5], number))
      return true;
  }
  return false;
}

FileContents read(const TextFile& file, const ModelChoice& models) {
  if (!recognizes(file.text) && is_of_tinker(file.text))
    throw InputError(file.path, 0,
                     "is XYZ of Tinker, whose rows begin with numbers of atoms; convert it: obabel -itxyz {} "
                     "-opdb -O tinker.pdb",
                     shell_word(file.path));
  return XyzReader(file, models).run();
}

bool positions(std::string_view model, std::vector<glm::dvec3>& positions) {
  LineReader lines(model);
  std::string_view line;
  std::int64_t count = 0;
  if (!lines.next(line) || !parse_whole_number(line, count) || !lines.next(line)) return false;
  const Columns columns = columns_of(line);
  if (columns.element > columns.position) return false;
  positions.clear();
  while (lines.next(line)) {
    glm::dvec3& position = positions.emplace_back();
    for (std::size_t n = 0; n < columns.position; ++n) take_field(line);
    for (int axis = 0; axis < 3; ++axis)
      if (!try_parse_coordinate(take_field(line), 1.0, position[axis])) return false;
  }
  return positions.size() == static_cast<std::uint64_t>(count);
}

}  // namespace

const Reader kXyzReader{{"XYZ", ".xyz .extxyz", "element and position, frame by frame",
                         "XMol (Minnesota Supercomputer Center); extended XYZ of ASE and libAtoms",
                         "count, comment, then element (symbol or atomic number) x y z; further columns are ignored; "
                         "Properties= of extended XYZ; exponents with D; each frame is a model"},
                        recognizes,
                        read,
                        nullptr,
                        positions};

namespace {

constexpr std::string_view kLine = "x y z radius [[1] name]";

std::vector<std::string_view> fields_before_comment(std::string_view line) {
  return fields_of(line.substr(0, line.find('#')), 7);
}

bool recognizes_xyzr(std::string_view text) {
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

FileContents read_xyzr(const TextFile& file, const ModelChoice& models) {
  FileContents contents;
  contents.models = 1;
  contents.radii = FileRadii::usual;
  LineReader lines(file);
  for (std::string_view line; lines.next(line);) {
    const std::vector<std::string_view> fields = fields_before_comment(line);
    if (fields.empty()) continue;
    if (fields.size() < 4)
      throw lines.error("{} has fewer than four columns; the expected line is: {}", in_quotes(line), kLine);
    Atom atom;
    atom.index = atom.residue = static_cast<std::uint32_t>(contents.atoms.size());
    for (int axis = 0; axis < 3; ++axis) {
      atom.position[axis] = parse_coordinate(file, lines.number(), "xyz"[axis], fields[static_cast<std::size_t>(axis)]);
    }
    atom.radius = parse_radius(file, lines.number(), fields[3], kLine);
    // MSMS has a number before the name. 1 means that the ball is part of the surface.
    std::int64_t flag = 1;
    const bool flagged = fields.size() > 5 && parse_whole_number(fields[4], flag);
    if (flag != 1)
      throw lines.error(
          "the fifth column is {}: only 1, for a ball of the surface, is understood; the expected line is: {}", flag,
          kLine);
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
    recognizes_xyzr,
    read_xyzr};

}  // namespace meniscus
