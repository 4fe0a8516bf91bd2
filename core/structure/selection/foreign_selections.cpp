// SPDX-License-Identifier: BSD-3-Clause
// Splits words such as /a//A/10 and /A:10@CA at their signs, and writes each part with the keyword of Meniscus.
#include "core/structure/selection/foreign_selections.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/text.h"

namespace meniscus {
namespace {

/// Short words of PyMOL and the keywords of Meniscus for them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kShortWords{{{"c.", "chain"},
                                                                                     {"i.", "resid"},
                                                                                     {"r.", "resname"},
                                                                                     {"n.", "name"},
                                                                                     {"e.", "element"},
                                                                                     {"s.", "chain"},
                                                                                     {"w.", "within"},
                                                                                     {"a.", "around"},
                                                                                     {"x.", "expand"},
                                                                                     {"br.", "byres"},
                                                                                     {"bc.", "bychain"},
                                                                                     {"h.", "hydrogen"},
                                                                                     {"bb.", "backbone"},
                                                                                     {"sc.", "sidechain"},
                                                                                     {"sol.", "water"},
                                                                                     {"org.", "organic"},
                                                                                     {"ino.", "inorganic"},
                                                                                     {"pol.", "polymer"}}};

/// A selection of Meniscus that is put together part by part.
class Translation {
 public:
  void add(std::string_view keyword, std::string_view value) {
    if (value.empty() || value == "*") return;
    text_ += fmt::format("{}{} {}", text_.empty() ? "" : " and ", keyword, value);
  }
  /// Adds residues by number or by name.
  void add_residues(std::string_view value) {
    const bool number = !value.empty() && (std::isdigit(static_cast<unsigned char>(value[0])) || value[0] == '-');
    add(number ? "resid" : "resname", value);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::vector<std::string_view> fields_between_slashes(std::string_view word) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t slash = word.find('/');
    fields.push_back(word.substr(0, slash));
    if (slash == std::string_view::npos) return fields;
    word.remove_prefix(slash + 1);
  }
}

/// Translates /object/segment/chain/residue/name. The first slash and the parts at the left may be missing, as in
/// A/10/CA.
std::string from_pymol(std::string_view word) {
  std::vector<std::string_view> fields = fields_between_slashes(word);
  if (fields.front().empty())
    fields.erase(fields.begin());
  else
    while (fields.size() < 5) fields.insert(fields.begin(), "");
  fields.resize(5);
  Translation translation;
  translation.add("chain", fields[2]);
  const std::size_t tick = fields[3].find('`');  // as in LYS`10
  translation.add_residues(fields[3].substr(0, tick));
  if (tick != std::string_view::npos) translation.add_residues(fields[3].substr(tick + 1));
  translation.add("name", fields[4].substr(0, fields[4].find('`')));
  return translation.text();
}

/// Translates #structure.model/chain:residue@name, in which each part may be missing. In Chimera's :10.A the chain
/// follows the residue. The number of the structure is ignored, because it numbers the files that were opened there.
std::string from_chimerax(std::string_view word) {
  constexpr std::string_view kSigns = "#/:@";
  Translation translation;
  while (!word.empty()) {
    const char sign = word[0];
    const std::size_t end = std::min(word.find_first_of(kSigns, 1), word.size());
    const std::string_view value = word.substr(1, end - 1);
    const std::size_t dot = value.find('.');
    if (sign == '#' && dot != std::string_view::npos) translation.add("model", value.substr(dot + 1));
    if (sign == '/') translation.add("chain", value);
    if (sign == ':') {
      translation.add_residues(value.substr(0, dot));
      if (dot != std::string_view::npos) translation.add("chain", value.substr(dot + 1));
    }
    if (sign == '@') translation.add("name", value);
    word.remove_prefix(end);
  }
  return translation.text();
}

}  // namespace

std::string advice_on_foreign_selection(std::string_view word) {
  const auto found = std::ranges::find(kShortWords, word, &std::pair<std::string_view, std::string_view>::first);
  if (found != kShortWords.end()) return fmt::format("{} is PyMOL's; write {}", in_quotes(word), found->second);
  const auto slashes = std::ranges::count(word, '/');
  const bool pymol = slashes > 1 || (slashes == 1 && word[0] != '/' && word[0] != '#');
  const bool chimerax = !pymol && !word.empty() && std::string_view("#/:@").find(word[0]) != std::string_view::npos;
  if (!pymol && !chimerax) return "";
  const std::string translation = pymol ? from_pymol(word) : from_chimerax(word);
  if (translation.empty()) return "";
  return fmt::format("{} is written in {}'s way; write '{}'", in_quotes(word), pymol ? "PyMOL" : "ChimeraX",
                     shortened(translation, 200));
}

}  // namespace meniscus
