// SPDX-License-Identifier: BSD-3-Clause
// Reads the models of a structure file (PDB, mmCIF, GRO, XYZ, ...) as frames of a trajectory. In plain text files it
// finds the models without parsing atoms.

#include "core/base/binary_file.h"
#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/formats/pdb_records.h"
#include "core/structure/formats/structure_formats.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

inline constexpr std::uint64_t kNoBox = ~std::uint64_t{0};

/// A part of the file that the reader of its format takes for one model.
struct TextFrame {
  std::uint64_t begin = 0, end = 0;
  std::uint64_t box = kNoBox;  ///< PDB: offset of the CRYST1 record that applies to the model
};

/// The models of a text file.
struct TextFrames {
  std::vector<TextFrame> frames;
  std::string cut_short;  ///< see Trajectory::cut_short()
};

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\r\v\f") == std::string_view::npos; }

/// Finds the models of a PDB file by the same rules as the reader of PDB.
class PdbWalk {
 public:
  explicit PdbWalk(const BinaryFile& file) : lines_(file) {}

  TextFrames run() {
    for (std::string_view line; lines_.next(line);) take(without_return(line));
    const bool cut = is_open_ && !has_ended_ && (atoms_ != atoms_of_first_ || last_atom_bytes_ < kCoordinatesEnd);
    if (cut && !result_.frames.empty()) {
      result_.cut_short = cut_short_sentence(result_.frames.size());
    } else {
      close(lines_.next_offset());
    }
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kCoordinatesEnd = 54;

  void take(std::string_view line) {
    if (is_pdb_atom(line)) {
      if (is_open_ && has_ended_ && !in_model_record_) close(lines_.begin());
      if (!is_open_) open();
      has_ended_ = false;
      ++atoms_;
      last_atom_bytes_ = line.size();
    } else if (is_pdb_record(line, "MODEL")) {
      close(lines_.begin());
      in_model_record_ = true;
      model_record_ = lines_.begin();
    } else if (is_pdb_record(line, "ENDMDL")) {
      close(lines_.begin());
      in_model_record_ = false;
    } else if (is_pdb_record(line, "END")) {
      has_ended_ = true;
    } else if (is_pdb_record(line, "CRYST1")) {
      box_ = lines_.begin();
    }
  }

  void open() {
    frame_ = {in_model_record_ ? model_record_ : lines_.begin(), 0, box_};
    is_open_ = true;
    atoms_ = 0;
  }

  void close(std::uint64_t end) {
    if (is_open_) {
      frame_.end = end;
      if (result_.frames.empty()) atoms_of_first_ = atoms_;
      result_.frames.push_back(frame_);
    }
    is_open_ = has_ended_ = false;
  }

  FileLines lines_;
  TextFrames result_;
  TextFrame frame_;
  bool is_open_ = false, has_ended_ = false, in_model_record_ = false;
  std::uint64_t model_record_ = 0, box_ = kNoBox, atoms_ = 0, atoms_of_first_ = 0;
  std::size_t last_atom_bytes_ = 0;
};

/// Finds frames that begin with a count (XYZ), or with a title and a count (GRO). A frame has one line more than atoms:
/// a comment or a box.
TextFrames walk_by_counts(const BinaryFile& file, bool title_first) {
  FileLines lines(file);
  TextFrames result;
  std::size_t last_bytes = 0, last_bytes_before = 0;  // size of the last line of this frame, and of the previous one
  for (std::string_view line; lines.next(line);) {
    if (!title_first && is_blank(line)) continue;
    TextFrame frame{lines.begin(), 0, kNoBox};
    bool blank = is_blank(line), whole = true;
    const auto advance = [&] {
      whole = lines.next(line);
      blank = blank && is_blank(line);
    };
    if (title_first) advance();
    const bool ends_in_count = !whole || !lines.ended_by_newline();
    std::int64_t count = 0;
    const bool counted = whole && parse_whole_number(without_return(line), count) && count >= 0;
    for (std::int64_t n = 0; whole && (!counted || n <= count); ++n) advance();
    if (blank) break;  // only blank lines follow the last frame
    last_bytes_before = std::exchange(last_bytes, line.size());
    const bool ends_in_last_line = !lines.ended_by_newline() && last_bytes < last_bytes_before;
    const bool cut = ends_in_count || (counted && (!whole || ends_in_last_line));
    if (cut && !result.frames.empty()) {
      result.cut_short = cut_short_sentence(result.frames.size());
      break;
    }
    frame.end = lines.next_offset();
    result.frames.push_back(frame);
  }
  return result;
}

/// Returns the number after a word such as "t=", which must begin the text or follow a blank.
std::optional<double> number_behind(std::string_view text, std::string_view word) {
  std::size_t at = text.rfind(word);
  if (at == std::string_view::npos || (at > 0 && text[at - 1] != ' ')) return std::nullopt;
  text.remove_prefix(at + word.size());
  double number = 0.0;
  return parse_number(take_field(text), number) ? std::optional(number) : std::nullopt;
}

std::string_view first_line(std::string_view text) { return text.substr(0, text.find('\n')); }

/// Returns all numbers of a line. The result is empty if the line has anything else.
std::vector<double> numbers_of(std::string_view line) {
  std::vector<double> numbers;
  for (const std::string_view field : fields_of(line)) {
    double number = 0.0;
    if (!parse_number(field, number)) return {};
    numbers.push_back(number);
  }
  return numbers;
}

std::optional<glm::dmat3> cell_of_cryst1(std::string_view record) {
  std::array<double, 6> numbers;
  constexpr std::array<std::array<std::size_t, 2>, 6> kColumns{{{6, 9}, {15, 9}, {24, 9}, {33, 7}, {40, 7}, {47, 7}}};
  for (std::size_t n = 0; n < 6; ++n) {
    const auto [begin, width] = kColumns[n];
    if (record.size() <= begin || !parse_number(record.substr(begin, width), numbers[n])) return std::nullopt;
  }
  const glm::dvec3 edges(numbers[0], numbers[1], numbers[2]), angles(numbers[3], numbers[4], numbers[5]);
  if (edges == glm::dvec3(1.0) && angles == glm::dvec3(90.0)) return std::nullopt;
  return cell_of_angles(edges, angles);
}

/// Returns the box of a GRO frame. It is written as xx yy zz xy xz yx yz zx zy of the vectors x, y, z, and the last six
/// may be left out.
std::optional<glm::dmat3> cell_of_gro(std::string_view frame) {
  while (frame.ends_with('\n')) frame.remove_suffix(1);
  std::vector<double> n = gro_box(frame.substr(frame.rfind('\n') + 1));
  if (n.empty()) return std::nullopt;
  n.resize(9);
  return cell_of_vectors(kAngstromPerNanometre * glm::dmat3(n[0], n[3], n[4], n[5], n[1], n[6], n[7], n[8], n[2]));
}

std::optional<glm::dmat3> cell_of_xyz(std::string_view frame) {
  constexpr std::string_view kKey = "Lattice=\"";
  frame.remove_prefix(std::min(frame.size(), frame.find('\n') + 1));
  const std::string_view comment = first_line(frame);
  const std::size_t at = comment.find(kKey);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = comment.substr(at + kKey.size());
  const std::vector<double> n = numbers_of(rest.substr(0, rest.find('"')));
  if (n.size() != 9) return std::nullopt;
  return cell_of_vectors(glm::dmat3(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]));
}

/// True if find_text_frames() can find the frames of a file of this format. Its text must not be packed, and its lines
/// must end in LF or CR LF.
bool can_find_text_frames(const Reader& reader, std::string_view start) {
  if (&reader != &kPdbReader && &reader != &kGroReader && &reader != &kXyzReader) return false;
  if (start.starts_with("\x1f\x8b") || start.starts_with("\xef\xbb\xbf")) return false;
  for (std::size_t at = start.find('\r'); at != std::string_view::npos; at = start.find('\r', at + 1)) {
    if (at + 1 < start.size() && start[at + 1] != '\n') return false;
  }
  return start.find('\n') != std::string_view::npos;
}

/// Finds the models by walking through the file once, line by line. Where a count is not a number the last frame
/// begins, and its reader reports the error. A last frame that is cut short is left out, unless it is the only one.
TextFrames find_text_frames(const BinaryFile& file, const Reader& reader) {
  return &reader == &kPdbReader ? PdbWalk(file).run() : walk_by_counts(file, &reader == &kGroReader);
}

/// Returns the box of a frame: from its CRYST1 record (PDB), its last line (GRO) or Lattice="..." (extended XYZ). The
/// record 1 1 1 90 90 90, which means that there is no crystal, gives no box.
std::optional<glm::dmat3> cell_of_text(const Reader& reader, std::string_view frame, std::string_view box_record) {
  if (&reader == &kPdbReader) return cell_of_cryst1(box_record);
  return &reader == &kGroReader ? cell_of_gro(frame) : cell_of_xyz(frame);
}

/// Returns the time (ps) after "t=" in the title of a GRO frame.
std::optional<double> time_of_title(std::string_view frame) { return number_behind(first_line(frame), "t="); }

/// Returns the step after "step=" in the title of a GRO frame.
std::optional<std::int64_t> step_of_title(std::string_view frame) {
  const auto step = number_behind(first_line(frame), "step=");
  return step && std::abs(*step) < 1e15 ? std::optional(static_cast<std::int64_t>(*step)) : std::nullopt;
}

/// The models of a file that has to be read as a whole, because of its format or because it is packed. All models stay
/// in memory.
class ModelsInMemory final : public Trajectory {
 public:
  explicit ModelsInMemory(const std::string& path) : Trajectory(path, "models") {
    const TextFile file = read_molecule_file(path);
    const Reader& reader = choose_reader(file);
    format_ = fmt::format("models of {}", reader.metadata.name);
    const FileContents contents = reader.read(file, ModelChoice{1, true});
    if (contents.without_positions)
      throw InputError(path, 0, "lists atoms without coordinates: it is not a trajectory");
    for (const Atom& atom : contents.atoms) {
      const auto model = static_cast<std::size_t>(atom.model);  // mmCIF may list atoms of several models alternately
      if (frames_.size() < model) frames_.resize(model);
      frames_[model - 1].push_back(atom.position);
    }
    if (frames_.empty()) throw InputError(path, 0, "holds no atoms");
    atom_count_ = frames_.front().size();
    frame_count_ = frames_.size();
  }

 private:
  void read_unchecked(std::uint64_t number, Frame& frame) override {
    frame.positions = frames_[static_cast<std::size_t>(number)];
  }

  std::vector<std::vector<glm::dvec3>> frames_;
};

/// The models of a plain text file. Only their places are in memory, and read() parses one model.
class ModelsInFile final : public Trajectory {
 public:
  ModelsInFile(const std::string& path, const Reader& reader)
      : Trajectory(path, fmt::format("models of {}", reader.metadata.name)), file_(path), reader_(reader) {
    TextFrames found = find_text_frames(file_, reader);
    frames_ = std::move(found.frames);
    cut_short_ = std::move(found.cut_short);
    if (frames_.empty()) throw InputError(path, 0, "holds no atoms");
    frame_count_ = frames_.size();
    Frame first;
    read_unchecked(0, first);
    atom_count_ = first.positions.size();
  }

 private:
  std::string text_of(std::uint64_t begin, std::uint64_t end) const {
    constexpr std::uint64_t kLargest = std::uint64_t{2} << 30;
    if (end - begin > kLargest)
      throw CapacityError("{}: one of its models has {} bytes, more than this program reads", path_,
                          with_thousands(end - begin));
    std::string text(end - begin, '\0');
    file_.read(begin, std::as_writable_bytes(std::span(text)));
    std::erase(text, '\r');
    return text;
  }

  void read_unchecked(std::uint64_t number, Frame& frame) override {
    const TextFrame& place = frames_[number];
    const TextFile model{fmt::format("{}, frame {}", path_, number), text_of(place.begin, place.end)};
    std::string box;
    constexpr std::uint64_t kBoxRecord = 80;
    if (place.box != kNoBox) box = text_of(place.box, std::min(file_.size(), place.box + kBoxRecord));
    file_.check_unchanged();
    if (model.text.find('\0') != std::string::npos) throw InputError(model.path, 0, "is binary, not text");
    if (!reader_.positions || !reader_.positions(model.text, frame.positions)) {
      const FileContents contents = reader_.read(model, ModelChoice{});
      frame.positions.clear();
      for (const Atom& atom : contents.atoms) frame.positions.push_back(atom.position);
    }
    frame.cell = cell_of_text(reader_, model.text, box.substr(0, box.find('\n')));
    if (&reader_ != &kGroReader) return;
    frame.time = time_of_title(model.text);
    frame.step = step_of_title(model.text);
  }

  BinaryFile file_;
  const Reader& reader_;
  std::vector<TextFrame> frames_;
};

std::unique_ptr<Trajectory> open_models(const std::string& path, const TrajectoryOptions&) {
  constexpr std::uint64_t kStart = std::uint64_t{1} << 20;  // long enough for the remarks of PDB
  std::string start;
  {
    const BinaryFile file(path);
    start.resize(std::min(file.size(), kStart));
    file.read(0, std::as_writable_bytes(std::span(start)));
  }
  const bool text =
      start.find('\0') == std::string::npos && start.find_first_not_of(" \t\r\n\v\f") != std::string::npos;
  if (text && !start.starts_with("\x1f\x8b")) {
    const TextFile file{path, start};
    const Reader& reader = choose_reader(file);
    if (can_find_text_frames(reader, start)) return std::make_unique<ModelsInFile>(path, reader);
  }
  return std::make_unique<ModelsInMemory>(path);
}

}  // namespace

const TrajectoryFormat kModelsFormat{
    {"models", ".pdb .cif .bcif .sdf .mol2 .pdbqt .gro .xyz .crd",
     "each model of a structure file of any format is a frame", "those of the formats of structures",
     "positions; boxes of CRYST1, GRO and extended XYZ, times of GRO titles; of plain "
     "PDB, GRO and XYZ files one model is "
     "in memory at a time, of others all"},
    [](std::string_view) { return true; },
    open_models};

}  // namespace meniscus
