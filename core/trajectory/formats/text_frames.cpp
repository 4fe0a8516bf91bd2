// SPDX-License-Identifier: BSD-3-Clause
// Goes through lines by blocks; counts of GRO and XYZ, records of PDB tell where a frame ends.
#include "core/trajectory/formats/text_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/constants.h"
#include "core/base/parse_number.h"
#include "core/base/text_file.h"
#include "core/structure/formats/pdb_records.h"
#include "core/trajectory/formats/binary_file.h"
#include "core/trajectory/formats/cell.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\r\v\f") == std::string_view::npos; }

/// The rules by which the reader of PDB counts models.
class PdbWalk {
 public:
  explicit PdbWalk(const BinaryFile& file) : lines_(file) {}

  TextFrames run() {
    for (std::string_view line; lines_.next(line);) take(without_return(line));
    const bool cut = open_ && !ended_ && (atoms_ != atoms_of_first_ || last_atom_bytes_ < kCoordinatesEnd);
    if (cut && !result_.frames.empty()) {
      result_.cut_short = cut_short_sentence(result_.frames.size());
    } else {
      close(lines_.behind());
    }
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kCoordinatesEnd = 54;

  void take(std::string_view line) {
    if (is_pdb_atom(line)) {
      if (open_ && ended_ && !in_model_record_) close(lines_.begin());
      if (!open_) open();
      ended_ = false;
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
      ended_ = true;
    } else if (is_pdb_record(line, "CRYST1")) {
      box_ = lines_.begin();
    }
  }

  void open() {
    frame_ = {in_model_record_ ? model_record_ : lines_.begin(), 0, box_};
    open_ = true;
    atoms_ = 0;
  }

  void close(std::uint64_t end) {
    if (open_) {
      frame_.end = end;
      if (result_.frames.empty()) atoms_of_first_ = atoms_;
      result_.frames.push_back(frame_);
    }
    open_ = ended_ = false;
  }

  FileLines lines_;
  TextFrames result_;
  TextFrame frame_;
  bool open_ = false, ended_ = false, in_model_record_ = false;
  std::uint64_t model_record_ = 0, box_ = kNoBox, atoms_ = 0, atoms_of_first_ = 0;
  std::size_t last_atom_bytes_ = 0;
};

/// Frames that begin with a count (XYZ) or with a title and a count (GRO); a comment or a box makes one line more than
/// the atoms.
TextFrames walk_by_counts(const BinaryFile& file, bool title_first) {
  FileLines lines(file);
  TextFrames result;
  std::size_t last_bytes = 0, last_bytes_before = 0;  // of the last line of a frame, and of the frame before
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
    if (blank) break;  // lines behind the last frame
    last_bytes_before = std::exchange(last_bytes, line.size());
    const bool ends_in_last_line = !lines.ended_by_newline() && last_bytes < last_bytes_before;
    const bool cut = ends_in_count || (counted && (!whole || ends_in_last_line));
    if (cut && !result.frames.empty()) {
      result.cut_short = cut_short_sentence(result.frames.size());
      break;
    }
    frame.end = lines.behind();
    result.frames.push_back(frame);
  }
  return result;
}

/// The number behind a word such as "t=", which begins the text or follows a blank.
std::optional<double> number_behind(std::string_view text, std::string_view word) {
  std::size_t at = text.rfind(word);
  if (at == std::string_view::npos || (at > 0 && text[at - 1] != ' ')) return std::nullopt;
  text.remove_prefix(at + word.size());
  double number = 0.0;
  return parse_number(take_field(text), number) ? std::optional(number) : std::nullopt;
}

std::string_view first_line(std::string_view text) { return text.substr(0, text.find('\n')); }

/// All numbers of a line; none if something else stands in it.
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

/// GRO writes xx yy zz xy xz yx yz zx zy of the vectors x, y, z; the last six may be left out.
std::optional<glm::dmat3> cell_of_gro(std::string_view frame) {
  while (frame.ends_with('\n')) frame.remove_suffix(1);
  std::vector<double> n = numbers_of(frame.substr(frame.rfind('\n') + 1));
  if (n.size() != 3 && n.size() != 9) return std::nullopt;
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

}  // namespace

bool can_find_text_frames(const Reader& reader, std::string_view start) {
  if (&reader != &kPdbReader && &reader != &kGroReader && &reader != &kXyzReader) return false;
  if (start.starts_with("\x1f\x8b") || start.starts_with("\xef\xbb\xbf")) return false;
  for (std::size_t at = start.find('\r'); at != std::string_view::npos; at = start.find('\r', at + 1)) {
    if (at + 1 < start.size() && start[at + 1] != '\n') return false;
  }
  return start.find('\n') != std::string_view::npos;
}

TextFrames find_text_frames(const BinaryFile& file, const Reader& reader) {
  return &reader == &kPdbReader ? PdbWalk(file).run() : walk_by_counts(file, &reader == &kGroReader);
}

std::optional<glm::dmat3> cell_of_text(const Reader& reader, std::string_view frame, std::string_view box_record) {
  if (&reader == &kPdbReader) return cell_of_cryst1(box_record);
  return &reader == &kGroReader ? cell_of_gro(frame) : cell_of_xyz(frame);
}

std::optional<double> time_of_title(std::string_view frame) { return number_behind(first_line(frame), "t="); }

std::optional<std::int64_t> step_of_title(std::string_view frame) {
  const auto step = number_behind(first_line(frame), "step=");
  return step && std::abs(*step) < 1e15 ? std::optional(static_cast<std::int64_t>(*step)) : std::nullopt;
}

}  // namespace meniscus
