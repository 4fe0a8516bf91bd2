// SPDX-License-Identifier: BSD-3-Clause
// Prints the atoms and bonds of a structure file as text, for the comparison with other readers.
#include <cstdio>
#include <cstdlib>

#include "core/base/error.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/structure.h"

// Usage: atom_dump FILE [MODEL]; model 0 means all models.
int main(int count, char** arguments) {
  try {
    const meniscus::TextFile file = meniscus::read_molecule_file(count > 1 ? arguments[1] : "");
    const int model = count > 2 ? std::atoi(arguments[2]) : 1;
    const meniscus::FileContents contents = meniscus::choose_reader(file).read(file, {model, model == 0});
    std::printf("models\t%zu\n", contents.models);
    for (const meniscus::Atom& atom : contents.atoms)
      std::printf("atom\t%s\t%s\t%d\t%u\t%s\t%c\t%d\t%.9g\t%.17g\t%s\n", atom.name.c_str(), atom.residue_name.c_str(),
                  atom.residue_number, atom.residue, atom.chain.c_str(), atom.insertion_code, atom.element, atom.charge,
                  atom.radius, meniscus::class_name(atom.kind));
    for (const meniscus::Atom& atom : contents.atoms)
      std::printf("place\t%.17g\t%.17g\t%.17g\t%d\n", atom.position.x, atom.position.y, atom.position.z, atom.model);
    for (const meniscus::Bond& bond : contents.bonds) std::printf("bond\t%u\t%u\n", bond[0], bond[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
