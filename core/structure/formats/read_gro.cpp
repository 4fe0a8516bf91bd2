// SPDX-License-Identifier: BSD-3-Clause
// Reads GRO of GROMACS: fixed columns in nanometres, and one frame after another.
#include <algorithm>

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/atom_classes.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/residues.h"

namespace meniscus {
namespace {

constexpr std::size_t kNamesEnd = 20;  // five columns each: residue number and name, atom name and number

/// Returns the number of columns of a coordinate. It is the distance between the first two decimal points, whatever the
/// number of decimals. Returns 0 if the line has no coordinates.
std::size_t coordinate_width(std::string_view line) {
  const std::size_t first = line.find('.', std::min(line.size(), kNamesEnd));
  const std::size_t second = first == std::string_view::npos ? first : line.find('.', first + 1);
  if (second == std::string_view::npos) return 0;
  const std::size_t width = second - first;
  return line.size() >= kNamesEnd + 3 * width ? width : 0;
}

std::string_view coordinate(std::string_view line, std::size_t width, int axis) {
  return line.substr(kNamesEnd + width * static_cast<std::size_t>(axis), width);
}

bool is_atom_line(std::string_view line) {
  const std::size_t width = coordinate_width(line);
  double ignored = 0.0;
  std::int64_t number = 0;
  return width != 0 && parse_whole_number(line.substr(0, 5), number) &&
         parse_number(coordinate(line, width, 0), ignored) && parse_number(coordinate(line, width, 1), ignored) &&
         parse_number(coordinate(line, width, 2), ignored);
}

bool is_box_line(std::string_view line) { return !gro_box(line).empty(); }

class GroReader {
 public:
  GroReader(const TextFile& file, const ModelChoice& models) : file_(file), choice_(models), lines_(file) {}

  FileContents run() {
    while (!lines_.only_blanks_left()) read_frame();
    if (contents_.atoms.empty() && contents_.other_model_atoms == 0) throw InputError(file_.path, 0, "holds no atoms");
    contents_.sites = classify_atoms(contents_.atoms, contents_.warnings);
    return std::move(contents_);
  }

 private:
  std::size_t read_title_and_count() {
    // The shortest line of an atom has names and numbers in 20 columns, three coordinates of two columns, a line end.
    constexpr std::size_t kShortestLine = 27;
    std::string_view line;
    std::int64_t count = 0;
    if (!lines_.next(line) || !lines_.next(line))
      throw lines_.error("is the last line; a title and the number of atoms were expected");
    if (!parse_whole_number(line, count) || count < 0)
      throw lines_.error("{} should be the number of atoms, the second line of a GRO frame", in_quotes(line));
    if (static_cast<std::uint64_t>(count) > (lines_.bytes_left() + 1) / kShortestLine)
      throw lines_.error(
          "the count says {} atoms, more than the {} bytes after it can hold; correct it, or "
          "is the file cut short?",
          with_thousands(static_cast<std::uint64_t>(count)), with_thousands(lines_.bytes_left()));
    return static_cast<std::size_t>(count);
  }

  void read_frame() {
    const std::size_t count = read_title_and_count();
    const std::size_t count_line = lines_.number();
    ++contents_.models;
    const bool wanted = choice_.takes(static_cast<std::int32_t>(contents_.models));
    residues_.end_piece();
    std::string_view line;
    for (std::size_t n = 0; n < count; ++n) {
      if (!lines_.next(line)) refuse_short_frame(file_, count_line, count, n);
      if (wanted) {
        take_atom(line);
      } else {
        ++contents_.other_model_atoms;
      }
    }
    read_box(count);
  }

  /// Reads the box. A surface does not need it, but without a box the count is wrong, so that atoms would be missing.
  void read_box(std::size_t count) {
    std::string_view line;
    if (!lines_.next(line))
      throw lines_.error(
          "is the last line; the box (three or nine numbers) is missing after it; is the file cut short?");
    if (!is_box_line(line))
      throw lines_.error(
          "{} was found where the box (three or nine numbers) should be by the count of {}; correct the count",
          in_quotes(line), with_thousands(count));
  }

  void take_atom(std::string_view line) {
    const std::size_t width = coordinate_width(line);
    if (width == 0)
      throw lines_.error(
          "{} does not have three coordinates after column 20; is it cut short, or does the count "
          "say too many atoms?",
          in_quotes(line));
    Atom atom;
    atom.model = static_cast<std::int32_t>(contents_.models);
    std::int64_t residue = 0;
    if (!parse_whole_number(line.substr(0, 5), residue))
      throw lines_.error("residue number {} in columns 1 to 5 is not a number; columns may have shifted",
                         in_quotes(line.substr(0, 5)));
    atom.residue_number = static_cast<std::int32_t>(residue);
    atom.residue_name = trimmed(line.substr(5, 5));
    atom.name = trimmed(line.substr(10, 5));
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view field = coordinate(line, width, axis);
      const double nanometres = parse_coordinate(file_, lines_.number(), "xyz"[axis], field);
      atom.position[axis] = check_extent(file_, lines_.number(), "xyz"[axis], kAngstromPerNanometre * nanometres);
    }
    residues_.number(atom);
    contents_.atoms.push_back(std::move(atom));
  }

  const TextFile& file_;
  const ModelChoice& choice_;
  LineReader lines_;
  FileContents contents_;
  ResidueCounter residues_{contents_.atoms};
};

bool recognizes(std::string_view text) {
  LineReader lines(text);
  std::string_view line;
  std::int64_t count = 0;
  return lines.next(line) && lines.next(line) && parse_whole_number(line, count) && count >= 0 && lines.next(line) &&
         is_atom_line(line);
}

FileContents read(const TextFile& file, const ModelChoice& models) { return GroReader(file, models).run(); }

bool positions(std::string_view model, std::vector<glm::dvec3>& positions) {
  LineReader lines(model);
  std::string_view line;
  std::int64_t count = 0;
  if (!lines.next(line) || !lines.next(line) || !parse_whole_number(line, count)) return false;
  positions.clear();
  for (std::int64_t n = 0; n < count; ++n) {
    const std::size_t width = lines.next(line) ? coordinate_width(line) : 0;
    std::int64_t residue = 0;
    if (width == 0 || !parse_whole_number(line.substr(0, 5), residue)) return false;
    glm::dvec3& position = positions.emplace_back();
    for (int axis = 0; axis < 3; ++axis)
      if (!try_parse_coordinate(coordinate(line, width, axis), kAngstromPerNanometre, position[axis])) return false;
  }
  return lines.next(line) && is_box_line(line);
}

}  // namespace

std::vector<double> gro_box(std::string_view line) {
  line = trimmed(line);
  const std::size_t last_dot = line.rfind('.');
  const std::size_t decimals = last_dot == std::string_view::npos ? 0 : line.size() - last_dot - 1;
  std::vector<double> numbers;
  for (std::string_view field : fields_of(line, 10)) {
    while (!field.empty()) {
      const bool touches = field.find('.') != field.rfind('.');
      const std::string_view text = touches ? field.substr(0, field.find('.') + 1 + decimals) : field;
      if (!parse_number(text, numbers.emplace_back())) return {};
      field.remove_prefix(text.size());
    }
  }
  return numbers.size() == 3 || numbers.size() == 9 ? numbers : std::vector<double>();
}

const Reader kGroReader{
    {"GRO", ".gro", "GROMACS coordinates, in nanometres", "GROMACS manual, file formats: gro",
     "title, count, atoms in fixed columns (numbers may wrap after 99,999; any number of decimals), "
     "box; velocities are ignored; elements are guessed from the names; each frame is a model"},
    recognizes,
    read,
    nullptr,
    positions};

}  // namespace meniscus
