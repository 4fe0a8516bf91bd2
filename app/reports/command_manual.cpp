// SPDX-License-Identifier: BSD-3-Clause
// Writes manual pages as roff, and completion for bash, zsh and fish.
//
// In all shells the words before the cursor are followed down the tree; candidates are the options of that command, its
// commands, the words of an option, or a path.
#include "app/reports/command_manual.h"

#include <algorithm>
#include <map>

#include "core/base/text.h"

namespace meniscus {
namespace {

/// Escapes text for groff, which takes backslashes, hyphens, quotes and a few other characters for typography.
std::string plain(std::string_view text) {
  static const std::map<char, std::string_view> kEscapes{
      {'\\', "\\e"}, {'-', "\\-"}, {'\'', "\\(aq"}, {'"', "\\(dq"}, {'`', "\\(ga"}, {'^', "\\(ha"}, {'~', "\\(ti"}};
  std::string result;
  for (const char& c : text) {
    const auto escape = kEscapes.find(c);
    result += escape == kEscapes.end() ? std::string_view(&c, 1) : escape->second;
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

std::string heading(std::string_view name, std::string_view section, std::string_view summary,
                    const ManMargins& margins) {
  return fmt::format(".TH {} {} {} \"{}\" Meniscus\n.SH NAME\n{} \\- {}\n", plain(upper_case(name)), section,
                     margins.date, plain(margins.version), plain(name), plain(summary));
}

/// Returns the term of an option, such as \fB\-o\fR, \fB\-\-output\fR \fIPATH\fR.
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

namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  return fmt::format("{}", fmt::join(words, between));
}

std::string replaced(std::string text, std::string_view what, std::string_view with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  return text;
}

/// Quotes a text in single quotes for bash and zsh.
std::string shell_quoted(const std::string& text) { return "'" + replaced(text, "'", R"('\'')") + "'"; }

/// Quotes a text in single quotes for fish.
std::string fish_quoted(const std::string& text) {
  return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

/// Returns a command's path with slashes: "meniscus/export/povray".
std::string slashed(const CommandEntry& command) { return replaced(command.path, " ", "/"); }

std::vector<OptionEntry> options_of(const CommandEntry& command) {
  std::vector<OptionEntry> all;
  for (const OptionSection& section : command.sections)
    all.insert(all.end(), section.options.begin(), section.options.end());
  return all;
}

/// Returns the patterns by which a case statement goes one command down: "meniscus/export|meniscus/export/ply".
std::vector<std::string> commands_below(const CommandEntry& program) {
  std::vector<std::string> all;
  for (const CommandEntry* command : all_commands(program))
    if (command != &program) all.push_back(slashed(*command));
  return all;
}

std::vector<std::string> command_names(const CommandEntry& command) {
  std::vector<std::string> names;
  for (const CommandEntry& below : command.commands) names.push_back(below.name);
  return names;
}

// bash

/// Returns the lines of a case statement for the values of a command's options.
std::string bash_values(const CommandEntry& command) {
  std::string lines;
  for (const OptionEntry& option : options_of(command)) {
    if (option.value.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : option.names) patterns.push_back(shell_quoted(slashed(command) + " " + name));
    const std::string action = !option.words.empty() ? "words=" + shell_quoted(joined(option.words, " "))
                               : option.takes_path() ? "paths=yes"
                                                     : "";
    if (option.value_optional && action.empty()) continue;
    lines += fmt::format("    {}) value=yes {} ;;\n", joined(patterns, " | "), action);
  }
  return lines;
}

/// Returns the candidates if no value is expected.
std::string bash_words(const CommandEntry& command) {
  std::vector<std::string> options, words = command_names(command);
  for (const OptionEntry& option : options_of(command))
    options.insert(options.end(), option.names.begin(), option.names.end());
  std::string paths;
  for (const OptionEntry& argument : command.arguments) {
    words.insert(words.end(), argument.words.begin(), argument.words.end());
    if (argument.takes_path()) paths = " paths=yes";
  }
  return fmt::format("    {}) options={} words={}{} ;;\n", shell_quoted(slashed(command)),
                     shell_quoted(joined(options, " ")), shell_quoted(joined(words, " ")), paths);
}

// zsh

/// Escapes a text within a specification of _arguments.
std::string zsh_text(const std::string& text) {
  std::string safe = replaced(text, "\\", "\\\\");
  for (const std::string_view special : {"[", "]", ":"}) safe = replaced(safe, special, "\\" + std::string(special));
  return safe;
}

std::string zsh_value(const OptionEntry& option, const std::string& name) {
  const std::string action = !option.words.empty() ? "(" + joined(option.words, " ") + ")"
                             : option.takes_path() ? "_files"
                                                   : "";
  return fmt::format(":{}:{}", zsh_text(name), action);
}

std::string zsh_options(const CommandEntry& command) {
  std::string lines;
  for (const OptionEntry& option : options_of(command))
    for (const std::string& name : option.names) {
      std::string spec = "*" + name + "[" + zsh_text(option.description) + "]";
      if (!option.value.empty()) spec += (option.value_optional ? ":" : "") + zsh_value(option, option.value);
      lines += " \\\n    " + shell_quoted(spec);
    }
  return lines;
}

std::string zsh_function_name(const CommandEntry& command) { return "_" + replaced(command.path, " ", "_"); }

std::string zsh_function(const CommandEntry& command) {
  std::string text = zsh_function_name(command) + "() {\n";
  if (command.commands.empty()) {
    text += "  _arguments -s" + zsh_options(command);
    for (const OptionEntry& argument : command.arguments)
      text += " \\\n    " + shell_quoted("*" + zsh_value(argument, argument.names.front()));
    return text + "\n}\n";
  }
  text += "  local context state line\n  typeset -A opt_args\n  local -a commands\n";
  text += "  _arguments -C" + zsh_options(command) + " \\\n    '1:command:->command' '*::argument:->argument'\n";
  text += "  case $state in\n    command)\n      commands=(\n";
  for (const CommandEntry& below : command.commands)
    text += "        " + shell_quoted(below.name + ":" + below.summary) + "\n";
  text += "      )\n      _describe -t commands command commands\n      ;;\n    argument)\n      case $line[1] in\n";
  for (const CommandEntry& below : command.commands)
    text += fmt::format("        {}) {} ;;\n", below.name, zsh_function_name(below));
  return text + "      esac\n      ;;\n  esac\n}\n";
}

// fish

std::string fish_options(const CommandEntry& command) {
  const std::string here = "complete -c meniscus -n '__meniscus_at " + slashed(command) + "'";
  std::string lines;
  for (const OptionEntry& option : options_of(command)) {
    lines += here;
    for (const std::string& name : option.names)
      lines += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.words.empty()) {
      lines += " -x -a " + fish_quoted(joined(option.words, " "));
    } else if (option.takes_path()) {
      lines += " -r -F";
    } else if (!option.value.empty() && !option.value_optional) {
      lines += " -x";
    }
    lines += " -d " + fish_quoted(option.description) + "\n";
  }
  for (const CommandEntry& below : command.commands)
    lines += fmt::format("{} -a {} -d {}\n", here, below.name, fish_quoted(below.summary));
  for (const OptionEntry& argument : command.arguments) {
    if (!argument.words.empty()) lines += here + " -a " + fish_quoted(joined(argument.words, " ")) + "\n";
    if (argument.takes_path()) lines += here + " -F\n";
  }
  return lines;
}

}  // namespace

std::string bash_completion(const CommandEntry& program) {
  std::string values, words;
  for (const CommandEntry* command : all_commands(program)) {
    values += bash_values(*command);
    words += bash_words(*command);
  }
  return fmt::format(R"(# Completion of {0} for bash; written by: {0} completion bash
_{0}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command={0} word value= words= options= paths=
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case $command/$word in
      {1}) command+=/$word ;;
    esac
  done
  case "$command $previous" in
{2}  esac
  [[ $value ]] || case $command in
{3}  esac
  if [[ $current == -* && $options ]]; then
    words=$options paths=
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  if [[ $paths && ${{#COMPREPLY[@]}} == 0 ]]; then
    compopt -o default 2>/dev/null
  fi
}}
complete -F _{0} {0}
)",
                     program.name, joined(commands_below(program), " | "), values, words);
}

std::string zsh_completion(const CommandEntry& program) {
  std::string text =
      fmt::format("#compdef {0}\n# Completion of {0} for zsh; written by: {0} completion zsh\n", program.name);
  for (const CommandEntry* command : all_commands(program)) text += "\n" + zsh_function(*command);
  // When zsh loads the script by its name, it must complete at once; when the script is sourced, it only registers.
  return text + fmt::format(R"(
if [[ $funcstack[1] == _{0} ]]; then
  _{0} "$@"
else
  compdef _{0} {0}
fi
)",
                            program.name);
}

std::string fish_completion(const CommandEntry& program) {
  std::string text = fmt::format(R"(# Completion of {0} for fish; written by: {0} completion fish
function __{0}_at
    set -l command {0}
    for word in (commandline -opc)[2..-1]
        switch $command/$word
            case {1}
                set command $command/$word
        end
    end
    test $command = $argv[1]
end
complete -c {0} -f
)",
                                 program.name, joined(commands_below(program), " "));
  for (const CommandEntry* command : all_commands(program)) text += fish_options(*command);
  return text;
}

}  // namespace meniscus
