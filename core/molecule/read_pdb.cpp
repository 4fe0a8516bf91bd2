// SPDX-License-Identifier: BSD-3-Clause
// Reads PDB through gemmi.
#include <utility>

#include <gemmi/pdb.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/molecule/assembly.h"
#include "core/molecule/atom_classes.h"
#include "core/molecule/pdb_text.h"
#include "core/molecule/reader.h"

namespace meniscus {
namespace {

FileContents read_pdb(const TextFile& file) {
  CheckedPdb checked = check_pdb(file);
  gemmi::Structure structure;
  try {
    structure = gemmi::read_pdb_from_memory(checked.text.data(), checked.text.size(), file.path);
  } catch (const std::exception& error) {
    throw InputError(file.path, 0, std::string("is no readable PDB file: ") + escaped(error.what()));
  }
  FileContents contents;
  contents.models = checked.models;
  contents.other_model_atoms = checked.other_model_atoms;
  contents.warnings = std::move(checked.warnings);
  std::vector<AtomHints> hints;
  std::uint32_t residue_index = 0;
  for (const gemmi::Chain& chain : structure.models.at(0).chains) {
    const gemmi::Residue* previous = nullptr;
    for (const gemmi::Residue& residue : chain.residues) {
      // Residues of one number but several names are alternatives at one place (microheterogeneity).
      if (previous && previous->seqid != residue.seqid) ++residue_index;
      previous = &residue;
      // TER marks what precedes it as polymer, yet some programs write one TER at the very end; so only HETATM behind
      // a TER is a statement.
      const ResidueStatement statement = residue.entity_type == gemmi::EntityType::NonPolymer && residue.het_flag == 'H'
                                             ? ResidueStatement::other
                                             : ResidueStatement::none;
      for (const gemmi::Atom& atom : residue.atoms) {
        Atom& out = contents.atoms.emplace_back();
        out.index = static_cast<std::uint32_t>(contents.atoms.size() - 1);
        out.residue = residue_index;
        out.altloc = atom.altloc == '\0' ? ' ' : atom.altloc;
        out.position = {atom.pos.x, atom.pos.y, atom.pos.z};
        hints.push_back({statement, static_cast<std::uint8_t>(atom.element.atomic_number())});
        out.residue_number = residue.seqid.num.value;
        out.insertion_code = residue.seqid.icode;
        out.occupancy = atom.occ;
        out.b_factor = atom.b_iso;
        out.name = atom.name;
        out.residue_name = residue.name;
        out.chain = out.subchain = chain.name.empty() ? residue.segment : chain.name;
      }
    }
    ++residue_index;
  }
  classify_atoms(contents.atoms, hints);
  return contents;
}

}  // namespace

const Reader kPdbReader{{"PDB", ".pdb .ent .pdb.gz", "Protein Data Bank format, fixed columns",
                         "wwPDB file format 3.3; hybrid-36 by R. W. Grosse-Kunstleve",
                         "ATOM, HETATM, TER, MODEL, ENDMDL, END; serial numbers are ignored"},
                        looks_like_pdb,
                        read_pdb,
                        read_pdb_assemblies};

}  // namespace meniscus
