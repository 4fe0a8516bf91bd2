// SPDX-License-Identifier: BSD-3-Clause
// Writes manual pages.
#include "app/reports/command_manual.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace meniscus {
namespace {

/// Escapes text for groff, which takes backslashes, hyphens, quotes and a few other characters for typography.
std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '"':
        result += "\\(dq";
        break;
      case '`':
        result += "\\(ga";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      default:
        result += c;
    }
  }
  // A line that begins with a dot would be a macro.
  return result.starts_with('.') ? "\\&" + result : result;
}

/// Returns a request for each line of a text that is printed verbatim.
std::string as_it_is(std::string_view text) {
  while (text.starts_with('\n')) text.remove_prefix(1);
  while (text.ends_with('\n')) text.remove_suffix(1);
  std::string result = ".nf\n";
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    result += plain(text.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  return result + ".fi\n";
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string heading(std::string_view name, std::string_view section, std::string_view summary,
                    const ManMargins& margins) {
  return fmt::format(".TH {} {} {} \"{}\" Meniscus\n.SH NAME\n{} \\- {}\n", plain(upper(std::string(name))), section,
                     margins.date, plain(margins.version), plain(name), plain(summary));
}

/// Returns \fB\-o\fR, \fB\-\-output\fR \fIPATH\fR.
std::string term(const OptionEntry& option, bool argument) {
  std::string text;
  for (const std::string& name : option.names)
    text += fmt::format("{}\\f{}{}\\fR", text.empty() ? "" : ", ", argument ? 'I' : 'B', plain(name));
  if (!option.value.empty()) text += " \\fI" + plain(option.value) + "\\fR";
  return text;
}

std::string entry(const OptionEntry& option, bool argument) {
  return fmt::format(".TP\n{}{}\n{}\n", term(option, argument), option.required ? " (required)" : "",
                     plain(option.description));
}

std::string synopsis(const CommandEntry& command) {
  std::string text = fmt::format(".SH SYNOPSIS\n\\fB{}\\fR [\\fIOPTIONS\\fR]", plain(command.path));
  for (const OptionEntry& argument : command.arguments) {
    const std::string name = "\\fI" + plain(argument.names.front()) + "\\fR";
    text += argument.required ? " " + name : " [" + name + "]";
  }
  return text + (command.commands.empty() ? "\n" : " \\fICOMMAND\\fR\n");
}

/// Splits a footer: the examples come first, other text after an empty line.
std::string examples_and_details(const std::string& footer) {
  if (footer.empty()) return {};
  const std::size_t gap = footer.find("\n\n");
  std::string text;
  if (gap != std::string::npos) text = ".PP\n" + as_it_is(std::string_view(footer).substr(gap));
  return text + ".SH EXAMPLES\n" + as_it_is(footer.substr(0, gap));
}

std::string options(const CommandEntry& command) {
  std::string text;
  if (!command.arguments.empty()) text += ".SH ARGUMENTS\n";
  for (const OptionEntry& argument : command.arguments) text += entry(argument, true);
  text += ".SH OPTIONS\n";
  for (const OptionSection& section : command.sections) {
    if (section.title != "Options") text += ".SS " + plain(section.title) + "\n";
    for (const OptionEntry& option : section.options) text += entry(option, false);
  }
  return text;
}

std::string commands(const CommandEntry& command) {
  if (command.commands.empty()) return {};
  std::string text = ".SH COMMANDS\n";
  for (const CommandEntry& below : command.commands)
    text += fmt::format(".TP\n\\fB{}\\fR\n{}; see\n.BR {} (1)\n", plain(below.name), plain(below.summary),
                        plain(man_page_name(below)));
  return text;
}

}  // namespace

std::string man_page_name(const CommandEntry& command) {
  std::string name = command.path;
  for (char& c : name)
    if (c == ' ') c = '-';
  return name;
}

std::string man_page_name(std::string_view topic) { return fmt::format("meniscus-{}", topic); }

std::string command_man_page(const CommandEntry& command, const CommandEntry& program, std::string_view exit_codes,
                             const ManMargins& margins) {
  std::string text = heading(man_page_name(command), "1", command.summary, margins) + synopsis(command) +
                     ".SH DESCRIPTION\n" + plain(command.summary) + "\n" + examples_and_details(command.footer) +
                     options(command) + commands(command) + ".SH EXIT STATUS\n" + as_it_is(exit_codes) +
                     ".SH SEE ALSO\n";
  std::string others;
  for (const CommandEntry* other : all_commands(program))
    if (other != &command)
      others += fmt::format("{}.BR {} (1)", others.empty() ? "" : " ,\n", plain(man_page_name(*other)));
  return text + others + "\n";
}

std::string topic_man_page(std::string_view name, std::string_view summary, std::string_view text,
                           const ManMargins& margins) {
  return heading(man_page_name(name), "7", summary, margins) + ".SH DESCRIPTION\n" + as_it_is(text) +
         ".SH SEE ALSO\n.BR meniscus (1)\n";
}

}  // namespace meniscus
