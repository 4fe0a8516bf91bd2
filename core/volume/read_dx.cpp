// SPDX-License-Identifier: BSD-3-Clause
// OpenDX, as much of it as programs for potentials write: https://apbs.readthedocs.io/en/latest/formats/opendx.html
#include <algorithm>

#include "core/volume/read_volume.h"
#include "core/volume/value_reader.h"

namespace meniscus {
namespace {

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

  /// APBS says "# Comments" and "# POTENTIAL (kT/e)".
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

  VolumeGrid finish(const std::vector<std::string_view>& fields) {
    if (frame_.count() == 0 || steps_ != 3) fail("values stand before the grid's counts and its three 'delta'");
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

}  // namespace meniscus
