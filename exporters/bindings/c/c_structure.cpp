// SPDX-License-Identifier: BSD-3-Clause
// Molecules from files, read with the options of a caller: their atoms as tables without a copy. Builds without gemmi,
// which all readers need, refuse to read.

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/element_tables.h"
#include "exporters/bindings/c/c_calls.h"
#include "exporters/bindings/c/c_structure.h"

#ifdef MENISCUS_WITH_GEMMI
#include "core/structure/formats/read_structure.h"
#include "core/structure/selection/selection.h"
#endif

namespace meniscus::c_api {
namespace {

/// A table of texts, which are padded with zeros to the same length, with at least one zero.
class TextColumn {
 public:
  /// text: a function that returns the text of row n.
  template <typename Text>
  TextColumn(std::size_t count, const Text& text) : count_(count) {
    for (std::size_t n = 0; n < count; ++n) stride_ = std::max(stride_, text(n).size() + 1);
    bytes_.resize(count * stride_);
    for (std::size_t n = 0; n < count; ++n) std::ranges::copy(text(n), bytes_.begin() + n * stride_);
  }
  meniscus_array array() const { return {bytes_.data(), count_, stride_}; }

 private:
  std::size_t count_, stride_ = 1;
  std::vector<char> bytes_;
};

/// Returns a view of a field of the atoms.
template <typename Field>
meniscus_array column(const std::vector<Atom>& atoms, Field Atom::*field) {
  return {&(atoms.front().*field), atoms.size(), sizeof(Atom)};
}

TextColumn text_column(const std::vector<Atom>& atoms, std::string Atom::*field) {
  return {atoms.size(), [&](std::size_t n) -> const std::string& { return atoms[n].*field; }};
}

}  // namespace
}  // namespace meniscus::c_api

/// The object behind the handle of a molecule.
struct meniscus_structure : meniscus::c_api::Counted {
  explicit meniscus_structure(meniscus::Structure from)
      : structure(std::move(from)),
        sentence(structure.report.sentence()),
        names(meniscus::c_api::text_column(structure.atoms, &meniscus::Atom::name)),
        residue_names(meniscus::c_api::text_column(structure.atoms, &meniscus::Atom::residue_name)),
        chains(meniscus::c_api::text_column(structure.atoms, &meniscus::Atom::chain)),
        segments(meniscus::c_api::text_column(structure.atoms, &meniscus::Atom::segment)),
        warnings(structure.report.warnings.size(),
                 [&](std::size_t n) -> const std::string& { return structure.report.warnings[n].text; }) {
    for (const meniscus::Atom& atom : structure.atoms) hydropathies.push_back(meniscus::hydropathy(atom.residue_name));
  }

  const meniscus::Structure structure;
  const std::string sentence;
  const meniscus::c_api::TextColumn names, residue_names, chains, segments, warnings;
  std::vector<double> hydropathies;
};

namespace meniscus::c_api {
namespace {

meniscus_array find_column(const meniscus_structure& of, std::int32_t table) {
  const std::vector<Atom>& atoms = of.structure.atoms;
  switch (table) {
    case MENISCUS_STRUCTURE_POSITIONS:
      return column(atoms, &Atom::position);
    case MENISCUS_STRUCTURE_RADII:
      return column(atoms, &Atom::radius);
    case MENISCUS_STRUCTURE_ELEMENTS:
      return column(atoms, &Atom::element);
    case MENISCUS_STRUCTURE_INDICES:
      return column(atoms, &Atom::index);
    case MENISCUS_STRUCTURE_NAMES:
      return of.names.array();
    case MENISCUS_STRUCTURE_RESIDUE_NAMES:
      return of.residue_names.array();
    case MENISCUS_STRUCTURE_CHAINS:
      return of.chains.array();
    case MENISCUS_STRUCTURE_SEGMENTS:
      return of.segments.array();
    case MENISCUS_STRUCTURE_RESIDUE_NUMBERS:
      return column(atoms, &Atom::residue_number);
    case MENISCUS_STRUCTURE_INSERTION_CODES:
      return column(atoms, &Atom::insertion_code);
    case MENISCUS_STRUCTURE_ALTLOCS:
      return column(atoms, &Atom::altloc);
    case MENISCUS_STRUCTURE_RESIDUES:
      return column(atoms, &Atom::residue);
    case MENISCUS_STRUCTURE_MODELS:
      return column(atoms, &Atom::model);
    case MENISCUS_STRUCTURE_COPIES:
      return column(atoms, &Atom::copy);
    case MENISCUS_STRUCTURE_CHARGES:
      return column(atoms, &Atom::charge);
    case MENISCUS_STRUCTURE_B_FACTORS:
      return column(atoms, &Atom::b_factor);
    case MENISCUS_STRUCTURE_OCCUPANCIES:
      return column(atoms, &Atom::occupancy);
    case MENISCUS_STRUCTURE_CLASSES:
      return column(atoms, &Atom::kind);
    case MENISCUS_STRUCTURE_WARNINGS:
      return of.warnings.array();
    case MENISCUS_STRUCTURE_HYDROPATHIES:
      return {of.hydropathies.data(), of.hydropathies.size(), sizeof(double)};
    default:
      refuse(MENISCUS_USAGE, "a structure has no table {}", table);
  }
}

meniscus_atoms atoms_of(const std::vector<Atom>& atoms) {
  meniscus_atoms result{};
  result.count = atoms.size();
  result.positions = &atoms.front().position;
  result.radii = &atoms.front().radius;
  result.positions_stride = result.radii_stride = sizeof(Atom);
  return result;
}

meniscus_read_report report_of(const meniscus_structure& of) {
  const Structure& structure = of.structure;
  return {sizeof(meniscus_read_report), structure.file.c_str(), structure.format.c_str(), structure.radii_set.c_str(),
          of.sentence.c_str(),          structure.report.read,  structure.atoms.size(),   structure.report.models};
}

/// The defaults of meniscus_read_options, in the order of its members: size, select, assembly, altloc, radii,
/// radii_files, radius, radii_file_count, radius_count, model, hydrogens, unknown_element, keep_water, keep_ions,
/// reserved.
const meniscus_read_options kReadDefaults{sizeof(meniscus_read_options),
                                          nullptr,
                                          nullptr,
                                          "best",
                                          nullptr,
                                          nullptr,
                                          nullptr,
                                          0,
                                          0,
                                          1,
                                          MENISCUS_HYDROGENS_AUTO,
                                          MENISCUS_UNKNOWN_HALT,
                                          0,
                                          0,
                                          0};

#ifdef MENISCUS_WITH_GEMMI

constexpr std::size_t kMostTexts = 10'000;

/// Returns the result of a function that parses a selection. Refuses an invalid selection; the message shows its place.
template <typename Understand>
auto understood(const char* option, const Understand& understand) {
  try {
    return understand();
  } catch (const SelectionError& error) {
    refuse(MENISCUS_USAGE, "{}: {}\n{}", option, error.sentence(), error.picture());
  }
}

/// Returns a copy of a caller's list of texts. Refuses NULL texts.
std::vector<std::string> texts_of(const char* const* texts, std::size_t count, const char* name) {
  if (count > kMostTexts)
    refuse(MENISCUS_CAPACITY, "{}: {} are more than the {} that are read", name, count, kMostTexts);
  require_rows(texts, {count, 1, sizeof(const char*)}, name);
  std::vector<std::string> result;
  for (std::size_t n = 0; n < count; ++n) {
    if (!texts[n]) refuse(MENISCUS_USAGE, "{}[{}] is NULL", name, n);
    result.emplace_back(texts[n]);
  }
  return result;
}

AltlocChoice altloc_of(const char* text) {
  const std::optional<AltlocChoice> choice = parse_altloc_choice(text ? text : kReadDefaults.altloc);
  if (!choice) refuse(MENISCUS_USAGE, "altloc is {}; it must be best, first, all or one letter", in_quotes(text));
  return *choice;
}

Hydrogens hydrogens_of(std::int32_t word) {
  switch (word) {
    case MENISCUS_HYDROGENS_AUTO:
      return Hydrogens::automatic;
    case MENISCUS_HYDROGENS_KEEP:
      return Hydrogens::keep;
    case MENISCUS_HYDROGENS_DROP:
      return Hydrogens::drop;
    default:
      refuse(MENISCUS_USAGE, "hydrogens is {}, none of MENISCUS_HYDROGENS_AUTO, _KEEP, _DROP", word);
  }
}

UnknownElement unknown_element_of(std::int32_t word) {
  switch (word) {
    case MENISCUS_UNKNOWN_HALT:
      return UnknownElement::halt;
    case MENISCUS_UNKNOWN_GUESS:
      return UnknownElement::guess;
    case MENISCUS_UNKNOWN_SKIP:
      return UnknownElement::skip;
    default:
      refuse(MENISCUS_USAGE, "unknown_element is {}, none of MENISCUS_UNKNOWN_HALT, _GUESS, _SKIP", word);
  }
}

ReadOptions reading_of(const meniscus_read_options& given) {
  require_zero(given.reserved, "meniscus_read_options.reserved");
  if (given.model < 0) refuse(MENISCUS_USAGE, "model is {}; it must be a number from 1, or 0 for all", given.model);
  ReadOptions reading;
  reading.model = {given.model == 0 ? 1 : given.model, given.model == 0};
  reading.altloc = altloc_of(given.altloc);
  reading.hydrogens = hydrogens_of(given.hydrogens);
  reading.unknown_element = unknown_element_of(given.unknown_element);
  reading.keep_water = given.keep_water != 0;
  reading.keep_ions = given.keep_ions != 0;
  if (given.assembly) reading.assembly = given.assembly;
  if (given.select) reading.selection = understood("select", [&] { return parse_selection(given.select); });
  if (given.radii) reading.radii.set = given.radii;
  reading.radii.files = texts_of(given.radii_files, given.radii_file_count, "radii_files");
  for (const std::string& text : texts_of(given.radius, given.radius_count, "radius"))
    reading.radii.overrides.push_back(understood("radius", [&] { return parse_radius_override(text); }));
  return reading;
}

/// Reads a molecule with the options of a caller, or the defaults for NULL. `path` must not be NULL. Refuses impossible
/// options; throws the exceptions of read_structure(). Builds without gemmi refuse every call.
Structure read_file(const char* path, const meniscus_read_options* options) {
  const ReadOptions reading = reading_of(read_options(options, kReadDefaults, "meniscus_read_options"));
  // The library does not read the standard input, which "-" means in the program.
  return read_structure(std::string_view(path) == "-" ? "./-" : path, reading);
}

#else

Structure read_file(const char* path, const meniscus_read_options*) {
  refuse(MENISCUS_USAGE, "{}: this build reads no molecule files: it was made without gemmi; give positions and radii",
         path);
}

#endif

}  // namespace

const Structure& structure_of(const meniscus_structure* structure) {
  require(structure, "structure");
  return structure->structure;
}

}  // namespace meniscus::c_api

meniscus_status meniscus_default_read_options(meniscus_read_options* options) {
  using namespace meniscus::c_api;
  return guarded([&] { write_struct(options, kReadDefaults, "meniscus_read_options"); });
}

meniscus_status meniscus_read(const char* path, const meniscus_read_options* options, meniscus_structure** structure) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(path, "path");
    require(structure, "structure");
    *structure = new meniscus_structure(read_file(path, options));
  });
}

meniscus_structure* meniscus_structure_retain(meniscus_structure* structure) {
  return meniscus::c_api::retain(structure);
}
void meniscus_structure_release(meniscus_structure* structure) { meniscus::c_api::release(structure); }

meniscus_status meniscus_structure_atoms(const meniscus_structure* structure, meniscus_atoms* atoms) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(structure, "structure");
    write_struct(atoms, atoms_of(structure->structure.atoms), "meniscus_atoms");
  });
}

meniscus_status meniscus_structure_report(const meniscus_structure* structure, meniscus_read_report* report) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(structure, "structure");
    write_struct(report, report_of(*structure), "meniscus_read_report");
  });
}

meniscus_status meniscus_structure_table(const meniscus_structure* structure, meniscus_structure_table_id table,
                                         meniscus_array* array) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(structure, "structure");
    require(array, "array");
    *array = find_column(*structure, table);
  });
}

meniscus_status meniscus_structure_colors(const meniscus_structure* structure, const char* scheme, float* atom_colors) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(structure, "structure");
    require(scheme, "scheme");
    require(atom_colors, "atom_colors");
    const std::vector<glm::vec3> colors = structure_colors(structure->structure, scheme);
    std::memcpy(atom_colors, colors.data(), colors.size() * sizeof(glm::vec3));
  });
}
