// SPDX-License-Identifier: BSD-3-Clause
// `meniscus help NAME`: shows a page of the manual, the help of a command, or what speaks of a word; writes man pages.
#include <algorithm>
#include <iostream>
#include <memory>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include "app/commands/command_table.h"
#include "app/commands/help_search.h"
#include "app/commands/manual_pages.h"
#include "app/options/command_tree.h"
#include "app/options/property_options.h"
#include "app/options/scene_schema.h"
#include "app/process/program_main.h"
#include "app/reports/command_manual.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/structure/selection/selection_words.h"

namespace meniscus {
namespace {

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

/// Returns the codes of the page exit-codes, a line each: "  0  done".
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
  throw UsageError(fmt::format("nothing in the help speaks of {}{}; meniscus help lists the pages", in_quotes(name),
                               nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest)));
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
