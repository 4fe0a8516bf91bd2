// SPDX-License-Identifier: BSD-3-Clause
// Reads text files of Amber, in Å. Trajectories (mdcrd) have a title and then lines of ten numbers in eight columns
// each. Coordinates of one frame (inpcrd, restart files) have lines of six numbers in twelve columns each.

#include "core/base/binary_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

constexpr std::size_t kPerLine = 10, kWidth = 8;

std::string_view without_blanks_behind(std::string_view line) {
  return line.substr(0, line.find_last_not_of(" \t\r") + 1);
}

/// True if a line consists of numbers in the format F8.3 or F12.7. A number that does not fit into its columns is
/// written as asterisks.
bool is_formatted(std::string_view line, std::size_t width = kWidth, std::size_t most = kPerLine) {
  line = without_blanks_behind(line);
  if (line.empty() || line.size() % width != 0 || line.size() > most * width) return false;
  for (; !line.empty(); line.remove_prefix(width)) {
    const std::string_view field = line.substr(0, width);
    double number = 0.0;
    if (field.find_first_not_of('*') == std::string_view::npos) continue;
    if (field[4] != '.' || field.back() == ' ' || !parse_number(field, number)) return false;
  }
  return true;
}

/// Parses the three edges of a box, which are in columns or separated by blanks.
std::optional<glm::dvec3> edges_of(std::string_view line) {
  line = without_blanks_behind(line);
  const std::vector<std::string_view> fields = fields_of(line);
  glm::dvec3 edges(0.0);
  if (line.size() == 3 * kWidth && is_formatted(line)) {
    for (int n = 0; n < 3; ++n)
      if (!parse_number(line.substr(static_cast<std::size_t>(n) * kWidth, kWidth), edges[n])) return std::nullopt;
    return edges;
  }
  if (fields.size() != 3) return std::nullopt;
  for (int n = 0; n < 3; ++n)
    if (!parse_number(fields[static_cast<std::size_t>(n)], edges[n])) return std::nullopt;
  return edges;
}

class Mdcrd final : public Trajectory {
 public:
  Mdcrd(const std::string& path, const TrajectoryOptions& options) : Trajectory(path, "mdcrd"), file_(path) {
    if (!options.atoms)
      throw InputError(path, 0,
                       message("does not say how many atoms a frame has; give their structure or topology as FILE, and "
                               "this file with @trajectory@"));
    atom_count_ = options.atoms();
    if (atom_count_ == 0) throw InputError(path, 0, "does not say how many atoms a frame has, and FILE has none");
    numbers_ = 3 * atom_count_;
    lines_ = (numbers_ + kPerLine - 1) / kPerLine;
    measure();
    count_frames();
    // Loading the first frames fails if their lines do not match this number of atoms.
    for (std::uint64_t frame = 0; frame < std::min<std::uint64_t>(2, frame_count_); ++frame) load(frame);
    Frame first;
    read_unchecked(0, first);
    const auto& cell = first.cell;
    if (cell && (*cell)[0].x == (*cell)[1].y && (*cell)[1].y == (*cell)[2].z)
      warnings_.emplace_back(
          "its box has three equal edges, and the format stores no angles, so it is taken for a cube; a truncated "
          "octahedron needs NetCDF (cpptraj: trajout run.nc)");
  }

 private:
  /// Measures the first frame. Lines end at the same places in all frames.
  void measure() {
    FileLines lines(file_);
    std::string_view line;
    lines.next(line);
    begin_ = lines.next_offset();
    for (std::size_t n = 0; n < lines_; ++n) {
      if (!lines.next(line))
        throw InputError(path_, n + 1,
                         "the file ends within its first frame, which should have {} atoms as FILE has; do "
                         "the two belong together?",
                         with_thousands(atom_count_));
    }
    frame_bytes_ = lines.next_offset() - begin_;
    last_newline_ = lines.ended_by_newline() ? (line.ends_with('\r') ? 2 : 1) : 0;
    // A frame of one atom looks like a box, and a trajectory of one atom needs no box.
    if (numbers_ != 3 && lines.next(line) && edges_of(line)) {
      has_box_ = true;
      frame_bytes_ = lines.next_offset() - begin_;
      last_newline_ = lines.ended_by_newline() ? (line.ends_with('\r') ? 2 : 1) : 0;
    }
    lines_of_frame_ = lines_ + (has_box_ ? 1 : 0);
  }

  void count_frames() {
    const std::uint64_t bytes = file_.size() - begin_;
    frame_count_ = bytes / frame_bytes_;
    const std::uint64_t rest = bytes % frame_bytes_;
    if (rest == 0) return;
    if (frame_count_ > 0 && rest == frame_bytes_ - last_newline_) {
      ++frame_count_;  // the last frame has no line feed at its end
      return;
    }
    std::string text(std::min<std::uint64_t>(rest, 4096), '\0');
    file_.read(file_.size() - rest, std::as_writable_bytes(std::span(text)));
    const bool blank_lines =
        text.find_first_not_of(" \t\r\n") == std::string::npos && text.find('\n') != std::string::npos;
    if (!blank_lines) cut_short_ = cut_short_sentence(frame_count_);
  }

  [[noreturn]] void refuse(std::uint64_t frame, std::size_t line, const std::string& what) const {
    throw InputError(path_, 2 + frame * lines_of_frame_ + line, "{} (frame {})", what, frame);
  }

  /// Reads the lines of a frame and checks their lengths.
  void load(std::uint64_t number) {
    const std::uint64_t begin = begin_ + number * frame_bytes_;
    text_.resize(std::min(frame_bytes_, file_.size() - begin));
    file_.read(begin, std::as_writable_bytes(std::span(text_)));
    file_.check_unchanged();
    LineReader lines(text_);
    std::string_view line;
    for (std::size_t n = 0, left = numbers_; n < lines_; ++n) {
      const std::size_t expected = std::min(kPerLine, left);
      left -= expected;
      if (lines.next(line) && without_blanks_behind(line).size() == expected * kWidth) continue;
      refuse(number, n,
             fmt::format("{} does not have the {} numbers of eight columns that a frame of {} atoms has here; does "
                         "FILE have the same atoms as this trajectory?",
                         in_quotes(line), expected, with_thousands(atom_count_)));
    }
  }

  void read_unchecked(std::uint64_t number, Frame& frame) override {
    load(number);
    LineReader lines(text_);
    std::string_view line;
    frame.positions.assign(atom_count_, glm::dvec3(0.0));
    for (std::size_t n = 0, place = 0; n < lines_; ++n) {
      lines.next(line);
      for (line = without_blanks_behind(line); !line.empty(); line.remove_prefix(kWidth), ++place)
        frame.positions[place / 3][static_cast<int>(place % 3)] = coordinate(number, n, line.substr(0, kWidth));
    }
    if (!has_box_) return;
    lines.next(line);
    const std::optional<glm::dvec3> edges = edges_of(line);
    if (!edges) refuse(number, lines_, fmt::format("{} should be the three edges of the box", in_quotes(line)));
    frame.cell = cell_of_angles(*edges, glm::dvec3(90.0));
  }

  double coordinate(std::uint64_t frame, std::size_t line, std::string_view field) const {
    double number = 0.0;
    if (parse_number(field, number)) return number;
    refuse(frame, line,
           field == "********" ? "******** marks a coordinate that did not fit into eight columns; image the frames "
                                 "into their box, or write NetCDF"
                               : fmt::format("{} is not a coordinate", in_quotes(field)));
  }

  BinaryFile file_;
  std::uint64_t begin_ = 0, frame_bytes_ = 0;
  std::size_t numbers_ = 0, lines_ = 0, lines_of_frame_ = 0, last_newline_ = 0;
  bool has_box_ = false;
  std::string text_;
};

/// True if the line after the title is one of coordinates.
bool recognizes(std::string_view start) {
  const std::size_t title = start.find('\n');
  if (title == std::string_view::npos || title > 1000) return false;
  const std::string_view rest = start.substr(title + 1);
  const std::size_t end = rest.find('\n');
  return end != std::string_view::npos && is_formatted(rest.substr(0, end));
}

// The reader of restart files follows.

constexpr std::size_t kRestartWidth = 12, kRestartPerLine = 6;

/// Parses "  160  0.5000000E+02": the number of atoms, the time in ps, and in replica exchange the temperature.
bool parse_counts(std::string_view line, std::int64_t& atoms, std::optional<double>& time) {
  const std::vector<std::string_view> fields = fields_of(without_blanks_behind(line), 4);
  if (fields.empty() || fields.size() > 3 || !parse_whole_number(fields[0], atoms) || atoms < 1) return false;
  return fields.size() == 1 || parse_number(fields[1], time.emplace());
}

class AmberRestart final : public Trajectory {
 public:
  explicit AmberRestart(const std::string& path)
      : Trajectory(path, "Amber restart"), file_(read_text_file(path)), lines_(file_) {
    std::string_view line;
    std::int64_t atoms = 0;
    lines_.next(line);
    if (!lines_.next(line) || !parse_counts(line, atoms, frame_.time))
      throw InputError(path, 2, "should have the number of atoms and the time, after a line of title");
    const std::size_t most = lines_.bytes_left() / (3 * kRestartWidth);
    if (static_cast<std::uint64_t>(atoms) > most) refuse_short_frame(file_, 2, static_cast<std::size_t>(atoms), most);
    frame_count_ = 1;
    atom_count_ = static_cast<std::size_t>(atoms);
    time_precision_ = kSinglePrecision;  // times have seven decimals
    read_positions();
    read_rest();
  }

 private:
  void read_positions() {
    frame_.positions.resize(atom_count_);
    std::string_view line;
    for (std::size_t n = 0; n < 3 * atom_count_; ++n) {
      const std::size_t place = n % kRestartPerLine, expected = std::min(kRestartPerLine, 3 * atom_count_ - n);
      if (place == 0 && (!lines_.next(line) || without_blanks_behind(line).size() != expected * kRestartWidth))
        throw lines_.error(
            "{} does not have the {} numbers of twelve columns that {} atoms need here; is the "
            "file cut short?",
            in_quotes(line), expected, with_thousands(atom_count_));
      const char axis = "xyz"[n % 3];
      frame_.positions[n / 3][static_cast<int>(n % 3)] =
          parse_coordinate(file_, lines_.number(), axis, line.substr(place * kRestartWidth, kRestartWidth));
    }
  }

  /// Skips the velocities, which take as many lines as the positions, and reads the box, which takes one line. Each of
  /// them may be missing. A line that may be either is taken for velocities: six numbers after two atoms, or three
  /// numbers after one.
  void read_rest() {
    const std::size_t lines_of_velocities = (3 * atom_count_ + kRestartPerLine - 1) / kRestartPerLine;
    std::vector<std::string_view> rest;
    for (std::string_view line; lines_.next(line);)
      if (line = without_blanks_behind(line); !line.empty()) rest.push_back(line);
    if (rest.size() >= lines_of_velocities &&
        rest.front().size() == std::min(kRestartPerLine, 3 * atom_count_) * kRestartWidth)
      rest.erase(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(lines_of_velocities));
    if (rest.empty()) return;
    const std::size_t numbers = rest.front().size() / kRestartWidth;
    if (rest.size() > 1 || (numbers != 3 && numbers != 6) || !is_formatted(rest.front(), kRestartWidth))
      throw lines_.error(
          "{} follows {} atoms, where velocities fill {} lines and a box of three or six "
          "numbers one; is the file cut short?",
          in_quotes(rest.front()), with_thousands(atom_count_), lines_of_velocities);
    glm::dvec3 edges(0.0), angles(0.0);
    for (std::size_t n = 0; n < numbers; ++n)
      parse_number(rest.front().substr(n * kRestartWidth, kRestartWidth),
                   (n < 3 ? edges : angles)[static_cast<int>(n % 3)]);
    if (numbers == 6)
      frame_.cell = cell_of_angles(edges, angles);
    else
      warnings_.emplace_back("its box has edges without angles, as before Amber 7; no box is used");
  }

  void read_unchecked(std::uint64_t, Frame& frame) override { frame = frame_; }

  TextFile file_;
  LineReader lines_;
  Frame frame_;
};

bool recognizes_restart(std::string_view start) {
  LineReader lines(start);
  std::string_view line;
  std::int64_t atoms = 0;
  std::optional<double> time;
  return lines.next(line) && lines.next(line) && parse_counts(line, atoms, time) && lines.next(line) &&
         is_formatted(line, kRestartWidth, kRestartPerLine);
}

}  // namespace

const TrajectoryFormat kMdcrdFormat{
    {"mdcrd", ".mdcrd .crdbox", "formatted trajectories of Amber, as text",
     "ambermd.org, File Formats: AMBER trajectory (coordinate) file",
     "positions; boxes, as rectangular ones; as many atoms a frame as FILE has; no times"},
    recognizes,
    [](const std::string& path, const TrajectoryOptions& options) {
      return std::unique_ptr<Trajectory>(std::make_unique<Mdcrd>(path, options));
    }};

const TrajectoryFormat kAmberRestartFormat{
    {"Amber restart", ".inpcrd .rst7 .restrt", "coordinates of one moment as Amber writes them, as text",
     "ambermd.org, File Formats: AMBER coordinate or restart file", "positions, the box, the time; no velocities"},
    recognizes_restart,
    [](const std::string& path, const TrajectoryOptions&) {
      return std::unique_ptr<Trajectory>(std::make_unique<AmberRestart>(path));
    }};

}  // namespace meniscus
