// SPDX-License-Identifier: BSD-3-Clause
// Finds words, or their synonyms, in the manual and in the help of commands.
#include "app/commands/help_search.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/manual_pages.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostPages = 6;
constexpr std::size_t kMostOptions = 10;

/// Words of users and the words of this program for the same thing; a blank separates alternatives.
constexpr std::pair<std::string_view, std::string_view> kSynonyms[] = {
    {"3d", "stl"},
    {"accessible", "sas"},
    {"alpha", "opacity"},
    {"amber", "prmtop trajectory"},
    {"animation", "film"},
    {"antialias", "samples"},
    {"apbs", "potential"},
    {"biomolecule", "assembly"},
    {"blur", "motion-blur"},
    {"cartoon", "tube ribbon"},
    {"charmm", "psf trajectory"},
    {"cluster", "farm"},
    {"connolly", "excluded"},
    {"contact", "interface"},
    {"crop", "margin"},
    {"delphi", "potential"},
    {"dock", "pose"},
    {"docking", "pose"},
    {"electrostatics", "potential"},
    {"fog", "depth-cue"},
    {"gif", "film"},
    {"gltf", "mesh"},
    {"gromacs", "xtc trajectory"},
    {"hbond", "hydrogen-bonds"},
    {"jupyter", "notebook"},
    {"licorice", "sticks"},
    {"movie", "film"},
    {"mp4", "film"},
    {"multimer", "assembly"},
    {"namd", "dcd trajectory"},
    {"obj", "mesh"},
    {"overwrite", "force"},
    {"ply", "mesh"},
    {"powerpoint", "slide"},
    {"print", "stl dpi"},
    {"quality", "samples"},
    {"replace", "force"},
    {"resolution", "dpi size"},
    {"rotate", "turn turntable"},
    {"sasa", "sas"},
    {"ses", "excluded"},
    {"slurm", "farm"},
    {"spin", "turntable"},
    {"stick", "sticks"},
    {"transparency", "opacity"},
    {"tunnel", "channel"},
    {"video", "film"},
    {"void", "cavity"},
    {"vrml", "mesh"},
};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower;
}

std::vector<std::string_view> words_in(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(' '); at != text.npos; at = text.find_first_not_of(' ', at)) {
    words.push_back(text.substr(at, text.find(' ', at) - at));
    at += words.back().size();
  }
  return words;
}

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Counts the words of a text, in lower case, that begin as this one does. Short words must be equal.
std::size_t count_of(std::string_view word, std::string_view text) {
  constexpr std::size_t kShort = 3;
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + word.size())) {
    const std::size_t past = at + word.size();
    const bool ends = past == text.size() || !is_letter(text[past]);
    count += (at == 0 || !is_letter(text[at - 1])) && (ends || word.size() > kShort);
  }
  return count;
}

/// Each word of a query with its synonyms.
using Query = std::vector<std::vector<std::string>>;

Query query_of(std::string_view text) {
  Query query;
  const std::string lower = lower_case(text);
  for (const std::string_view word : words_in(lower)) {
    std::vector<std::string>& alternatives = query.emplace_back();
    alternatives.emplace_back(word);
    for (const auto& [users, ours] : kSynonyms)
      if (word == users || word == fmt::format("{}s", users))
        for (const std::string_view synonym : words_in(ours)) alternatives.emplace_back(synonym);
  }
  return query;
}

/// Returns how much a text speaks of a query: 0 if one of its words is missing.
std::size_t hits(const Query& query, std::string_view text) {
  const std::string lower = lower_case(text);
  std::size_t sum = 0;
  for (const std::vector<std::string>& alternatives : query) {
    std::size_t count = 0;
    for (const std::string& word : alternatives) count += count_of(word, lower);
    if (count == 0) return 0;
    sum += count;
  }
  return sum;
}

/// A line of the result, and how well it fits.
struct Finding {
  std::size_t score = 0;
  std::string line;
};

std::string best_of(std::vector<Finding> findings, std::size_t most, std::string_view heading) {
  if (findings.empty()) return {};
  std::ranges::stable_sort(findings, std::ranges::greater{}, &Finding::score);
  std::string text = fmt::format("{}:\n", heading);
  for (std::size_t n = 0; n < std::min(most, findings.size()); ++n) text += "  " + findings[n].line + "\n";
  if (findings.size() > most) text += fmt::format("  ({} more)\n", findings.size() - most);
  return text + "\n";
}

/// Lists each option once, with the first command that has it.
std::vector<Finding> find_options(const CommandEntry& program, const Query& query) {
  std::map<std::string, Finding> found;
  for (const CommandEntry* command : all_commands(program))
    for (const OptionSection& section : command->sections)
      for (const OptionEntry& option : section.options) {
        const std::string& name = option.names.back();
        const std::size_t in_name = hits(query, name), score = 20 * in_name + hits(query, option.description);
        if (score == 0 || found.contains(name)) continue;
        const std::string sentence = option.description.substr(0, option.description.find(". "));
        found[name] = {score, fmt::format("{} {}\n      {}", command->path, name, wrapped(sentence, 94, 6))};
      }
  std::vector<Finding> findings;
  for (auto& [name, finding] : found) findings.push_back(std::move(finding));
  return findings;
}

std::vector<Finding> find_commands(const CommandEntry& program, const Query& query) {
  std::vector<Finding> findings;
  for (const CommandEntry* command : all_commands(program)) {
    if (command == &program) continue;
    const std::size_t score = 20 * hits(query, command->name) + hits(query, command->summary);
    if (score > 0) findings.push_back({score, fmt::format("{:<28} {}", command->path, command->summary)});
  }
  return findings;
}

std::vector<Finding> find_pages(const Query& query) {
  std::vector<Finding> findings;
  for (const ManualPage& page : manual_pages()) {
    if (page.path.find('/') == page.path.npos || page.path.starts_with("gallery")) continue;
    const std::size_t in_title = hits(query, fmt::format("{} {}", page.name(), page.title()));
    const std::size_t length = std::max<std::size_t>(page.markdown.size(), 2000);
    const bool shows_how = page.path.starts_with("how-to") || page.path.starts_with("tutorials");
    const std::size_t score = 100 * in_title + (shows_how ? 40'000 : 20'000) * hits(query, page.markdown) / length;
    if (score > 0) findings.push_back({score, fmt::format("meniscus help {:<20} {}", page.name(), page.title())});
  }
  return findings;
}

}  // namespace

std::string help_about(const CommandEntry& program, std::string_view text) {
  const Query query = query_of(text);
  if (query.empty()) return {};
  return best_of(find_commands(program, query), kMostPages, "Commands") +
         best_of(find_pages(query), kMostPages, "Pages of the manual") +
         best_of(find_options(program, query), kMostOptions, "Options");
}

}  // namespace meniscus
