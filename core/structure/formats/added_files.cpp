// SPDX-License-Identifier: BSD-3-Clause
// Reads added files, continues the numbers of models, residues and atoms, and superposes the files.
#include "core/structure/formats/added_files.h"

#include <algorithm>
#include <iterator>

namespace meniscus {
namespace {

/// The numbers of atoms, residues and models before a file is added.
struct Ends {
  std::uint32_t atoms = 0, residues = 0;
  std::int32_t models = 0;

  explicit Ends(const std::vector<Atom>& all) : atoms(static_cast<std::uint32_t>(all.size())) {
    for (const Atom& atom : all) {
      residues = std::max(residues, atom.residue + 1);
      models = std::max(models, atom.model);
    }
  }
};

FileContents read(const TextFile& file, const ModelChoice& models, FileRadii radii, const std::string& first) {
  const Reader& reader = choose_reader(file);
  FileContents contents = reader.read(file, {1, models.all});
  if (contents.without_positions)
    throw InputError(file.path, 0, message("lists atoms without coordinates, so @add@ cannot use it"));
  if ((contents.radii == FileRadii::usual) != (radii == FileRadii::usual))
    throw InputError(file.path, 0,
                     message("has {} of its own, and {} has {}; @add@ needs files of one kind",
                             contents.radii == FileRadii::usual ? "radii" : "no radii", escaped(first),
                             radii == FileRadii::usual ? "them" : "none"));
  return contents;
}

std::vector<bool> selected(const Selection& selection, std::span<const Atom> atoms, const std::string& path) {
  if (selection.uses_radius())
    throw InputError(path, 0, message("has no radii yet, so @superpose-on@ cannot select by them"));
  return selection.evaluate(atoms);
}

}  // namespace

AddedFiles::AddedFiles(const std::string& path, std::span<const std::string> files, const ModelChoice& models,
                       const std::optional<Selection>& superpose_on, FileContents& contents) {
  const std::size_t own_atoms = contents.atoms.size();
  for (const std::string& name : files) {
    const TextFile file = read_molecule_file(name);
    FileContents more = read(file, models, contents.radii, path);
    Part& part = parts_.emplace_back();
    const Ends ends(contents.atoms);
    if (more.radii != contents.radii) contents.radii = FileRadii::none;  // not all files have radii of a force field
    part.begin = contents.atoms.size();
    part.end = part.begin + more.atoms.size();
    if (superpose_on) {
      const std::span<const Atom> own(contents.atoms.data(), own_atoms);
      part.pairs = corresponding_atoms(own, selected(*superpose_on, own, path), more.atoms,
                                       selected(*superpose_on, more.atoms, file.path));
      if (part.pairs.empty())
        throw InputError(file.path, 0,
                         message("has no chain that corresponds to one of {} by its sequence, with three atoms or more "
                                 "of @superpose-on {}@; choose other atoms, or add the file where it is",
                                 escaped(path), in_quotes(superpose_on->text())));
      for (AtomPair& pair : part.pairs) pair.moved += ends.atoms;
    }
    for (Atom& atom : more.atoms) {
      atom.index += ends.atoms;
      atom.residue += ends.residues;
      atom.model += ends.models;
    }
    for (const Bond& bond : more.bonds) contents.bonds.push_back({bond[0] + ends.atoms, bond[1] + ends.atoms});
    for (const std::int32_t model : more.fully_bonded) contents.fully_bonded.push_back(model + ends.models);
    part.file = {file.path, more.atoms.empty() ? ends.models + 1 : more.atoms.front().model, more.atoms.size(), {}};
    contents.sites.resize(ends.atoms);
    contents.sites.insert(contents.sites.end(), more.sites.begin(), more.sites.end());
    contents.atoms.insert(contents.atoms.end(), std::make_move_iterator(more.atoms.begin()),
                          std::make_move_iterator(more.atoms.end()));
    contents.other_model_atoms += more.other_model_atoms;
    if (more.of_molecules && more.models > 1 && !models.all)
      more.warnings.emplace_back(fmt::format(
          "{} molecules are in the file, and the first is added; to add another, save it as a file of its own",
          with_thousands(more.models)));
    for (Warning& warning : more.warnings) {
      warning.text = fmt::format("{}: {}", escaped(file.path), warning.text);
      contents.warnings.push_back(std::move(warning));
    }
  }
}

std::vector<AddedFile> AddedFiles::place(std::vector<Atom>& atoms) const {
  std::vector<AddedFile> added;
  for (const Part& part : parts_) {
    AddedFile& file = added.emplace_back(part.file);
    if (part.pairs.empty()) continue;
    file.fit = superposition(atoms, atoms, part.pairs);
    for (std::size_t a = part.begin; a < part.end; ++a) atoms[a].position = file.fit->motion(atoms[a].position);
  }
  return added;
}

}  // namespace meniscus
