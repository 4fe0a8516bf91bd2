// SPDX-License-Identifier: BSD-3-Clause
// Reads the options of MSMS by their abbreviations, and computes the component that they select.
#include "app/msms/arguments.h"

#include <numeric>

#include <fmt/ranges.h>

#include "app/process/program_main.h"
#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/mesh/tessellate.h"
#include "core/surface/compute_surface.h"

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
    if (empty()) throw UsageError("-{}: a value is missing; give {}", option, what);
    return next();
  }
  double number_of(std::string_view option, double least, double most) {
    const std::string what = fmt::format("a number from {} to {}", least, most);
    const std::string_view word = value_of(option, what);
    double number = 0.0;
    if (!parse_number(word, number) || !(number >= least && number <= most))
      throw UsageError("-{} {}: give {}", option, in_quotes(word), what);
    return number;
  }
  std::int64_t whole_number_of(std::string_view option, std::int64_t least, std::int64_t most) {
    const std::string what = fmt::format("a whole number from {} to {}", least, most);
    const std::string_view word = value_of(option, what);
    std::int64_t number = 0;
    if (!parse_whole_number(word, number) || number < least || number > most)
      throw UsageError("-{} {}: give {}", option, in_quotes(word), what);
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
  throw UsageError("-{} is not supported; a server is started by -socketPort NUMBER", name);
}

void take_cavity(Arguments& arguments, std::string_view name, Words& words) {
  const auto count = words.whole_number_of(name, 1, 3);
  arguments.cavity_atoms.clear();
  for (std::int64_t n = 0; n < count; ++n)
    arguments.cavity_atoms.push_back(static_cast<std::uint32_t>(words.whole_number_of(name, 0, UINT32_MAX)));
}

void take_surface(Arguments& arguments, std::string_view name, Words& words) {
  const std::string_view kind = words.value_of(name, "tses or ases");
  if (kind != "tses" && kind != "ases") throw UsageError("-{} {}: give tses or ases", name, in_quotes(kind));
  arguments.mesh = kind == "tses";
}

void take_file(std::string& file, std::string_view name, Words& words) {
  file = words.value_of(name, "the name of a file");
  if (file.empty()) throw UsageError("-{}: the name is empty", name);
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
  throw UsageError("{} is not an option{}; -h lists all", in_quotes(word),
                   nearest.empty() ? "" : fmt::format(" (did you mean -{}?)", nearest));
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
    if (word.front() != '-') throw UsageError("{} belongs to no option; -h lists all", in_quotes(word));
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

namespace {

constexpr std::size_t kMostAreas = std::size_t{1} << 26;  // a gigabyte, and as much text
constexpr int kAttempts = 16;
constexpr double kShorter = 0.9;

/// Returns the atoms that a face touches.
std::vector<std::uint32_t> touched_atoms(const Surface& surface, const Face& face) {
  if (face.kind == PatchKind::convex) return {surface.convex[face.patch].atom};
  if (face.kind == PatchKind::toroidal) {
    const auto& atoms = surface.toroidal[face.patch].atom;
    return {atoms.begin(), atoms.end()};
  }
  const ConcavePatch& patch = surface.concave[face.patch];
  const auto contacts = std::span(surface.contacts).subspan(patch.first_contact, patch.contact_count);
  return {contacts.begin(), contacts.end()};
}

}  // namespace

ChosenSurface::ChosenSurface(const Arguments& arguments, const Spheres& spheres) : density_(arguments.density) {
  const auto engine = make_cpu_engine();
  StageClock unused;
  computed_ = compute_component_surface(*engine, spheres.balls, arguments.probe_radius, unused);
  require_closed(computed_.surface);
  if (!arguments.cavity_atoms.empty()) {
    chosen_ = {component_touching(arguments.cavity_atoms, spheres)};
  } else {
    chosen_.resize(arguments.all_components ? computed_.components.count : 1);
    std::iota(chosen_.begin(), chosen_.end(), 0u);
  }
}

// Prefers a cavity, because an atom of its wall may touch the outside as well.
std::uint32_t ChosenSurface::component_touching(const std::vector<std::uint32_t>& numbers,
                                                const Spheres& spheres) const {
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t a = 0; a < spheres.rows.of_atom.size(); ++a)
    if (std::ranges::find(numbers, spheres.rows.of_atom[a]) != numbers.end()) wanted.push_back(a);
  const std::vector<ReducedComponentSize> all = sizes_of(computed_.surface, computed_.components);
  std::optional<std::uint32_t> outer, cavity;
  for (std::size_t f = 0; f < computed_.surface.faces.size(); ++f) {
    const std::vector<std::uint32_t> touched = touched_atoms(computed_.surface, computed_.surface.faces[f]);
    const bool has_all = std::ranges::all_of(
        wanted, [&](std::uint32_t atom) { return std::ranges::find(touched, atom) != touched.end(); });
    if (!has_all) continue;
    const std::uint32_t component = computed_.components.of_face[f];
    std::optional<std::uint32_t>& best = all[component].volume < 0 ? cavity : outer;
    best = std::min(best.value_or(component), component);
  }
  const bool known = wanted.size() == numbers.size();
  if (!known || (!cavity && !outer))
    throw InputError(spheres.rows.file, 0,
                     "find_first_rs_face: no position of the probe touches the spheres {} of -one_cavity; they "
                     "are numbered from 0 to {}",
                     fmt::join(numbers, ", "), spheres.rows.count - 1);
  return cavity ? *cavity : *outer;
}

std::vector<ReducedComponentSize> ChosenSurface::sizes() const {
  const std::vector<ReducedComponentSize> all = sizes_of(computed_.surface, computed_.components);
  std::vector<ReducedComponentSize> chosen;
  for (const std::uint32_t component : chosen_) chosen.push_back(all[component]);
  return chosen;
}

std::vector<AtomAreas> ChosenSurface::areas() const {
  if (chosen_.size() * computed_.surface.atoms.size() > kMostAreas)
    throw CapacityError(
        "the areas of {} spheres in {} components are too many for one table; leave -af or -all_components out",
        computed_.surface.atoms.size(), chosen_.size());
  // All other components form one group, after the selected ones.
  const auto others = static_cast<std::uint32_t>(chosen_.size());
  std::vector<std::uint32_t> group(computed_.components.count, others);
  for (std::uint32_t n = 0; n < chosen_.size(); ++n) group[chosen_[n]] = n;
  std::vector<std::uint32_t> group_of_face;
  for (const std::uint32_t component : computed_.components.of_face) group_of_face.push_back(group[component]);
  std::vector<AtomAreas> areas = atom_areas(computed_.surface, group_of_face, others + 1);
  areas.pop_back();
  return areas;
}

// Long edges may cut a face's rim short, or cross it; slightly shorter ones do not.
void ChosenSurface::triangulate() {
  MeshOptions options;
  options.split_colors = false;
  options.edge = msms_edge(density_);
  for (int attempt = 1;; ++attempt, options.edge *= kShorter) {
    try {
      mesh_ = tessellate(computed_.surface, options);
      numbered_.emplace(computed_.surface, mesh_, computed_.components);
      return;
    } catch (const OpenSurfaceError&) {
      if (attempt == kAttempts) throw;
    }
  }
}

MsmsMesh ChosenSurface::mesh(std::size_t n) { return numbered_->of(chosen_[n]); }

}  // namespace meniscus::msms
