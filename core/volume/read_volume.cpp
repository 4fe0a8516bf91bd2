// SPDX-License-Identifier: BSD-3-Clause
// Reads volume maps by their content: CCP4 and MRC (A. Cheng et al., J. Struct. Biol. 192, 146, 2015, and CCP4's
// maplib), OpenDX and Gaussian cube.
//
// gemmi reads CCP4 and MRC, too, but in the other byte order only floats, and it trusts the header's sizes.
#include "core/volume/volume_grid.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

constexpr std::size_t kHeader = 1024, kStamp = 208, kMachine = 212;  ///< bytes of the header; places of its stamps

class Ccp4Reader {
 public:
  Ccp4Reader(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {
    if (bytes_.size() < kHeader) fail("is cut short: a header of a CCP4 map has 1,024 bytes");
    const char machine = bytes_[kMachine];
    if (machine != 0x44 && machine != 0x11)
      fail(fmt::format("has {:#04x} as its machine stamp; 0x44 (little endian) or 0x11 (big) are known",
                       static_cast<unsigned char>(machine)));
    swapped_ = (machine == 0x44) != (std::endian::native == std::endian::little);
  }

  VolumeGrid read() const {
    const std::array<int, 3> axis_of = axes();
    std::array<std::int64_t, 3> stored{word(1), word(2), word(3)};
    check_volume_size(path_, 0, stored);
    if (word(25) == 1 && word(50) == 0 && word(51) == 0 && word(52) == 0 && real(26) != 0.0F)
      fail("is rotated against its cell (LSKFLG); write it without rotation");
    VolumeFrame frame;
    std::array<std::size_t, 3> stride{};  // values of the file from one point to the next along each axis of space
    std::size_t run = 1;
    for (std::size_t n = 0; n < 3; ++n) {
      frame.size[axis_of[n]] = static_cast<std::size_t>(stored[n]);
      stride[axis_of[n]] = run;
      run *= static_cast<std::size_t>(stored[n]);
    }
    set_frame(axis_of, frame);
    return {path_, frame, values(frame, stride)};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(path_, 0, what); }

  /// Returns a word of the header as an integer. Words are counted from 1, as in the format's description.
  std::int32_t word(std::size_t number) const { return number_at<std::int32_t>(4 * (number - 1)); }
  float real(std::size_t number) const { return number_at<float>(4 * (number - 1)); }

  template <typename Number>
  Number number_at(std::size_t at) const {
    char bytes[sizeof(Number)];
    for (std::size_t n = 0; n < sizeof bytes; ++n) bytes[n] = bytes_[at + (swapped_ ? sizeof bytes - 1 - n : n)];
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
  }

  /// Returns the axes of space that columns, rows and sections run along.
  std::array<int, 3> axes() const {
    std::array<int, 3> axis_of{word(17) - 1, word(18) - 1, word(19) - 1};
    if (axis_of == std::array<int, 3>{-1, -1, -1}) return {0, 1, 2};  // some programs leave them open
    for (int axis = 0; axis < 3; ++axis)
      if (std::ranges::count(axis_of, axis) != 1)
        fail(fmt::format("has axes in the order {}, {}, {}; each of 1, 2, 3 must appear once", word(17), word(18),
                         word(19)));
    return axis_of;
  }

  /// Sets the steps and the origin of the grid.
  void set_frame(const std::array<int, 3>& axis_of, VolumeFrame& frame) const {
    glm::dvec3 angle(90.0), length(0.0), start(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t intervals = word(8 + axis);
      if (intervals < 1) fail(fmt::format("has {} intervals along axis {} of its cell", intervals, axis + 1));
      length[axis] = static_cast<double>(real(11 + axis)) / intervals;
      angle[axis] = real(14 + axis) == 0.0F ? 90.0 : static_cast<double>(real(14 + axis));
      start[axis_of[axis]] = word(5 + axis);
      if (!(angle[axis] > 1.0 && angle[axis] < 179.0))
        fail(fmt::format("has {:.6g}° as an angle of its cell", angle[axis]));
    }
    const auto cosine = [&](int axis) {  // exactly 0 for a right angle
      return angle[axis] == 90.0 ? 0.0 : std::cos(angle[axis] * std::numbers::pi / 180.0);
    };
    const double alpha = cosine(0), beta = cosine(1), gamma = cosine(2), sine = std::sqrt(1.0 - gamma * gamma);
    const double y = (alpha - beta * gamma) / sine;
    frame.step[0] = {length.x, 0.0, 0.0};
    frame.step[1] = {length.y * gamma, length.y * sine, 0.0};
    frame.step[2] = length.z * glm::dvec3(beta, y, std::sqrt(std::max(0.0, 1.0 - beta * beta - y * y)));
    const glm::dvec3 origin(real(50), real(51), real(52));
    frame.origin = origin == glm::dvec3(0.0) ? frame.step * start : origin;
  }

  std::vector<float> values(const VolumeFrame& frame, const std::array<std::size_t, 3>& stride) const {
    switch (word(4)) {
      case 0:
        return values_of<std::int8_t>(frame, stride);
      case 1:
        return values_of<std::int16_t>(frame, stride);
      case 2:
        return values_of<float>(frame, stride);
      case 6:
        return values_of<std::uint16_t>(frame, stride);
      default:
        fail(fmt::format("has values of mode {}; 0, 1, 2 and 6 are read", word(4)));
    }
  }

  template <typename Number>
  std::vector<float> values_of(const VolumeFrame& frame, const std::array<std::size_t, 3>& stride) const {
    const std::int32_t extended = word(24);
    const std::size_t begin = kHeader + static_cast<std::size_t>(std::max(extended, 0));
    if (extended < 0 || begin > bytes_.size() || (bytes_.size() - begin) / sizeof(Number) < frame.count())
      fail(fmt::format("is cut short: {} values of {} bytes do not fit into the {} bytes after its header",
                       with_thousands(frame.count()), sizeof(Number),
                       with_thousands(bytes_.size() - std::min(begin, bytes_.size()))));
    std::vector<float> values;
    values.reserve(frame.count());
    for (std::size_t x = 0; x < frame.size[0]; ++x)
      for (std::size_t y = 0; y < frame.size[1]; ++y)
        for (std::size_t z = 0; z < frame.size[2]; ++z)
          values.push_back(static_cast<float>(
              number_at<Number>(begin + sizeof(Number) * (x * stride[0] + y * stride[1] + z * stride[2]))));
    return values;
  }

  const std::string& path_;
  std::string_view bytes_;
  bool swapped_ = false;
};

/// True if these are the bytes of a CCP4 or MRC 2014 map, recognised by its stamp.
bool is_ccp4(std::string_view bytes) { return bytes.size() > kStamp + 4 && bytes.substr(kStamp, 3) == "MAP"; }

/// Reads CCP4/MRC of modes 0, 1, 2 and 6, in both byte orders and with any order of axes. The origin is ORIGIN if that
/// is not zero (MRC 2014), else NSTART (CCP4).
VolumeGrid read_ccp4(const std::string& path, std::string_view bytes) { return Ccp4Reader(path, bytes).read(); }

/// Reads the next `count` numbers of a file, with any number of them per line. Throws InputError.
std::vector<float> read_values(const TextFile& file, LineReader& lines, std::size_t count) {
  // Each value takes two bytes at least, so no count makes this reserve more than the file is worth.
  if (count > lines.bytes_left() / 2 + 1)
    throw lines.error("announces {} values, more than the {} bytes after it can hold; is the file cut short?",
                      with_thousands(count), with_thousands(lines.bytes_left()));
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
    throw lines.error("ends after {} of {} values; is the file cut short?", with_thousands(values.size()),
                      with_thousands(count));
  return values;
}

/// Reads OpenDX, as much of it as programs for potentials write:
/// https://apbs.readthedocs.io/en/latest/formats/opendx.html
class DxReader {
 public:
  explicit DxReader(const TextFile& file) : file_(file), lines_(file) {}

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
    throw lines_.error("ends without an array of values; is the file cut short?");
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

/// Reads OpenDX: a grid of regular positions and connections with its values as text. Coordinates are in Å.
VolumeGrid read_dx(const TextFile& file) { return DxReader(file).read(); }

constexpr double kBohr = 0.529177210903;  // Å; CODATA 2018

class CubeReader {
 public:
  explicit CubeReader(const TextFile& file) : file_(file), lines_(file) {}

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

  /// Reads a line of the header: a whole number, which becomes `count`, and three numbers. `wanted` is for messages.
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

/// Reads a Gaussian cube with one value per point. Lengths are in Bohr, or in Å if the numbers of points are negative.
VolumeGrid read_cube(const TextFile& file) { return CubeReader(file).read(); }

/// True if the first line that is not a comment begins as in OpenDX files.
bool is_dx(const TextFile& file) {
  LineReader lines(file);
  std::string_view line;
  while (lines.next(line)) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.starts_with('#')) continue;
    return text.starts_with("object");
  }
  return false;
}

/// True if the third line has at least four fields, as in cube files.
bool may_be_cube(const TextFile& file) {
  LineReader lines(file);
  std::string_view line;
  for (int n = 0; n < 3; ++n)
    if (!lines.next(line)) return false;
  return fields_of(line).size() >= 4;
}

}  // namespace

VolumeGrid read_volume(const std::string& path) {
  std::string bytes = read_file_bytes(path);
  if (is_ccp4(bytes)) return read_ccp4(path, bytes);
  if (bytes.find('\0') != std::string::npos)
    throw InputError(path, 0, "is binary, but has no stamp 'MAP' of a CCP4 or MRC 2014 map; convert it to one");
  const TextFile file = text_of_bytes(path, std::move(bytes));
  if (is_dx(file)) return read_dx(file);
  if (may_be_cube(file)) return read_cube(file);
  throw InputError(path, 0, "is not one of the volume maps that are read: OpenDX, Gaussian cube, CCP4/MRC");
}

}  // namespace meniscus
