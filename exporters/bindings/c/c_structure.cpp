// SPDX-License-Identifier: BSD-3-Clause
// Molecules from files: their atoms as tables without a copy.

#include "core/structure/element_tables.h"
#include "core/structure/structure.h"
#include "exporters/bindings/c/c_calls.h"
#include "exporters/bindings/c/c_structure.h"

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
