// SPDX-License-Identifier: BSD-3-Clause
// `meniscus help NAME`: shows a page of the manual, the help of a command, or texts that mention a word or its
// synonyms; writes man pages.
#include <cctype>
#include <iostream>

#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include "app/commands/command_table.h"
#include "app/options/command_tree.h"
#include "app/options/property_options.h"
#include "app/process/program_main.h"
#include "app/reports/command_manual.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/structure/selection/selection_words.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostPages = 6;
constexpr std::size_t kMostOptions = 10;

/// Words of this program, and words of users for the same thing, separated by blanks.
constexpr std::pair<std::string_view, std::string_view> kSynonyms[] = {
    {"assembly", "biomolecule multimer"},
    {"bfactor", "b-factor"},
    {"cavities", "cavity void"},
    {"channel", "tunnel"},
    {"dcd", "namd"},
    {"depth-cue", "fog"},
    {"download", "fetch"},
    {"dpi", "print resolution"},
    {"excluded", "connolly ses"},
    {"farm", "cluster slurm supercomputer"},
    {"film", "animation gif movie mp4 video"},
    {"force", "overwrite replace"},
    {"gpu", "cuda"},
    {"hydrogen-bonds", "hbond"},
    {"interface", "contact"},
    {"licence", "license"},
    {"macos", "mac"},
    {"margin", "crop"},
    {"mesh", "gltf obj ply vrml"},
    {"motion-blur", "blur"},
    {"notebook", "jupyter"},
    {"opacity", "alpha transparency transparent"},
    {"periodic", "pbc"},
    {"pose", "dock docking"},
    {"potential", "apbs delphi electrostatics"},
    {"prmtop", "amber"},
    {"psf", "charmm"},
    {"ribbon", "cartoon"},
    {"samples", "antialias quality"},
    {"sas", "accessible sasa"},
    {"silhouettes", "outline"},
    {"size", "resolution"},
    {"slide", "powerpoint"},
    {"sticks", "licorice"},
    {"stl", "3d print"},
    {"trajectory", "amber charmm gromacs namd"},
    {"tube", "cartoon"},
    {"turn", "rotate"},
    {"turntable", "rotate spin"},
    {"xtc", "gromacs"},
};

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
    for (const auto& [ours, users] : kSynonyms)
      for (const std::string_view synonym : words_in(users))
        if (word == synonym || word == fmt::format("{}s", synonym)) alternatives.emplace_back(ours);
  }
  return query;
}

/// Returns how often a text mentions the words of a query; 0 if one of them is missing.
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

/// A line of the result, and its score.
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

/// Returns the commands, options and pages of the manual that mention all words of a query, best first, as text for
/// people. A word also stands for its synonyms in other programs ("movie" for "film"). The result is empty if nothing
/// is found.
std::string help_about(const CommandEntry& program, std::string_view text) {
  const Query query = query_of(text);
  if (query.empty()) return {};
  return best_of(find_commands(program, query), kMostPages, "Commands") +
         best_of(find_pages(query), kMostPages, "Pages of the manual") +
         best_of(find_options(program, query), kMostOptions, "Options");
}

struct Topic {
  std::string_view name;
  std::string_view summary;
  std::string (*page)();
};

/// The topics that the program writes from its tables.
constexpr Topic kTopics[] = {
    {"selections", "the language of --select, --show and --context", selection_help},
    {"scenes", "all keys of scene files, with their options", scene_help},
};

/// The folders of the manual, in reading order.
constexpr std::string_view kShelves[] = {"tutorials", "how-to", "reference", "explanation", "validation"};

bool is_on(std::string_view shelf, const ManualPage& page) { return page.path.starts_with(fmt::format("{}/", shelf)); }

void list_topics(const CLI::App& program) {
  fmt::print(std::cout, "meniscus help NAME shows a page. Pages about commands:\n\n");
  for (const CLI::App* command : program.get_subcommands({}))
    fmt::print(std::cout, "  {:<12} {}\n", command->get_name(), command->get_description());
  fmt::print(std::cout, "\nAbout words and keys:\n\n");
  for (const Topic& topic : kTopics) fmt::print(std::cout, "  {:<12} {}\n", topic.name, topic.summary);
  fmt::print(std::cout, "\nOf the manual:\n");
  for (const std::string_view shelf : kShelves) {
    fmt::print(std::cout, "\n{}\n", shelf);
    for (const ManualPage& page : manual_pages())
      if (is_on(shelf, page)) fmt::print(std::cout, "  {:<18} {}\n", page.name(), page.title());
  }
}

/// Markdown is readable as it is; only long lines are wrapped, outside of tables and code.
std::string readable(std::string_view markdown) {
  std::string text;
  bool code = false;
  while (!markdown.empty()) {
    const std::size_t end = std::min(markdown.find('\n'), markdown.size());
    const std::string_view line = markdown.substr(0, end);
    markdown.remove_prefix(std::min(end + 1, markdown.size()));
    if (line.starts_with("```")) code = !code;
    const bool item = line.starts_with("* ") || line.starts_with("- ");
    text += (code || line.starts_with('|') ? std::string(line) : wrapped(line, 100, item ? 2 : 0)) + "\n";
  }
  return text;
}

/// Returns the page of the manual with this name; null if there is none.
const ManualPage* manual_page(std::string_view name) {
  for (const std::string_view shelf : kShelves)
    for (const ManualPage& page : manual_pages())
      if (is_on(shelf, page) && page.name() == name) return &page;
  return nullptr;
}

/// Returns the page with this name, from the manual or written by the program; empty if there is none.
std::string page_named(std::string_view name) {
  std::string text;
  if (const ManualPage* page = manual_page(name)) text = readable(page->markdown);
  for (const Topic& topic : kTopics)
    if (name == topic.name) text.append(text.empty() ? "" : "\n").append(topic.page());
  return text;
}

/// Returns a one-line summary of a page.
std::string_view summary_of(std::string_view name) {
  for (const Topic& topic : kTopics)
    if (name == topic.name) return topic.summary;
  return manual_page(name)->title();
}

/// Returns the codes of the page exit-codes, one per line: "  0  done".
std::string exit_codes() {
  std::string lines;
  std::string_view text = manual_page("exit-codes")->markdown;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::size_t bar = line.find(" | ");
    if (line.starts_with("| ") && line.ends_with(" |") && line[2] >= '0' && line[2] <= '9')
      lines += fmt::format("  {}  {}\n", line.substr(2, bar - 2), line.substr(bar + 3, line.size() - bar - 5));
  }
  return lines;
}

/// Returns the names of commands, of pages of the manual, and of pages that the program writes.
std::vector<std::string> page_names(const CLI::App& program) {
  std::set<std::string> names;
  for (const Topic& topic : kTopics) names.emplace(topic.name);
  for (const CLI::App* command : program.get_subcommands({})) names.insert(command->get_name());
  for (const std::string_view shelf : kShelves)
    for (const ManualPage& page : manual_pages())
      if (is_on(shelf, page)) names.emplace(page.name());
  return {names.begin(), names.end()};
}

void show(const CLI::App& program, const std::string& name) {
  const std::string text = page_named(name);
  std::cout << text;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() != name) continue;
    if (text.empty())
      std::cout << command->help("meniscus");
    else
      fmt::print(std::cout, "\nThe options of the command: meniscus {} --help\n", name);
    return;
  }
  if (!text.empty()) return;
  const std::string found = help_about(command_tree(program), name);
  if (!found.empty()) {
    std::cout << found;
    return;
  }
  const std::vector<std::string> names = page_names(program);
  const std::string_view nearest = nearest_word(name, std::vector<std::string_view>(names.begin(), names.end()));
  throw UsageError("nothing in the help speaks of {}{}; meniscus help lists the pages", in_quotes(name),
                   nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
}

/// Writes a page of section 1 for every command, and pages of section 7 for common topics.
void write_man_pages(const CLI::App& program, const std::string& folder) {
  const CommandEntry tree = command_tree(program);
  const ManMargins margins{build_date(), std::string("meniscus ") + MENISCUS_VERSION};
  OutputFolder pages(folder, Existing::replace);
  for (const CommandEntry* command : all_commands(tree))
    pages.file(man_page_name(*command) + ".1").write(command_man_page(*command, tree, exit_codes(), margins));
  for (const std::string_view name : {"selections", "scenes", "assemblies", "frames", "exit-codes"})
    pages.file(man_page_name(name) + ".7").write(topic_man_page(name, summary_of(name), page_named(name), margins));
  pages.commit();
}

}  // namespace

void add_help(CLI::App& command) {
  describe(command,
           "  meniscus help\n"
           "  meniscus help selections\n"
           "  meniscus help movie                commands, pages and options that speak of films\n"
           "  meniscus help --man man            a manual page of every command and topic, into the folder man");
  auto topic = std::make_shared<std::vector<std::string>>();
  auto folder = std::make_shared<std::string>();
  auto schema = std::make_shared<bool>(false);
  command.add_option("TOPIC", *topic, "Page to show, or words to search for; without them, the list of pages")
      ->check(proposes(page_names(*command.get_parent())))
      ->type_name("");
  PropertyOptions options(command);
  options.add("help.man", *folder);
  options.add("help.scene_schema", *schema);
  command.callback([topic, folder, schema, &command] {
    const CLI::App& program = *command.get_parent();
    if (*schema) {
      std::cout << scene_schema();
    } else if (!folder->empty()) {
      write_man_pages(program, *folder);
    } else if (topic->empty()) {
      list_topics(program);
    } else {
      show(program, fmt::format("{}", fmt::join(*topic, " ")));
    }
  });
}

}  // namespace meniscus
