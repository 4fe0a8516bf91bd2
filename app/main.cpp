// SPDX-License-Identifier: BSD-3-Clause
// The program `meniscus`: reads the command line, and runs the command.
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <sstream>
#include <system_error>

#include <CLI/Version.hpp>
#include <fmt/ranges.h>
#include <glm/detail/setup.hpp>
#include <libdeflate.h>
#include <nlohmann/detail/abi_macros.hpp>
#include <tbb/version.h>
#include <zlib.h>

#include "app/commands/command_table.h"
#include "app/options/command_tree.h"
#include "app/options/named_files.h"
#include "app/process/program_main.h"
#include "app/process/system_process.h"
#include "core/base/binary_file.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/gpu/egl_context.h"
#include "core/image/image_codec.h"
#include "core/properties/properties.h"

namespace meniscus {
namespace {

#if defined(__clang__)
constexpr const char* kCompiler = __VERSION__;
#else
constexpr const char* kCompiler = "GCC " __VERSION__;
#endif

std::string row(std::string_view what, std::string_view answer) { return fmt::format("\n{:<12}{}", what, answer); }

/// Returns the result of `ask`, or the reason why there is none.
template <class Ask>
std::string answer_of(Ask ask) {
  try {
    return ask();
  } catch (const std::exception& error) {
    return fmt::format("none: {}", error.what());
  }
}

std::string libraries_line() {
  return fmt::format(
      "oneTBB {}, fmt {}.{}.{}, zlib {}, libdeflate {}, GLM {}.{}.{}, CLI11 {}, JSON for Modern C++ "
      "{}.{}.{}",
      TBB_runtime_version(), FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, ::zlibVersion(),
      LIBDEFLATE_VERSION_STRING, GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH, CLI11_VERSION,
      NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
}

std::string gl_line() {
  DeviceChoice choice;
  if (const char* visible = std::getenv("CUDA_VISIBLE_DEVICES")) choice.cuda_visible = visible;
  const EglContext context(choice);
  return fmt::format("{}, {}; {}", context.version(), context.renderer(), context.vendor());
}

/// Returns a line such as "meniscus 0.1.0+g2b6bb4a4c1d2".
std::string version_line() { return std::string("meniscus ") + build_version(); }

/// Returns version_line(), and lines about compiler, system, loaded libraries and the GL driver that `auto` would
/// choose. A line says if something cannot be found. Reads CUDA_VISIBLE_DEVICES like --device.
std::string version_report() {
  return version_line() + row("sources", build_date()) +
         row("compiler", fmt::format("{}, {}", kCompiler, MENISCUS_BUILD_TYPE)) +
         row("system", system_process::system_name()) + row("libraries", libraries_line()) +
         row("pictures", answer_of([] { return image_codec().library(); })) + row("GL", answer_of(gl_line));
}

/// Returns the citation: the program as BibTeX, and the paper of its method, as in CITATION.cff.
std::string citation() {
  return fmt::format(R"(@software{{meniscus,
  title   = {{Meniscus: exact solvent-excluded surfaces of molecules}},
  author  = {{{{The Meniscus authors}}}},
  version = {{{}}},
  year    = {{2026}},
  license = {{BSD-3-Clause}}
}}

@inproceedings{{krone2010,
  title     = {{Parallel computation and interactive visualization of time-varying solvent excluded surfaces}},
  author    = {{Krone, Michael and Dachsbacher, Carsten and Ertl, Thomas}},
  booktitle = {{Proceedings of the First ACM International Conference on Bioinformatics and Computational Biology}},
  year      = {{2010}}
}})",
                     MENISCUS_VERSION);
}

constexpr const char* kExamples = R"(  meniscus info 1tii.pdb                          what the file contains
  meniscus surface 1tii.pdb                       area, volume, cavities; --json, --csv for programs
  meniscus pockets 1tii.pdb                       pockets, tunnels, cavities
  meniscus render 1tii.pdb -o 1tii.png            a picture
  meniscus preview 1tii.pdb --serve               a preview in the browser
  meniscus export povray 1tii.pdb -o 1tii         a POV-Ray scene; blender, mitsuba, pbrt likewise
  meniscus surface 1tii.pdb --select 'chain A'    only some atoms; meniscus help selections
  meniscus COMMAND --help                         everything about one command)";

constexpr const char* kExitCodesInShort = R"(Exit codes:
  0 done  1 internal error  2 wrong usage  3 bad input  4 no usable GPU  5 too large
  6 output not written  7 surface not closed  8 trajectory cut short  9 stopped, run it again
)";

constexpr std::size_t kHelpWidth = 100;

/// A heading of the help, and the broader heading that contains it in the short help.
struct Heading {
  std::string_view full, broad;
};

/// The headings, with the most important ones first.
constexpr Heading kHeadings[] = {{"Output", "Output"},
                                 {"Picture", "Output"},
                                 {"Mesh", "Output"},
                                 {"Figure", "Figure"},
                                 {"Shapes", "Figure"},
                                 {"Colour", "Colour and light"},
                                 {"Light", "Colour and light"},
                                 {"Lines", "Colour and light"},
                                 {"Camera", "Camera"},
                                 {"Legend", "Legend and labels"},
                                 {"Labels", "Legend and labels"},
                                 {"Session", "Session"},
                                 {"Scene", "Scene"},
                                 {"Input", "Input"},
                                 {"Surface", "Surface"},
                                 {"Computing", "Surface"},
                                 {"Radii", "Input"},
                                 {"Assembly", "Input"},
                                 {"Frames", "Frames"},
                                 {"Alignment of frames", "Frames"},
                                 {"Film", "Frames"},
                                 {"Options", "Options"}};

/// The number of options above which a command's short help shows only the common ones, one per line.
constexpr std::size_t kFullHelp = 30;

/// Formats help in the order people read: summary, examples, usage, options.
class ManualFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
    short_ = mode == CLI::AppFormatMode::Normal && app->get_options().size() > kFullHelp;
    std::string help = make_description(app);
    if (!app->get_footer().empty()) help += "\nExamples:\n" + app->get_footer() + "\n";
    help += "\n" + make_usage(app, std::move(name)) + make_positionals(app) + ordered_groups(app) +
            make_subcommands(app, CLI::AppFormatMode::Normal);
    if (short_)
      help += fmt::format(
          "\n{}These are the options that most people need. {} --help-all shows all {},\n"
          "and more about each. meniscus help lists pages about subjects.\n",
          help.find(" EXPR ") == help.npos ? "" : "EXPR selects atoms: see meniscus help selections.\n",
          command_path(*app), app->get_options().size());
    return help + (app->get_parent() ? "" : std::string("\n") + kExitCodesInShort);
  }

  std::string ordered_groups(const CLI::App* app) const {
    std::vector<std::string> headings;
    for (const std::string& group : app->get_groups())
      if (const std::string heading = heading_of(group); !heading.empty() && !std::ranges::count(headings, heading))
        headings.push_back(heading);
    std::ranges::stable_sort(headings, {}, [&](const std::string& heading) { return place_of(heading); });
    std::string text;
    for (const std::string& heading : headings) {
      std::vector<const CLI::Option*> options = app->get_options([&](const CLI::Option* option) {
        return heading_of(option->get_group()) == heading && option->nonpositional() && (!short_ || is_common(*option));
      });
      std::ranges::stable_sort(options, {}, [](const CLI::Option* option) {
        return std::ranges::find(kHeadings, option->get_group(), &Heading::full) - std::begin(kHeadings);
      });
      if (!options.empty()) text += make_group(heading, false, options);
    }
    return text;
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string& words = option->get_description();
    return wrapped(short_ && option->nonpositional() ? first_sentence(words) : words, kHelpWidth - column_width_);
  }

  /// Pads a line by its letters, because CLI11 counts bytes, and a unit such as Å has fewer letters than bytes.
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    std::string text = CLI::Formatter::make_option(option, is_positional);
    const std::string name = "  " + make_option_name(option, is_positional) + make_option_opts(option);
    const auto further_bytes =
        std::ranges::count_if(name, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; });
    if (name.size() < column_width_) text.insert(name.size(), static_cast<std::size_t>(further_bytes), ' ');
    return text;
  }

  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream line;
    CLI::detail::format_help(line, command->get_name(), wrapped(command->get_description(), kHelpWidth - column_width_),
                             column_width_);
    return line.str();
  }

  /// Returns only the word for the value: conflicts and requirements of options are reported when they matter.
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string& type = option->get_type_name();
    return (type.empty() ? "" : " " + type) + (option->get_required() ? " (required)" : "");
  }

 private:
  mutable bool short_ = false;  ///< the current form; CLI11 requests each part separately

  /// Returns the heading of a group of options; empty if it is hidden.
  std::string heading_of(const std::string& group) const {
    const auto known = std::ranges::find(kHeadings, group, &Heading::full);
    return short_ && known != std::end(kHeadings) ? std::string(known->broad) : group;
  }

  std::ptrdiff_t place_of(const std::string& heading) const {
    return std::ranges::find(kHeadings, heading, short_ ? &Heading::broad : &Heading::full) - std::begin(kHeadings);
  }

  static bool is_common(const CLI::Option& option) {
    const std::string name = option.get_name();
    return name == "--help" || name == "--help-all" || std::ranges::any_of(properties(), [&](const Property* property) {
             return property->has(in_short_help) && property->long_option() == name;
           });
  }
};

bool is_command(std::string_view word) {
  return std::ranges::any_of(commands(), [&](const Command& command) { return word == command.name; });
}

[[noreturn]] void refuse_unknown_command(std::string_view word) {
  std::vector<std::string_view> names;
  for (const Command& command : commands()) names.emplace_back(command.name);
  const std::string_view nearest = nearest_word(word, names);
  if (const std::string advice = advice_on_pdb_code(word); !advice.empty())
    throw UsageError("{} is not a command{}", in_quotes(word), advice);
  throw UsageError("{} is not a command{} and not a file; the commands are {}; see meniscus --help", in_quotes(word),
                   nearest.empty() ? "" : fmt::format(" (did you mean {}?)", nearest), fmt::join(names, ", "));
}

/// Returns the words as typed, with shortcuts expanded: `meniscus my.pdb` means `meniscus render my.pdb`, also with -
/// for standard input, and `meniscus my.json` means `meniscus render --scene my.json`.
std::vector<const char*> words_of(std::span<const char* const> typed) {
  std::vector<const char*> words(typed.begin(), typed.end());
  const std::string_view first = words.size() < 2 ? "" : words[1];
  const bool standard_input = first == "-";
  if (!standard_input && (first.empty() || first[0] == '-' || is_command(first))) return words;
  std::error_code unreadable;
  if (!standard_input && !std::filesystem::is_regular_file(first, unreadable)) refuse_unknown_command(first);
  if (std::filesystem::path(first).extension() == ".json") words.insert(words.begin() + 1, "--scene");
  words.insert(words.begin() + 1, "render");
  return words;
}

/// Returns true if the words request help or completion of options.
bool shows_options(std::span<const char* const> words) {
  constexpr std::array<std::string_view, 3> kAsking{"help", "completion", "--help-all"};
  return words.size() > 1 && std::ranges::find(kAsking, std::string_view(words[1])) != kAsking.end();
}

void run(std::span<const char* const> typed) {
  const std::vector<const char*> words = words_of(typed);
  remember_command_line(words);
  CLI::App program("Meniscus computes the exact, complete solvent-excluded surface of a molecule.", "meniscus");
  program.allow_windows_style_options(false);  // "/data/a.pdb" is a file on Windows, too
  program.formatter(std::make_shared<ManualFormatter>());
  program.get_formatter()->column_width(30);
  program.get_formatter()->label("REQUIRED", "(required)");
  program.get_formatter()->label("Positionals", "Arguments");
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  bool verbose = false;
  program.add_flag("--verbose", verbose, "With --version: also compiler, libraries and GL driver, for bug reports");
  program.set_version_flag(
      "--version", [&verbose] { return verbose ? version_report() : version_line(); }, "Show version and commit");
  program.add_flag_callback(
      "--cite", [] { throw CLI::CallForVersion(citation(), 0); }, "Show what to cite, as BibTeX");
  program.set_help_flag("-h,--help", "Show this help");
  program.set_help_all_flag("--help-all", "Show all options, and more about each");
  program.require_subcommand(1);
  let_the_last_count(program);
  program.footer(kExamples);
  add_commands(program, "Commands", commands(), shows_options(words) ? Declared::at_once : Declared::when_reached);
  // At this point all options are known, and no command has begun.
  program.parse_complete_callback([&program] { NamedFiles(named_command(program)).check(); });
  std::vector<std::string> arguments(words.rbegin(), words.rend() - 1);
  try {
    program.parse(arguments);
  } catch (const CLI::Success& success) {
    program.exit(success);
  } catch (const CLI::ParseError& error) {
    const std::string fault =
        dynamic_cast<const CLI::ExtrasError*>(&error) ? unknown_option_fault(program, words) : error.what();
    throw UsageError("{}; see {} --help", fault, command_path(named_command(program)));
  }
  finish_standard_output();
}

}  // namespace

}  // namespace meniscus

int main(int argc, char** argv) {
  using namespace meniscus;
  return program_main("meniscus", [=] {
    run(system_process::words(argc, argv));
    return kExitOk;
  });
}
