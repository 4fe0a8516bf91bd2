// SPDX-License-Identifier: BSD-3-Clause
// Reads text dumps of LAMMPS (dump atom, dump custom). Atoms come in any order and are identified by numbers.
#include <numeric>

#include "core/base/binary_file.h"
#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

/// The units of LAMMPS by the name of a style: length in Å and time in ps ("units" in the manual).
struct UnitStyle {
  std::string_view name;
  double length, time;
};
constexpr std::array<UnitStyle, 7> kUnitStyles{{{"real", 1.0, 1e-3},
                                                {"metal", 1.0, 1.0},
                                                {"si", 1e10, 1e12},
                                                {"cgs", 1e8, 1e12},
                                                {"electron", 0.529177210903, 1e-3},
                                                {"micro", 1e4, 1e6},
                                                {"nano", 10.0, 1e3}}};

/// The columns of positions, the preferred kind first. Unwrapped positions (xu) keep molecules whole at the sides of
/// the box.
struct PositionColumns {
  std::array<std::string_view, 3> names;
  bool is_scaled;
};
constexpr std::array<PositionColumns, 4> kPositionColumns{
    {{{"xu", "yu", "zu"}, false}, {{"xsu", "ysu", "zsu"}, true}, {{"x", "y", "z"}, false}, {{"xs", "ys", "zs"}, true}}};

struct DumpHeader {
  std::optional<std::int64_t> step;
  std::optional<double> time;
  std::string units;  ///< LAMMPS writes them only once, in the first frame
  std::int64_t atoms = -1;
  glm::dvec3 low{0.0};  ///< corner of the box, in the unit of the file
  glm::dmat3 box{0.0};  ///< vectors of the box in the columns, in the unit of the file
  bool has_box = false, is_periodic = false;
  std::string columns;
};

/// Reads a header line by line. It throws a Fault if the header is wrong.
class HeaderReader {
 public:
  explicit HeaderReader(FileLines& lines) : lines_(lines) {}

  /// Reads up to the line with the names of columns. False if the file ends before it. Throws Fault.
  bool read(DumpHeader& header) {
    for (std::string_view line; next(line);) {
      if (trimmed(line).empty()) continue;
      if (!line.starts_with("ITEM: ")) throw fault("has {} where a line 'ITEM: ...' should be", line);
      const std::string item(trimmed(line.substr(6)));
      if (item.starts_with("ATOMS")) {
        header.columns = item.substr(5);
        return true;
      }
      if (!parse_item(item, header)) return false;
    }
    return false;
  }

  bool only_blanks() const { return has_only_blanks_; }  ///< true if only blank lines were read

  struct Fault {
    std::string words;
  };

 private:
  bool next(std::string_view& line) {
    if (!lines_.next(line)) return false;
    line = without_return(line);
    has_only_blanks_ = has_only_blanks_ && trimmed(line).empty();
    return lines_.ended_by_newline();  // without a line feed the line may be cut by the end of the file
  }

  static Fault fault(fmt::format_string<std::string> words, std::string_view text) {
    return {fmt::format(words, in_quotes(text))};
  }

  bool parse_item(const std::string& item, DumpHeader& header) {
    if (item.starts_with("BOX BOUNDS")) return parse_box(item.substr(10), header);
    std::string_view line;
    if (!next(line)) return false;
    std::int64_t number = 0;
    double time = 0.0;
    if (item == "UNITS") {
      header.units = trimmed(line);
    } else if (item == "TIME") {
      if (!parse_number(line, time)) throw fault("has the time {}, which is not a number", line);
      header.time = time;
    } else if (item == "TIMESTEP") {
      if (!parse_whole_number(line, number)) throw fault("has the timestep {}, which is not a whole number", line);
      header.step = number;
    } else if (item == "NUMBER OF ATOMS") {
      if (!parse_whole_number(line, header.atoms) || header.atoms < 1) throw fault("has {} atoms", line);
    } else {
      throw fault("has {}, which is not part of a dump of atoms (dump atom, dump custom)", item);
    }
    return true;
  }

  /// Reads three lines with low and high bounds, and xy, xz or yz of a triclinic box. In that case the bounds are those
  /// of the box around it (manual, "Triclinic simulation boxes"). Boundaries "pp" mean that the box is periodic. False
  /// if the file ends before the third line.
  bool parse_box(std::string_view words, DumpHeader& header) {
    const std::vector<std::string_view> fields = fields_of(words);
    if (!fields.empty() && fields.front() == "abc")
      throw Fault{"has a general triclinic box; write restricted ones: dump_modify triclinic/general no"};
    const bool inclined = !fields.empty() && fields.front() == "xy";
    const auto boundaries = std::span(fields).subspan(inclined ? std::min<std::size_t>(3, fields.size()) : 0);
    header.is_periodic = std::ranges::all_of(boundaries, [](std::string_view word) { return word == "pp"; });
    glm::dvec3 low(0.0), high(0.0), tilt(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      std::string_view line;
      if (!next(line)) return false;
      const std::vector<std::string_view> numbers = fields_of(line);
      if (numbers.size() != (inclined ? 3 : 2) || !parse_number(numbers[0], low[axis]) ||
          !parse_number(numbers[1], high[axis]) || (inclined && !parse_number(numbers[2], tilt[axis])))
        throw fault("has the bounds {}, which are not the numbers of a box", line);
    }
    const double xy = tilt[0], xz = tilt[1], yz = tilt[2];
    low -= glm::dvec3(std::min({0.0, xy, xz, xy + xz}), std::min(0.0, yz), 0.0);
    high -= glm::dvec3(std::max({0.0, xy, xz, xy + xz}), std::max(0.0, yz), 0.0);
    header.low = low;
    header.box = glm::dmat3(high.x - low.x, 0.0, 0.0, xy, high.y - low.y, 0.0, xz, yz, high.z - low.z);
    header.has_box = true;
    return true;
  }

  FileLines& lines_;
  bool has_only_blanks_ = true;
};

class LammpsDump final : public Trajectory {
 public:
  LammpsDump(const std::string& path, const TrajectoryOptions& options)
      : Trajectory(path, "LAMMPS dump"), file_(path), lines_(file_), trust_atom_order_(options.trust_atom_order) {
    index_ = find_frames(file_, options.index_folder, [this](std::uint64_t offset) { return extent_at(offset); });
    cut_short_ = index_.cut_short;
    frame_count_ = index_.offsets.size();
    DumpHeader first;
    read_header(0, first);
    choose_units(first.units);
    std::array<std::byte, 1> end{};
    file_.read(file_.size() - 1, end);
    if (cut_short_.empty() && end[0] != std::byte{'\n'})
      warnings_.emplace_back("its last line has no line end; if the file was cut there, its last number is cut, too");
    Frame frame;
    read_unchecked(0, frame);
    ids_ = frame_ids_;
    atom_count_ = ids_.size();
  }

 private:
  /// Finds the extent of a frame without parsing its atoms.
  FrameExtent extent_at(std::uint64_t offset) {
    constexpr std::uint64_t kEndless = std::uint64_t{1} << 62;
    DumpHeader header;
    lines_.seek(offset);
    try {
      HeaderReader reader(lines_);
      if (!reader.read(header)) return {reader.only_blanks() ? file_.size() - offset : kEndless, false, {}};
    } catch (const HeaderReader::Fault& fault) {
      return {0, true, fault.words};
    }
    if (header.atoms < 0) return {0, true, "has no ITEM: NUMBER OF ATOMS before its atoms"};
    std::string_view line;
    for (std::int64_t n = 0; n < header.atoms; ++n)
      if (!lines_.next(line)) return {kEndless, true, {}};
    // LAMMPS ends every line, but other programs do not end the last one.
    constexpr std::size_t kMost = 1000;
    const bool whole = lines_.ended_by_newline() ||
                       fields_of(without_return(line), kMost).size() >= fields_of(header.columns, kMost).size();
    return {whole ? lines_.next_offset() - offset : kEndless, true, {}};
  }

  void choose_units(const std::string& name) {
    if (name.empty()) {
      warnings_.emplace_back("it names no units; its lengths are taken to be Å (dump_modify units yes writes them)");
      return;
    }
    const auto found = std::ranges::find(kUnitStyles, std::string_view(name), &UnitStyle::name);
    if (found == kUnitStyles.end())
      throw InputError(
          path_, 0, "its units are {}, which give no lengths in Å; real, metal, si, cgs, electron, micro and nano do",
          in_quotes(name));
    length_ = found->length;
    time_ = found->time;
  }

  void read_header(std::uint64_t number, DumpHeader& header) {
    lines_.seek(index_.offsets[number]);
    bool whole = false;
    try {
      whole = HeaderReader(lines_).read(header);
    } catch (const HeaderReader::Fault& fault) {
      refuse(number, fault.words);
    }
    if (!whole || header.atoms < 1) refuse(number, "is not a dump of atoms");
  }

  [[noreturn]] void refuse(std::uint64_t number, const std::string& what) const {
    throw InputError(path_, 0, "frame {} at byte {} {}", number, with_thousands(index_.offsets[number]), what);
  }

  /// The columns that are read: the number of an atom and its three coordinates.
  struct Columns {
    std::array<std::size_t, 4> place;  ///< the first is beyond all columns if atoms have no numbers
    std::size_t last;
    bool is_scaled;
  };

  Columns columns_of(std::uint64_t number, const DumpHeader& header) const {
    const std::vector<std::string_view> names = fields_of(header.columns, 1000);
    const auto place = [&](std::string_view name) {
      return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    Columns columns{};
    columns.place[0] = place("id");
    if (columns.place[0] == names.size() && !trust_atom_order_)
      refuse(number, message("has no column 'id', so its atoms cannot be identified; add id to dump custom, or "
                             "@trust-atom-order@ if they are in the order of FILE in every frame"));
    for (const PositionColumns& kind : kPositionColumns) {
      for (std::size_t axis = 0; axis < 3; ++axis) columns.place[axis + 1] = place(kind.names[axis]);
      columns.last = *std::max_element(columns.place.begin() + 1, columns.place.end());
      columns.is_scaled = kind.is_scaled;
      if (columns.last == names.size()) continue;
      if (columns.place[0] < names.size()) columns.last = std::max(columns.last, columns.place[0]);
      if (kind.is_scaled && !header.has_box) refuse(number, "has positions as fractions of a box, but no box");
      return columns;
    }
    refuse(number, fmt::format("has the columns {}, but neither xu yu zu, xsu ysu zsu, x y z nor xs ys zs",
                               in_quotes(trimmed(header.columns))));
  }

  void read_unchecked(std::uint64_t number, Frame& frame) override {
    DumpHeader header;
    read_header(number, header);
    const Columns columns = columns_of(number, header);
    if (static_cast<std::uint64_t>(header.atoms) > file_.size())
      refuse(number, "has more atoms than the file has bytes");
    frame_ids_.clear();
    frame_positions_.clear();
    for (std::int64_t n = 0; n < header.atoms; ++n) parse_atom(number, header, columns);
    file_.check_unchanged();
    sort_atoms(number);
    frame.positions.resize(frame_positions_.size());
    for (std::size_t n = 0; n < frame_positions_.size(); ++n) frame.positions[n] = length_ * frame_positions_[n];
    if (header.has_box && header.is_periodic) frame.cell = cell_of_vectors(length_ * header.box);
    frame.step = header.step;
    if (header.time && time_ > 0.0 && std::isfinite(time_ * *header.time)) frame.time = time_ * *header.time;
  }

  void parse_atom(std::uint64_t number, const DumpHeader& header, const Columns& columns) {
    std::string_view line;
    if (!lines_.next(line)) refuse(number, "has fewer atoms than before");
    line = without_return(line);
    std::string_view rest = line;
    std::array<std::string_view, 4> fields;
    for (std::size_t column = 0; column <= columns.last; ++column) {
      const std::string_view field = take_field(rest);
      for (std::size_t n = 0; n < 4; ++n)
        if (columns.place[n] == column) fields[n] = field;
    }
    auto id = static_cast<std::int64_t>(frame_ids_.size()) + 1;
    glm::dvec3 p(0.0);
    const bool has_id = columns.place[0] <= columns.last;
    if ((has_id && !parse_whole_number(fields[0], id)) || !parse_number(fields[1], p.x) ||
        !parse_number(fields[2], p.y) || !parse_number(fields[3], p.z))
      refuse(number, fmt::format("has the atom {}, whose number and position in the columns {} are not all numbers",
                                 in_quotes(line), in_quotes(trimmed(header.columns))));
    frame_ids_.push_back(id);
    frame_positions_.push_back(columns.is_scaled ? header.low + header.box * p : p);
  }

  /// Sorts the atoms by their numbers, which must be the same as in the first frame.
  void sort_atoms(std::uint64_t number) {
    if (!std::ranges::is_sorted(frame_ids_)) {
      std::vector<std::size_t> order(frame_ids_.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::ranges::sort(order, {}, [&](std::size_t n) { return frame_ids_[n]; });
      std::vector<std::int64_t> ids;
      std::vector<glm::dvec3> positions;
      for (const std::size_t n : order) {
        ids.push_back(frame_ids_[n]);
        positions.push_back(frame_positions_[n]);
      }
      frame_ids_ = std::move(ids);
      frame_positions_ = std::move(positions);
    }
    const auto twice = std::ranges::adjacent_find(frame_ids_);
    if (twice != frame_ids_.end()) refuse(number, fmt::format("has the atom {} twice", *twice));
    // This is the first frame, or the caller refuses it for its number of atoms.
    if (ids_.empty() || frame_ids_.size() != ids_.size()) return;
    const auto other = std::ranges::mismatch(frame_ids_, ids_);
    if (other.in1 != frame_ids_.end())
      refuse(number,
             fmt::format("has the atom {} where the first frame has {}: a dump of a changing group is not a trajectory",
                         *other.in1, *other.in2));
  }

  BinaryFile file_;
  FileLines lines_;
  FrameIndex index_;
  bool trust_atom_order_ = false;
  double length_ = 1.0, time_ = 0.0;
  std::vector<std::int64_t> ids_;            ///< numbers of all atoms, ascending
  std::vector<std::int64_t> frame_ids_;      ///< numbers of the atoms of the current frame
  std::vector<glm::dvec3> frame_positions_;  ///< positions of the atoms of the current frame, in the unit of the file
};

bool recognizes(std::string_view start) {
  return std::ranges::any_of(std::array{"ITEM: TIMESTEP", "ITEM: UNITS", "ITEM: TIME"},
                             [&](const char* item) { return start.starts_with(item); });
}

}  // namespace

const TrajectoryFormat kLammpsFormat{
    {"LAMMPS dump", ".lammpstrj .lammpsdump .dump", "text dumps of LAMMPS (dump atom, dump custom)",
     "LAMMPS manual: dump, dump_modify, Howto triclinic",
     "positions by the numbers of the atoms: xu, xsu, x or xs, in this order; boxes that are periodic in all "
     "directions, "
     "inclined ones too; steps; times and units where they are named, else Å"},
    recognizes,
    [](const std::string& path, const TrajectoryOptions& options) {
      return std::unique_ptr<Trajectory>(std::make_unique<LammpsDump>(path, options));
    }};

}  // namespace meniscus
