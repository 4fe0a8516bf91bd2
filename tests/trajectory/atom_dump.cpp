// SPDX-License-Identifier: BSD-3-Clause
// Prints the atoms and bonds of a topology as text, for the comparison with other readers.
#include <cstdio>

#include "core/base/error.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/structure.h"

int main(int count, char** arguments) {
  try {
    const meniscus::TextFile file = meniscus::read_text_file(count > 1 ? arguments[1] : "");
    const meniscus::FileContents contents = meniscus::choose_reader(file).read(file, {});
    for (const meniscus::Atom& atom : contents.atoms)
      std::printf("atom\t%s\t%s\t%d\t%u\t%s\t%c\t%d\t%.9g\t%.17g\t%s\n", atom.name.c_str(), atom.residue_name.c_str(),
                  atom.residue_number, atom.residue, atom.chain.c_str(), atom.insertion_code, atom.element, atom.charge,
                  atom.radius, meniscus::class_name(atom.kind));
    for (const meniscus::Bond& bond : contents.bonds) std::printf("bond\t%u\t%u\n", bond[0], bond[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
