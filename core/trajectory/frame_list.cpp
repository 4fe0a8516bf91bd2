// SPDX-License-Identifier: BSD-3-Clause
// Parses and writes lists of frames, and reads tables with a number for each frame.
#include "core/trajectory/frame_list.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

/// A part of a list: FIRST, FIRST-LAST, FIRST- or FIRST-LAST:STEP.
struct Part {
  std::uint64_t first = 0, last = 0, step = 1;
};

class ListParser {
 public:
  ListParser(const std::string& option, std::string_view text, std::uint64_t count)
      : option_(option), text_(text), count_(count) {}

  std::vector<std::uint64_t> parse() {
    std::string_view rest = text_;
    while (true) {
      const std::size_t comma = rest.find(',');
      take(rest.substr(0, comma));
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    refuse_repeated();
    return std::move(frames_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw RequestError("{}: {} {}", option_, in_quotes(text_), what);
  }

  std::uint64_t unsigned_number(std::string_view& rest) const {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error != std::errc())
      refuse(
          "is not a list of frames such as all, 7, last, 0-99, 0-99:10, 90-, -10- (the last ten) or several of these "
          "with commas between");
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    return value;
  }

  /// Parses a frame that counts from the beginning or from the end, or that is "last".
  std::uint64_t frame(std::string_view& rest) const {
    constexpr std::string_view kLast = "last";
    if (rest.starts_with(kLast)) {
      rest.remove_prefix(kLast.size());
      return count_ - 1;
    }
    if (!skip(rest, '-')) return unsigned_number(rest);
    const std::uint64_t from_end = unsigned_number(rest);
    if (from_end == 0 || from_end > count_)
      refuse(fmt::format("names frame -{}, but from the end frames count from -1 to -{}", from_end, count_));
    return count_ - from_end;
  }

  static bool skip(std::string_view& rest, char c) {
    if (!rest.starts_with(c)) return false;
    rest.remove_prefix(1);
    return true;
  }

  Part part_of(std::string_view rest) const {
    Part part;
    part.first = part.last = frame(rest);
    if (skip(rest, '-')) part.last = rest.empty() || rest.front() == ':' ? count_ - 1 : frame(rest);
    if (skip(rest, ':')) part.step = unsigned_number(rest);
    if (!rest.empty()) refuse(fmt::format("has {} where a comma or the end should be", in_quotes(rest)));
    return part;
  }

  void take(std::string_view word) {
    const Part part = word == "all" ? Part{0, count_ - 1, 1} : part_of(word);
    const std::uint64_t beyond = std::max(part.first, part.last);
    if (beyond >= count_) {
      refuse(fmt::format("asks for frame {}; there {} {}, 0 to {}", beyond, count_ == 1 ? "is" : "are",
                         with_thousands(count_), count_ - 1));
    }
    if (part.last < part.first) refuse(fmt::format("runs backwards from {} to {}", part.first, part.last));
    if (part.step == 0) refuse("has a step of 0");
    if ((part.last - part.first) / part.step >= kMostListedFrames - frames_.size())
      refuse(fmt::format("names more than {} frames", with_thousands(kMostListedFrames)));
    for (std::uint64_t frame = part.first; frame <= part.last; frame += part.step) {
      frames_.push_back(frame);
      if (part.last - frame < part.step) break;
    }
  }

  void refuse_repeated() const {
    std::vector<std::uint64_t> sorted = frames_;
    std::ranges::sort(sorted);
    const auto twice = std::ranges::adjacent_find(sorted);
    if (twice != sorted.end()) refuse(fmt::format("has frame {} twice", *twice));
  }

  const std::string& option_;
  std::string_view text_;
  std::uint64_t count_;
  std::vector<std::uint64_t> frames_;
};

}  // namespace

std::vector<std::uint64_t> parse_frame_list(const std::string& option, std::string_view text,
                                            std::uint64_t frame_count) {
  return ListParser(option, text, frame_count).parse();
}

std::uint64_t parse_frame(const std::string& option, std::string_view text, std::uint64_t frame_count) {
  const std::vector<std::uint64_t> frames = parse_frame_list(option, text, frame_count);
  if (frames.size() != 1 || text == "all") throw RequestError("{}: {} is more than one frame", option, in_quotes(text));
  return frames.front();
}

std::string frame_list_text(const std::vector<std::uint64_t>& frames) {
  std::string text;
  for (std::size_t begin = 0; begin < frames.size();) {
    std::size_t end = begin + 1;
    std::uint64_t step = 1;
    if (end < frames.size() && frames[end] > frames[begin]) {
      step = frames[end] - frames[begin];
      while (end < frames.size() && frames[end] > frames[end - 1] && frames[end] - frames[end - 1] == step) ++end;
    }
    if (end - begin == 2 && step > 1) end = begin + 1;  // two distant frames make no series
    if (!text.empty()) text += ',';
    text += fmt::format("{}", frames[begin]);
    if (end - begin > 1) text += fmt::format("-{}", frames[end - 1]);
    if (end - begin > 1 && step > 1) text += fmt::format(":{}", step);
    begin = end;
  }
  return text;
}

double SeriesTable::at(std::uint64_t frame) const {
  const auto found = by_frame.find(frame);
  if (found == by_frame.end())
    throw InputError(
        path, 0,
        message("has no row for frame {}; write it again for all frames of the run by @csv-series@ of meniscus surface",
                frame));
  return found->second;
}

SeriesTable read_series_table(const std::string& path, const std::string& column) {
  const TextFile file = read_text_file(path);
  LineReader lines(file);
  std::string_view line;
  lines.next(line);
  const std::vector<std::string> header = csv_cells_of(line);
  const auto place = [&](std::string_view name) { return std::ranges::find(header, name); };
  const auto frame = place("frame");
  if (frame == header.end())
    throw InputError(path, 1,
                     message("is not a header with a column 'frame', as @csv-series@ of meniscus surface writes it"));
  const auto value =
      column.empty()
          ? std::ranges::find_if(header, [](const std::string& name) { return name != "frame" && name != "time"; })
          : place(column);
  if (value == header.end() || value == frame) {
    std::string list;
    for (const std::string& name : header)
      if (name != "frame") list += (list.empty() ? "" : ", ") + escaped(name);
    throw InputError(path, 1, "has no column {}; it has {}", in_quotes(column), list);
  }
  SeriesTable table{path, *value, {}};
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> cells = csv_cells_of(line);
    std::int64_t number = 0;
    double read = 0.0;
    if (cells.size() != header.size()) throw lines.error("has {} cells, the header {}", cells.size(), header.size());
    const std::string& frame_cell = cells[static_cast<std::size_t>(frame - header.begin())];
    const std::string& value_cell = cells[static_cast<std::size_t>(value - header.begin())];
    if (!parse_whole_number(frame_cell, number) || number < 0)
      throw lines.error("frame {} is not a frame number", in_quotes(frame_cell));
    if (!parse_number(value_cell, read))
      throw lines.error("{} {} is not a number", escaped(*value), in_quotes(value_cell));
    if (!table.by_frame.emplace(static_cast<std::uint64_t>(number), read).second)
      throw lines.error("frame {} appears a second time", number);
  }
  return table;
}

}  // namespace meniscus
