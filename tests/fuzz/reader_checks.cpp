// SPDX-License-Identifier: BSD-3-Clause
// Checks the atoms of readers.
#include "tests/fuzz/reader_checks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/structure/formats/read_structure.h"

namespace meniscus::fuzz {
namespace {

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

double extent(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

void check_atom(const Atom& atom) {
  require(finite(atom.position) && extent(atom.position) <= kLargestCoordinate, "positions are finite and bounded");
  require(atom.radius >= 0.0 && atom.radius <= 1000.0, "radii are between 0 and 1,000 Å");
  require(!std::isinf(atom.occupancy) && !std::isinf(atom.b_factor) && !std::isinf(atom.charge),
          "occupancy, B-factor and charge are finite or missing");
  require(atom.element <= 118, "elements are known ones");
}

std::optional<FileContents> read(const Reader& reader, const TextFile& file, const ModelChoice& models) {
  try {
    return reader.read(file, models);
  } catch (const InputError& error) {
    require_clear(error);
  } catch (const CapacityError& error) {
    require_clear(error);
  }
  return std::nullopt;
}

/// Checks that quick and thorough reading give the same positions.
void check_positions(const Reader& reader, const TextFile& file, const std::optional<FileContents>& contents) {
  std::vector<glm::dvec3> quick;
  if (!reader.positions || !reader.positions(file.text, quick) || !contents || contents->models != 1) return;
  const auto same = [](const Atom& atom, const glm::dvec3& position) { return atom.position == position; };
  require(std::ranges::equal(contents->atoms, quick, same), "positions are read quickly as thoroughly");
}

void check_assemblies(const Reader& reader, const TextFile& file) {
  if (!reader.assemblies) return;
  try {
    for (const Assembly& assembly : reader.assemblies(file)) {
      for (const AssemblyPart& part : assembly.parts) {
        for (const RigidMotion& motion : part.motions)
          require(finite(motion(glm::dvec3(1.0, 2.0, 3.0))), "motions of assemblies are finite");
      }
    }
  } catch (const InputError& error) {
    require_clear(error);
  } catch (const CapacityError& error) {
    require_clear(error);
  }
}

void check_structure(const std::string& path, const ReadOptions& options, std::size_t bytes) {
  try {
    const Structure structure = read_structure(path, options);
    std::size_t left_out = 0;
    for (const auto& [reason, count] : structure.report.excluded) left_out += count;
    require(structure.report.read == left_out + structure.report.used, "every atom is used or left out for a reason");
    require(structure.report.used == structure.atoms.size() && !structure.atoms.empty(), "the atoms used are there");
    require(structure.report.read <= bytes, "a text names no more atoms than it has bytes");
    for (const Atom& atom : structure.atoms) {
      check_atom(atom);
      require(atom.radius > 0.0, "atoms of a structure have radii");
    }
  } catch (const InputError& error) {
    require_clear(error);
  } catch (const CapacityError& error) {
    require_clear(error);
  }
}

}  // namespace

void check_contents(const FileContents& contents, std::size_t bytes) {
  require(contents.atoms.size() + contents.other_model_atoms <= bytes, "a text names no more atoms than it has bytes");
  std::uint32_t index = 0;
  for (const Atom& atom : contents.atoms) {
    check_atom(atom);
    require(atom.index == index++, "atoms are numbered in the order of the file");
    require(atom.residue <= bytes, "there are no more residues than a text has bytes");
    require(atom.model >= 1 && static_cast<std::size_t>(atom.model) <= contents.models, "models are counted from 1");
  }
  for (const Bond& bond : contents.bonds)
    require(std::max(bond[0], bond[1]) < contents.atoms.size(), "bonds join atoms that are there");
}

void check_reader(const Reader& reader, const ScratchFile& scratch, std::string_view bytes) {
  const std::string& path = scratch.write(bytes);
  TextFile file;
  try {
    file = read_molecule_file(path);
  } catch (const InputError& error) {
    return require_clear(error);
  }
  reader.recognizes(file.text);
  const std::optional<FileContents> first = read(reader, file, {});
  const std::optional<FileContents> all = read(reader, file, {1, true});
  if (first) check_contents(*first, file.text.size());
  if (all) check_contents(*all, file.text.size());
  if (first && all) {
    require(first->models == all->models, "models are counted alike");
    require(first->atoms.size() + first->other_model_atoms == all->atoms.size(), "atoms are counted alike");
  }
  check_positions(reader, file, first);
  check_assemblies(reader, file);
  ReadOptions options;
  options.unknown_element = UnknownElement::guess;
  options.positions.resize(all ? all->atoms.size() : 0);
  options.list_assemblies = true;
  check_structure(path, options, file.text.size());
  options.model.all = options.keep_water = options.keep_ions = options.keep_topology = true;
  options.altloc.rule = AltlocChoice::Rule::all;
  check_structure(path, options, file.text.size());
}

std::vector<Atom> sample_atoms() {
  struct Row {
    const char *name, *residue, *chain;
    int number;
    std::uint8_t element;
    AtomClass kind;
  };
  constexpr Row kRows[] = {
      {"N", "ALA", "A", 1, 7, AtomClass::polymer},    {"CA", "ALA", "A", 1, 6, AtomClass::polymer},
      {"C", "ALA", "A", 1, 6, AtomClass::polymer},    {"O", "ALA", "A", 1, 8, AtomClass::polymer},
      {"N", "GLY", "B", -2, 7, AtomClass::polymer},   {"CA", "GLY", "B", -2, 6, AtomClass::polymer},
      {"1HA", "GLY", "B", -2, 1, AtomClass::polymer}, {"O5'", "DA", "B", 3, 8, AtomClass::polymer},
      {"O", "HOH", "W", 7, 8, AtomClass::water},      {"ZN", "ZN", "Z", 9, 30, AtomClass::ion},
      {"C1", "BNG", "L", 4, 6, AtomClass::ligand},    {"X", "", "", 0, 0, AtomClass::unclassified}};
  std::vector<Atom> atoms;
  for (const Row& row : kRows) {
    Atom& atom = atoms.emplace_back();
    const auto n = static_cast<std::uint32_t>(atoms.size() - 1);
    atom.position = {1.5 * n, 0.25 * n * n, -0.5 * n};
    atom.radius = 1.2 + 0.05 * n;
    atom.element = row.element;
    atom.kind = row.kind;
    atom.index = n;
    atom.residue = n / 3;
    atom.residue_number = row.number;
    atom.altloc = n == 3 ? 'A' : ' ';
    atom.b_factor = n == 5 ? atom.b_factor : 10.0F + static_cast<float>(n);
    atom.occupancy = 1.0F;
    atom.name = row.name;
    atom.residue_name = row.residue;
    atom.chain = atom.subchain = atom.segment = row.chain;
  }
  return atoms;
}

}  // namespace meniscus::fuzz
