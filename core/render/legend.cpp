// SPDX-License-Identifier: BSD-3-Clause
// Lays out a legend in its strip of the picture, and draws it.
#include "core/render/legend.h"

#include <cassert>
#include <cstdlib>

#include "core/base/constants.h"

namespace meniscus {
namespace {

/// Blends a colour over a premultiplied pixel.
void cover(glm::vec4& pixel, const glm::vec3& linear, float share) {
  pixel = glm::vec4(linear * share, share) + (1.0f - share) * pixel;
}

/// Fills the part of a box of the whole picture that lies in `rows`. first: the number of their first row in the whole
/// picture.
void fill(Framebuffer& rows, int first, glm::ivec2 low, glm::ivec2 high, const auto& color_at) {
  low = glm::max(low, glm::ivec2(0, first));
  high = glm::min(high, glm::ivec2(rows.size.x, first + rows.size.y));
  for (int y = low.y; y < high.y; ++y)
    for (int x = low.x; x < high.x; ++x)
      rows.color[static_cast<std::size_t>(y - first) * rows.size.x + x] = glm::vec4(color_at(x, y), 1.0f);
}

void draw_box(Framebuffer& rows, int first, const LegendBox& box, const glm::vec3& frame, int frame_width) {
  if (box.colors.front().x < 0.0f) return;  // "+3 more" has no colour
  fill(rows, first, box.low - frame_width, box.high + frame_width, [&](int, int) { return frame; });
  const bool upright = box.high.y - box.low.y > box.high.x - box.low.x;
  fill(rows, first, box.low, box.high, [&](int x, int y) {
    const std::size_t along = static_cast<std::size_t>(upright ? box.high.y - 1 - y : x - box.low.x);
    return linear_from_srgb(box.colors[box.colors.size() == 1 ? 0 : along]);
  });
}

}  // namespace

Framebuffer with_margin(const Framebuffer& part, glm::ivec2 size, int top, const PictureLayers& layers) {
  Framebuffer whole;
  whole.size = size;
  const auto widen = [&](auto& to, const auto& from, auto empty, std::ptrdiff_t each = 1) {
    to.assign(static_cast<std::size_t>(each) * size.x * size.y, empty);
    for (int y = 0; y < part.size.y; ++y)
      std::copy_n(from.begin() + each * y * part.size.x, each * part.size.x, to.begin() + each * (top + y) * size.x);
  };
  widen(whole.color, part.color, glm::vec4(0.0f));
  if (layers.rays > 0) widen(whole.seen, part.seen, kNone, layers.rays);
  if (!layers.aovs) return whole;
  if (layers.motion) widen(whole.motion, part.motion, glm::vec2(0.0f));
  widen(whole.z, part.z, std::numeric_limits<float>::infinity());
  widen(whole.normal, part.normal, glm::vec3(0.0f));
  widen(whole.position, part.position, glm::vec3(0.0f));
  widen(whole.atom, part.atom, kNone);
  widen(whole.kind, part.kind, kNone);
  widen(whole.component, part.component, kNone);
  return whole;
}

Framebuffer Legend::add_to(const Framebuffer& molecule, const std::optional<glm::vec3>& background) const {
  assert(molecule.size == molecule_size_);
  return rows(molecule, 0, picture_size_.y, layers_of(molecule), background);
}

Framebuffer Legend::rows(const Framebuffer& molecule, int first, int count, const PictureLayers& layers,
                         const std::optional<glm::vec3>& background) const {
  assert(molecule.size.y == std::clamp(molecule_size_.y - first, 0, count));
  Framebuffer picture = with_margin(molecule, {picture_size_.x, count}, 0, layers);
  const glm::vec3 ink = linear_from_srgb(inks(background).ink);
  for (const LegendBox& box : boxes_) draw_box(picture, first, box, ink, frame_width());

  const bool at_right = molecule_size_.x < picture_size_.x;
  const glm::ivec2 corner(at_right ? molecule_size_.x : 0, std::max(at_right ? 0 : molecule_size_.y, first));
  const glm::ivec2 size = glm::max(glm::ivec2(picture_size_.x, first + count) - corner, glm::ivec2(0));
  std::vector<float> mask(static_cast<std::size_t>(size.x) * size.y, 0.0f);
  for (const LegendText& text : texts_)
    if (std::abs(2 * (text.place.y - corner.y) - size.y) <= size.y + 4 * font_.height())
      font_.draw(text.text, text.place - corner, mask, size);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      cover(picture.color[static_cast<std::size_t>(corner.y - first + y) * picture_size_.x + corner.x + x], ink,
            mask[static_cast<std::size_t>(y) * size.x + x]);
  return picture;
}

Framebuffer Legend::alone(const std::optional<glm::vec3>& background) const {
  constexpr int kTogether = 64;  // rows at a time; the whole picture may be too large for the memory
  const auto for_each_pixel = [&](const auto& work) {
    for (int first = 0; first < picture_size_.y; first += kTogether) {
      const int count = std::min(kTogether, picture_size_.y - first);
      Framebuffer nothing;
      nothing.size = {molecule_size_.x, std::clamp(molecule_size_.y - first, 0, count)};
      nothing.color.assign(static_cast<std::size_t>(nothing.size.x) * nothing.size.y, glm::vec4(0.0f));
      const Framebuffer some = rows(nothing, first, count, false, background);
      for (int y = 0; y < count; ++y)
        for (int x = 0; x < picture_size_.x; ++x) {
          const glm::vec4& pixel = some.color[static_cast<std::size_t>(y) * picture_size_.x + x];
          if (pixel.w > 0.0f) work(glm::ivec2(x, first + y), pixel);
        }
    }
  };
  glm::ivec2 low = picture_size_, high(0);
  for_each_pixel([&](glm::ivec2 at, const glm::vec4&) {
    low = glm::min(low, at);
    high = glm::max(high, at + 1);
  });
  Framebuffer legend;
  if (high.x == 0) return legend;
  const int margin = std::max(1, font_.height() / 2);
  legend.size = high - low + 2 * margin;
  legend.color.assign(static_cast<std::size_t>(legend.size.x) * legend.size.y, glm::vec4(0.0f));
  for_each_pixel([&](glm::ivec2 at, const glm::vec4& pixel) {
    const glm::ivec2 place = at - low + margin;
    legend.color[static_cast<std::size_t>(place.y) * legend.size.x + place.x] = pixel;
  });
  return legend;
}

namespace {

constexpr int kReadableLetters = 9, kSmallestLetters = 6;  // pixels
constexpr int kMostCharacters = 40;                        // length of a name

int letter_height(glm::ivec2 size) { return std::max(kReadableLetters, std::min(size.x, size.y) / 30); }

/// Returns some of the names as a list for a message.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  std::string text;
  for (std::size_t n = 0; n < std::min(names.size(), kMost); ++n) text += (n > 0 ? ", " : "") + in_quotes(names[n]);
  return text + (names.size() > kMost ? ", …" : "");
}

std::string number_text(double number) { return fmt::format("{:.4g}", number == 0.0 ? 0.0 : number); }

/// Returns a number as text, or the colour that the number encodes.
std::string class_text(const ColorScale& scale, double number) {
  return scale.of_colors ? hex_color(scale.color(number)) : number_text(number);
}

/// True if a name sorts before another one. Digits in names compare as numbers, so chain 2 is before chain 10.
bool by_name(std::string_view a, std::string_view b) {
  const auto digits = [](std::string_view text) { return std::min(text.find_first_not_of("0123456789"), text.size()); };
  while (!a.empty() && !b.empty()) {
    const std::size_t in_a = digits(a), in_b = digits(b);
    if (in_a > 0 && in_b > 0) {
      if (in_a != in_b) return in_a < in_b;
      if (const int order = a.substr(0, in_a).compare(b.substr(0, in_b)); order != 0) return order < 0;
    } else if (a.front() != b.front()) {
      return a.front() < b.front();
    }
    a.remove_prefix(std::max<std::size_t>(in_a, 1));
    b.remove_prefix(std::max<std::size_t>(in_b, 1));
  }
  return a.size() < b.size();
}

/// Returns the text of a tick. At an end of the bar it is the meaning of that end, after the number if colours are
/// steps. If there are numbers beyond the end of a fixed range, the text says so.
std::string tick_text(const ColorScale& scale, double number) {
  if (!scale.ends[0].empty() && (number == scale.range[0] || number == scale.range[1])) {
    const std::string& word = scale.ends[number == scale.range[0] ? 0 : 1];
    return scale.steps() > 0 ? number_text(number) + " " + word : word;
  }
  const auto beyond = [&](auto is_beyond) { return std::ranges::any_of(scale.value, is_beyond); };
  std::string text = number_text(number);
  if (number == scale.range[0] && beyond([&](double v) { return v < number; })) return "≤ " + text;
  if (number == scale.range[1] && beyond([&](double v) { return v > number; })) return "≥ " + text;
  return text;
}

/// Returns the numbers of at most `most` ticks of a bar, the most important first: both ends, and round numbers between
/// them unless the ends have words instead.
std::vector<double> tick_numbers(const ColorScale& scale, int most) {
  const double low = scale.range[0], high = scale.range[1];
  if (low == high) return {low};
  std::vector<double> numbers{low, high};
  if (!scale.ends[0].empty()) return numbers;
  const std::vector<double> round = round_numbers(low, high, most);
  numbers.insert(numbers.end(), round.begin(), round.end());
  return numbers;
}

/// Breaks text into lines no wider than `width`, if its words are short enough.
std::vector<std::string> wrapped(const std::string& text, const Font& font, int width) {
  std::vector<std::string> lines{""};
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || font.width(longer) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
    begin = end + 1;
  }
  return lines;
}

}  // namespace

std::vector<double> round_numbers(double low, double high, int most) {
  if (!(low < high) || most < 1) return {};
  const double rough = (high - low) / most, power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough) step = factor * power;
  std::vector<double> numbers;
  // The steps are counted by whole numbers. In a range that is narrow compared with its numbers, steps vanish in
  // rounding; `most` limits their number.
  const double first = std::floor(low / step) + 1.0;
  for (int n = 0; n <= most && (first + n) * step < high; ++n) numbers.push_back((first + n) * step);
  return numbers;
}

Legend::Legend(const ColorKey& key, glm::ivec2 picture_size, const LegendStyle& style)
    : color_(style.color),
      font_choice_(style.font),
      border_(style.border),
      font_(style.letters.value_or(letter_height(picture_size)), Weight::regular, font_choice_),
      picture_size_(picture_size),
      molecule_size_(picture_size) {
  std::vector<const ColorKey*> parts = key.parts();
  if (key.heading().empty())
    std::rotate(parts.begin(), parts.begin() + 1, parts.end());  // classes without a title come last
  for (const ColorKey* const part : parts) add_entries(*part, part == parts.front());
  if (all_.empty() && !bar_) return;  // a single colour needs no legend
  rename_entries(style.names);
  for (Entry& entry : all_) entry.name = drawable(entry.name, kMostCharacters);
  if (style.title) title_ = *style.title;
  const bool is_high = picture_size.y > picture_size.x;
  const bool at_right =
      style.place != LegendStyle::Place::below && (style.place == LegendStyle::Place::right || !is_high);
  const int usual = font_.height();
  for (const bool may_drop : {false, true})
    for (int letters = usual; letters >= kSmallestLetters; letters = std::min(letters - 1, 9 * letters / 10)) {
      // Letters of half the height have room for more. Dropping entries is better than smaller letters.
      if (letters < usual && (style.letters || (!may_drop && letters < std::max(kReadableLetters, usual / 2)))) break;
      if (lay_out(at_right, letters, may_drop)) return;
    }
  throw RequestError(
      message("@legend@ does not fit into {} x {} pixels next to the molecule; use a larger picture{}, or write the "
              "legend as a separate picture with @legend-file@",
              picture_size.x, picture_size.y, style.letters ? ", smaller letters" : ""));
}

void Legend::add_entries(const ColorKey& key, bool is_first) {
  const std::string title = key.heading();
  if (is_first)
    title_ = title;
  else if (!title.empty())
    all_.push_back({title, {}, Entry::Kind::title});
  const auto first = static_cast<std::ptrdiff_t>(all_.size());
  for (const ColorClass& entry : key.classes) all_.push_back({entry.name, entry.color});
  if (key.title == "chain")
    std::stable_sort(all_.begin() + first, all_.end(),
                     [](const Entry& a, const Entry& b) { return by_name(a.name, b.name); });
  if (!key.scale) return;
  const ColorScale& scale = *key.scale;
  for (const double number : scale.classes) all_.push_back({class_text(scale, number), scale.color(number)});
  if (scale.classes.empty() && is_first) bar_ = scale;
  if (scale.classes.empty() && !is_first) {
    const std::string ends = tick_text(scale, scale.range[0]) + " to " + tick_text(scale, scale.range[1]);
    all_.push_back({ends, {}, Entry::Kind::bar, scale});
  }
  if (scale.missing > 0)
    all_.push_back({fmt::format("none ({} atoms)", with_thousands(scale.missing)), scale.missing_color});
}

void Legend::rename_entries(const std::vector<std::string>& names) {
  std::vector<std::string> given;
  for (const Entry& entry : all_) given.push_back(entry.name);
  for (const std::string& text : names) {
    bool is_known = false;
    for (std::size_t n = 0; n < given.size(); ++n) {
      if (!text.starts_with(given[n] + "=")) continue;
      is_known = true;
      all_[n].name = text.substr(given[n].size() + 1);
    }
    if (!is_known)
      throw RequestError(message("@legend-name {}@: the legend has no such entry; it has {}", in_quotes(text),
                                 given.empty() ? "none" : listed(given)));
  }
}

bool Legend::lay_out(bool at_right, int letters, bool may_drop) {
  if (letters != font_.height()) font_ = Font(letters, Weight::regular, font_choice_);
  entries_ = all_;
  texts_.clear();
  boxes_.clear();
  molecule_size_ = picture_size_;
  return at_right ? lay_out_right(may_drop) : lay_out_bottom(may_drop);
}

/// Returns the width of an entry's box, with the gap after it.
int Legend::box_width(const Entry& entry) const {
  const int em = font_.height();
  return entry.kind == Entry::Kind::title ? 0 : (entry.kind == Entry::Kind::bar ? 4 * em : em) + em / 2;
}

int Legend::entry_width(const Entry& entry) const { return box_width(entry) + font_.width(entry.name); }

void Legend::add_entry(const Entry& entry, glm::ivec2 place) {
  const int em = font_.height();
  texts_.push_back({entry.name, {place.x + box_width(entry), place.y}});
  if (entry.kind == Entry::Kind::title) return;
  const glm::ivec2 low(place.x, place.y - em / 2);
  LegendBox& box = boxes_.emplace_back(LegendBox{low, low + em, {entry.color}});
  if (entry.kind != Entry::Kind::bar) return;
  box.high.x = low.x + 4 * em;
  box.colors.clear();
  const auto [from, to] = entry.bar->range;
  for (int n = 0; n < 4 * em; ++n) box.colors.push_back(entry.bar->color(from + (to - from) * (n + 0.5) / (4 * em)));
}

bool Legend::keep_entries(std::size_t most, bool may_drop) {
  if (entries_.size() <= most) return true;
  if (!may_drop || most == 0) return false;
  const std::size_t more = entries_.size() - most + 1;
  entries_.resize(most - 1);
  entries_.push_back({fmt::format("+{} more", with_thousands(more)), glm::vec3(-1.0f)});
  return true;
}

void Legend::shorten_entries(int most_pixels) {
  for (Entry& entry : entries_) {
    std::string name = entry.name;
    while (name.size() > 1 && entry_width(entry) > most_pixels) {
      do name.pop_back();
      while (name.size() > 1 && (static_cast<unsigned char>(name.back()) >> 6) == 2);  // removes whole UTF-8 characters
      if ((static_cast<unsigned char>(name.back()) >> 6) == 3) name.pop_back();
      entry.name = name + "…";
    }
  }
}

void Legend::add_bar(glm::ivec2 low, glm::ivec2 high, bool upright) {
  const int length = upright ? high.y - low.y : high.x - low.x;
  const double width = bar_->range[1] - bar_->range[0];
  std::vector<glm::ivec2> taken;  // ranges of texts along the bar
  const auto add_tick = [&](double number, int along) {
    const std::string text = tick_text(*bar_, number);
    const int half = upright ? line() / 2 : (font_.width(text) + font_.height()) / 2;
    if (std::ranges::any_of(taken, [&](const glm::ivec2& t) { return along - half < t.y && along + half > t.x; }))
      return;
    taken.emplace_back(along - half, along + half);
    texts_.push_back({text, upright ? glm::ivec2(high.x + font_.height() / 2, high.y - along)
                                    : glm::ivec2(low.x + along - font_.width(text) / 2, high.y + font_.height())});
  };
  if (const auto steps = static_cast<int>(bar_->steps()); steps > 0 && width > 0.0) {
    const auto number_of = [&](int n) { return bar_->range[0] + width * n / (steps - 1); };
    const auto edge = [&](int n) { return n * length / steps; };
    for (int n = 0; n < steps; ++n) {
      const int from = edge(n), to = edge(n + 1);
      boxes_.push_back({upright ? glm::ivec2(low.x, high.y - to) : glm::ivec2(low.x + from, low.y),
                        upright ? glm::ivec2(high.x, high.y - from) : glm::ivec2(low.x + to, high.y),
                        {bar_->color(number_of(n))}});
    }
    add_tick(number_of(steps - 1), (edge(steps - 1) + edge(steps)) / 2);  // both ends have words, which need room
    for (int n = 0; n < steps - 1; ++n) add_tick(number_of(n), (edge(n) + edge(n + 1)) / 2);
    return;
  }
  LegendBox box{low, high, {}};
  for (int n = 0; n < length; ++n) box.colors.push_back(bar_->color(bar_->range[0] + width * (n + 0.5) / length));
  boxes_.push_back(std::move(box));
  for (const double number : tick_numbers(*bar_, std::min(5, length / line() / 2)))
    add_tick(number, static_cast<int>(std::lround((width > 0.0 ? (number - bar_->range[0]) / width : 0.5) * length)));
}

void Legend::shift_to(glm::ivec2 place) {
  for (LegendText& text : texts_) text.place += place;
  for (LegendBox& box : boxes_) {
    box.low += place;
    box.high += place;
  }
}

bool Legend::lay_out_right(bool may_drop) {
  const int em = font_.height(), edge = std::max(em, border_), room = picture_size_.y - 2 * edge;
  std::vector<std::string> lines = wrapped(title_, font_, picture_size_.x / 4);
  if (title_.empty()) lines.clear();
  const int title_height = static_cast<int>(lines.size()) * line() + em / 2;
  const int least_bar = bar_ ? 5 * line() : 0;
  const int rows = (room - title_height - least_bar) / line();
  if (rows < 1) return false;
  shorten_entries(picture_size_.x / 2 - 2 * em);  // half of the picture is left
  int column = 1;
  for (const Entry& entry : entries_) column = std::max(column, entry_width(entry) + em);
  const int most_columns = std::max(1, picture_size_.x / 2 / column);
  if (!keep_entries(static_cast<std::size_t>(most_columns) * rows, may_drop)) return false;
  const int count = static_cast<int>(entries_.size());
  const int columns = std::max(1, (count + rows - 1) / rows), per_column = (count + columns - 1) / columns;
  int y = line() / 2;
  for (const std::string& text : lines) {
    texts_.push_back({text, {0, y}});
    y += line();
  }
  y += em / 2;
  if (bar_) {
    const int height = std::min(18 * em, room - title_height - per_column * line() - line());
    add_bar({0, y}, {em + em / 2, y + height}, true);
    y += height + line();
  }
  for (int n = 0; n < count; ++n)
    add_entry(entries_[static_cast<std::size_t>(n)], {n / per_column * column, y + n % per_column * line()});
  y += per_column * line();
  int width = 0;
  for (const LegendText& text : texts_) width = std::max(width, text.place.x + font_.width(text.text));
  molecule_size_.x = picture_size_.x - width - em - edge;
  if (molecule_size_.x < picture_size_.x / 3) return false;
  shift_to({molecule_size_.x + em, (picture_size_.y - (y - line() / 2)) / 2});
  return true;
}

bool Legend::lay_out_bottom(bool may_drop) {
  const int em = font_.height(), edge = std::max(em, border_), room = picture_size_.x - 2 * edge;
  int y = line() / 2;
  if (title_.empty()) y = 0;
  for (const std::string& text : wrapped(title_, font_, room)) {
    if (title_.empty()) break;
    texts_.push_back({text, {0, y}});
    y += line();
  }
  if (bar_) {
    int end = 2 * em;  // half a number extends beyond each end of the bar
    for (const double number : bar_->range) end = std::max(end, (font_.width(tick_text(*bar_, number)) + em) / 2);
    if (room < 14 * em || room < 4 * end) return false;
    add_bar({end, y}, {std::min(room - end, 30 * em), y + em + em / 2}, false);
    y += 3 * em + em / 2;
  }
  shorten_entries(room);
  int column = 1;
  for (const Entry& entry : entries_) column = std::max(column, entry_width(entry) + em);
  const int columns = std::max(1, (room + em) / column);
  const int rows = (picture_size_.y / 2 - y - edge - line() / 2) / line();
  if (!keep_entries(static_cast<std::size_t>(columns) * std::max(rows, entries_.empty() ? 0 : 1), may_drop))
    return false;
  for (std::size_t n = 0; n < entries_.size(); ++n)
    add_entry(entries_[n],
              {static_cast<int>(n) % columns * column, y + line() / 2 + static_cast<int>(n) / columns * line()});
  y += (static_cast<int>(entries_.size()) + columns - 1) / columns * line() + line() / 2;
  int width = 0;
  for (const LegendText& text : texts_) width = std::max(width, text.place.x + font_.width(text.text));
  molecule_size_.y = picture_size_.y - y - edge;
  if (width > room + em || molecule_size_.y < picture_size_.y / 3) return false;
  shift_to({edge, molecule_size_.y + em / 2});
  return true;
}

}  // namespace meniscus
