// SPDX-License-Identifier: BSD-3-Clause
// Reads volume maps that are text: grids of OpenDX and cubes of Gaussian.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/volume/read_volume.h"

namespace meniscus {
namespace {

/// Reads the next `count` numbers of a file, with any number of them per line. Throws InputError.
std::vector<float> read_values(const TextFile& file, LineReader& lines, std::size_t count) {
  // Each value takes two bytes at least, so no count makes this reserve more than the file is worth.
  if (count > lines.bytes_left() / 2 + 1)
    throw InputError(
        file.path, lines.number(),
        fmt::format("announces {} values, more than the {} bytes after it can hold; is the file cut short?",
                    with_thousands(count), with_thousands(lines.bytes_left())));
  std::vector<float> values;
  values.reserve(count);
  std::string_view line;
  while (values.size() < count && lines.next(line)) {
    for (std::string_view field = take_field(line); !field.empty(); field = take_field(line)) {
      double value = 0.0;
      if (values.size() == count || !parse_number(field, value) || !std::isfinite(static_cast<float>(value)))
        throw InputError(
            file.path, lines.number(),
            values.size() == count
                ? fmt::format("holds more than the {} values that its header announces", with_thousands(count))
                : fmt::format("{} was found in place of value {} of {}; values are finite numbers", in_quotes(field),
                              with_thousands(values.size() + 1), with_thousands(count)));
      values.push_back(static_cast<float>(value));
    }
  }
  if (values.size() < count)
    throw InputError(file.path, lines.number(),
                     fmt::format("ends after {} of {} values; is the file cut short?", with_thousands(values.size()),
                                 with_thousands(count)));
  return values;
}

/// Reads OpenDX, as much of it as programs for potentials write:
/// https://apbs.readthedocs.io/en/latest/formats/opendx.html
class DxReader {
 public:
  explicit DxReader(const TextFile& file) : file_(file), lines_(file.text) {}

  VolumeGrid read() {
    std::string_view line;
    while (lines_.next(line)) {
      const std::string_view whole = trimmed(line);
      if (whole.starts_with('#')) note_comment(whole);
      const std::vector<std::string_view> fields = fields_of(whole);
      if (fields.empty() || fields[0].starts_with('#')) continue;
      if (fields[0] == "origin")
        frame_.origin = vector_of(fields);
      else if (fields[0] == "delta")
        add_step(vector_of(fields));
      else if (fields[0] == "object" && has(fields, "gridpositions"))
        read_counts(fields);
      else if (fields[0] == "object" && has(fields, "array"))
        return finish(fields);
    }
    throw InputError(file_.path, lines_.number(), "ends without an array of values; is the file cut short?");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(file_.path, lines_.number(), what); }

  static bool has(const std::vector<std::string_view>& fields, std::string_view word) {
    return std::ranges::find(fields, word) != fields.end();
  }

  /// Takes title and unit from a comment. APBS writes "# Comments" and "# POTENTIAL (kT/e)".
  void note_comment(std::string_view line) {
    const std::size_t open = line.find('('), close = line.find(')');
    if (!line.starts_with("# POTENTIAL") || open == std::string_view::npos || close < open || close > open + 16) return;
    title_ = "electrostatic potential";
    unit_ = escaped(line.substr(open + 1, close - open - 1));
  }

  glm::dvec3 vector_of(const std::vector<std::string_view>& fields) const {
    glm::dvec3 vector(0.0);
    bool good = fields.size() == 4;
    for (int axis = 0; good && axis < 3; ++axis) good = parse_number(fields[axis + 1], vector[axis]);
    if (!good) fail(fmt::format("{} is followed by three numbers in Å", in_quotes(fields[0])));
    return vector;
  }

  void add_step(const glm::dvec3& step) {
    if (steps_ == 3) fail("a fourth 'delta'; a grid has three axes");
    frame_.step[steps_++] = step;
  }

  void read_counts(const std::vector<std::string_view>& fields) {
    std::array<std::int64_t, 3> size{};
    const auto counts = std::ranges::find(fields, "counts");
    bool good = fields.end() - counts == 4;
    for (int axis = 0; good && axis < 3; ++axis) good = parse_whole_number(counts[axis + 1], size[axis]);
    if (!good) fail("gridpositions end with 'counts' and three whole numbers");
    check_volume_size(file_.path, lines_.number(), size);
    for (int axis = 0; axis < 3; ++axis) frame_.size[axis] = static_cast<std::size_t>(size[axis]);
  }

  /// Reads the values, and returns the grid.
  VolumeGrid finish(const std::vector<std::string_view>& fields) {
    if (frame_.count() == 0 || steps_ != 3) fail("values come before the grid's counts and its three 'delta'");
    if (has(fields, "binary") || !has(fields, "follows"))
      fail("the array's values do not follow as text; write the map as plain OpenDX, with 'data follows'");
    const auto items = std::ranges::find(fields, "items");
    std::int64_t count = 0;
    if (fields.end() - items < 2 || !parse_whole_number(items[1], count) ||
        count != static_cast<std::int64_t>(frame_.count()))
      fail(fmt::format("'items' and a number should say {} values, as many as the grid has points",
                       with_thousands(frame_.count())));
    VolumeGrid grid(file_.path, frame_, read_values(file_, lines_, frame_.count()));
    grid.title = title_;
    grid.unit = unit_;
    return grid;
  }

  const TextFile& file_;
  LineReader lines_;
  VolumeFrame frame_;
  int steps_ = 0;
  std::string title_, unit_;
};

}  // namespace

VolumeGrid read_dx(const TextFile& file) { return DxReader(file).read(); }

namespace {

constexpr double kBohr = 0.529177210903;  // Å; CODATA 2018

class CubeReader {
 public:
  explicit CubeReader(const TextFile& file) : file_(file), lines_(file.text) {}

  VolumeGrid read() {
    next_line();
    next_line();  // two lines of comment
    std::int64_t atoms = 0;
    const glm::dvec3 origin = count_and_vector(atoms, "the number of atoms and the origin, three numbers");
    std::array<std::int64_t, 3> size{};
    VolumeFrame frame;
    for (int axis = 0; axis < 3; ++axis)
      frame.step[axis] = count_and_vector(size[axis], "a number of points and a step, three numbers");
    const double unit = size[0] < 0 ? 1.0 : kBohr;
    for (const std::int64_t points : size) {
      if ((points < 0) != (size[0] < 0)) fail("some numbers of points are negative, others not");
    }
    for (std::int64_t& points : size) points = points < 0 ? -points : points;
    check_volume_size(file_.path, lines_.number(), size);
    for (int axis = 0; axis < 3; ++axis) frame.size[axis] = static_cast<std::size_t>(size[axis]);
    frame.origin = unit * origin;
    frame.step *= unit;
    skip_atoms(atoms);
    return {file_.path, frame, read_values(file_, lines_, frame.count())};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(file_.path, lines_.number(), what); }

  std::string_view next_line() {
    std::string_view line;
    if (!lines_.next(line)) fail("ends within the header of a cube file; is it cut short?");
    return line;
  }

  /// Reads a line of the header: a whole number, which becomes `count`, and three numbers. `wanted` describes them in
  /// messages.
  glm::dvec3 count_and_vector(std::int64_t& count, const char* wanted) {
    const std::vector<std::string_view> fields = fields_of(next_line());
    glm::dvec3 vector(0.0);
    bool good = fields.size() >= 4 && parse_whole_number(fields[0], count);
    // A fifth number in the first line is the number of values per point.
    if (good && fields.size() > 4 && fields[4] != "1")
      fail("holds several values per point; write one of them as a cube");
    for (int axis = 0; good && axis < 3; ++axis) good = parse_number(fields[axis + 1], vector[axis]);
    if (!good || std::abs(count) > kMostCount) fail(fmt::format("a line of a cube's header should be {}", wanted));
    return vector;
  }

  /// Skips the lines of atoms. If their number is negative, a line with the numbers of orbitals follows.
  void skip_atoms(std::int64_t atoms) {
    for (std::int64_t n = 0; n < std::abs(atoms); ++n) next_line();
    if (atoms >= 0) return;
    const std::vector<std::string_view> orbitals = fields_of(next_line());
    if (orbitals.size() != 2 || orbitals[0] != "1")
      fail("holds several orbitals; write one of them as a cube of its own");
  }

  static constexpr std::int64_t kMostCount = std::int64_t{1} << 31;
  const TextFile& file_;
  LineReader lines_;
};

}  // namespace

VolumeGrid read_cube(const TextFile& file) { return CubeReader(file).read(); }

}  // namespace meniscus
