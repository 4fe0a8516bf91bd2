// SPDX-License-Identifier: BSD-3-Clause
// Contains the table of options in the order in which abbreviations are matched: the first option that begins with the
// word is used.
#include "app/msms/arguments.h"

#include <array>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

#include "app/process/program_error.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus::msms {
namespace {

constexpr double kSmallestDensity = 0.01, kLargestDensity = 1000.0;
constexpr double kLargestProbe = 100.0;  // Å

/// Reads the words after an option, one after another.
class Words {
 public:
  explicit Words(std::span<const char* const> words) : rest_(words) {}

  bool empty() const { return rest_.empty(); }
  std::string_view next() {
    const std::string_view word = trimmed(rest_.front());
    rest_ = rest_.subspan(1);
    return word;
  }
  std::string_view value_of(std::string_view option, std::string_view what) {
    if (empty()) throw UsageError(fmt::format("-{}: a value is missing; give {}", option, what));
    return next();
  }
  double number_of(std::string_view option, double least, double most) {
    const std::string what = fmt::format("a number from {} to {}", least, most);
    const std::string_view word = value_of(option, what);
    double number = 0.0;
    if (!parse_number(word, number) || !(number >= least && number <= most))
      throw UsageError(fmt::format("-{} {}: give {}", option, in_quotes(word), what));
    return number;
  }
  std::int64_t whole_number_of(std::string_view option, std::int64_t least, std::int64_t most) {
    const std::string what = fmt::format("a whole number from {} to {}", least, most);
    const std::string_view word = value_of(option, what);
    std::int64_t number = 0;
    if (!parse_whole_number(word, number) || number < least || number > most)
      throw UsageError(fmt::format("-{} {}: give {}", option, in_quotes(word), what));
    return number;
  }

 private:
  std::span<const char* const> rest_;
};

struct Option {
  std::string_view name;
  void (*take)(Arguments&, std::string_view name, Words&);
};

void ignore(Arguments&, std::string_view, Words&) {}

[[noreturn]] void refuse(Arguments&, std::string_view name, Words&) {
  throw UsageError(fmt::format("-{} is not supported; a server is started by -socketPort NUMBER", name));
}

void take_cavity(Arguments& arguments, std::string_view name, Words& words) {
  const auto count = words.whole_number_of(name, 1, 3);
  arguments.cavity_atoms.clear();
  for (std::int64_t n = 0; n < count; ++n)
    arguments.cavity_atoms.push_back(static_cast<std::uint32_t>(words.whole_number_of(name, 0, UINT32_MAX)));
}

void take_surface(Arguments& arguments, std::string_view name, Words& words) {
  const std::string_view kind = words.value_of(name, "tses or ases");
  if (kind != "tses" && kind != "ases")
    throw UsageError(fmt::format("-{} {}: give tses or ases", name, in_quotes(kind)));
  arguments.mesh = kind == "tses";
}

void take_file(std::string& file, std::string_view name, Words& words) {
  file = words.value_of(name, "the name of a file");
  if (file.empty()) throw UsageError(fmt::format("-{}: the name is empty", name));
}

constexpr std::array kOptions{
    Option{"probe_radius", [](Arguments& a, std::string_view name,
                              Words& w) { a.probe_radius = w.number_of(name, 0.0, kLargestProbe); }},
    Option{"density", [](Arguments& a, std::string_view name,
                         Words& w) { a.density = w.number_of(name, kSmallestDensity, kLargestDensity); }},
    Option{"hdensity", [](Arguments& a, std::string_view name,
                          Words& w) { a.hdensity = w.number_of(name, kSmallestDensity, kLargestDensity); }},
    Option{"surface", take_surface},
    Option{"no_area", [](Arguments& a, std::string_view, Words&) { a.area = false; }},
    Option{"socketName", refuse},
    Option{"socketPort", [](Arguments& a, std::string_view name,
                            Words& w) { a.port = static_cast<std::uint16_t>(w.whole_number_of(name, 1, UINT16_MAX)); }},
    Option{"xdr", refuse},
    Option{"sinetd", refuse},
    Option{"noh", [](Arguments& a, std::string_view, Words&) { a.hydrogens = false; }},
    Option{"no_rest_on_pbr", ignore},
    Option{"no_rest", ignore},
    Option{"if", [](Arguments& a, std::string_view name, Words& w) { take_file(a.spheres, name, w); }},
    Option{"of", [](Arguments& a, std::string_view name, Words& w) { take_file(a.mesh_files, name, w); }},
    Option{"af", [](Arguments& a, std::string_view name, Words& w) { take_file(a.area_file, name, w); }},
    Option{"no_header", [](Arguments& a, std::string_view, Words&) { a.header = false; }},
    Option{"free_vertices", ignore},
    Option{"all_components", [](Arguments& a, std::string_view, Words&) { a.all_components = true; }},
    Option{"one_cavity", take_cavity},
};

const Option& option_of(std::string_view word) {
  const std::string_view name = word.substr(1);
  for (const Option& option : kOptions)
    if (!name.empty() && option.name.starts_with(name)) return option;
  std::vector<std::string_view> names;
  names.reserve(kOptions.size());
  for (const Option& option : kOptions) names.push_back(option.name);
  const std::string_view nearest = nearest_word(name, names);
  throw UsageError(fmt::format("{} is not an option{}; -h lists all", in_quotes(word),
                               nearest.empty() ? "" : fmt::format(" (did you mean -{}?)", nearest)));
}

}  // namespace

bool is_probe_radius(double radius) { return radius >= 0.0 && radius <= kLargestProbe; }
bool is_density(double density) { return density >= kSmallestDensity && density <= kLargestDensity; }

Arguments parse_arguments(std::span<const char* const> given) {
  Arguments arguments;
  Words words(given);
  while (!words.empty()) {
    const std::string_view word = words.next();
    if (word.empty()) continue;
    if (word == "-h" || word == "-help" || word == "--help") {
      arguments.help = true;
      return arguments;
    }
    if (word.front() != '-') throw UsageError(fmt::format("{} belongs to no option; -h lists all", in_quotes(word)));
    const Option& option = option_of(word);
    option.take(arguments, option.name, words);
  }
  if (arguments.all_components && !arguments.cavity_atoms.empty())
    throw UsageError("-all_components and -one_cavity ask for different things; leave one of them out");
  return arguments;
}

std::string help_text() {
  return R"(meniscus-msms: solvent-excluded surfaces, exact, by the command line and in the files of MSMS

  meniscus-msms -if balls.xyzr -of surface -af areas -probe_radius 1.4 -density 3

  -if FILE             spheres: x y z radius, or x y z radius 1 name, one a line; -: standard input
  -of PREFIX           write PREFIX.vert and PREFIX.face
  -af PREFIX           write PREFIX.area: areas of each sphere
  -probe_radius R      radius of the probe, Angstrom (1.5)
  -density D           vertices per square Angstrom (1.0)
  -surface tses|ases   triangles and areas, or areas alone (tses)
  -no_area             no table of analytic areas
  -no_header           no lines above the rows of .vert and .face
  -all_components      all components of the reduced surface: number 0 in PREFIX.vert, number k in PREFIX_k.vert
  -one_cavity N A...   only the component that touches these 1 to 3 spheres, numbered from 0 as in .area
  -noh                 leave out spheres of radius 1.2, which are hydrogens; the others keep their numbers
  -socketPort PORT     serve one surface on 127.0.0.1, as VMD asks for it
  -h                   this help

An option may be cut short: -prob, -d, -all. -hdensity D, -no_rest, -no_rest_on_pbr and -free_vertices are read and
change nothing; -socketName, -xdr and -sinetd are refused.
Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 bad input, 5 too large, 6 output not written, 7 not closed.
On any but 0 no file is written. What differs from MSMS: docs/reference/msms-contract.md.
)";
}

}  // namespace meniscus::msms
