// SPDX-License-Identifier: BSD-3-Clause
// Gaussian's cube files: https://gaussian.com/cubegen/
#include <cstdlib>

#include "core/volume/read_volume.h"
#include "core/volume/value_reader.h"

namespace meniscus {
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

  glm::dvec3 count_and_vector(std::int64_t& count, const char* wanted) {
    const std::vector<std::string_view> fields = fields_of(next_line());
    glm::dvec3 vector(0.0);
    bool good = fields.size() >= 4 && parse_whole_number(fields[0], count);
    // A fifth number of the first line: values a point.
    if (good && fields.size() > 4 && fields[4] != "1")
      fail("holds several values a point; write one of them as a cube");
    for (int axis = 0; good && axis < 3; ++axis) good = parse_number(fields[axis + 1], vector[axis]);
    if (!good || std::abs(count) > kMostCount) fail(fmt::format("a line of a cube's header should be {}", wanted));
    return vector;
  }

  /// A negative number of atoms: behind them stand the numbers of orbitals.
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
