// SPDX-License-Identifier: BSD-3-Clause
// Properties of the molecule: the file, the atoms in use, their radii, and assemblies.
#include <array>

#include "core/properties/properties.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr std::string_view kInput = "Input", kRadii = "Radii", kAssembly = "Assembly";

constexpr auto kTable = std::to_array<Property>({
    file("molecule.file", "FILE", "", "Molecule").in(kInput, in_scene),
    file("molecule.add", "--add", "FILE",
         "Add the atoms of another molecule file, as model 2, 3 ... of the first. Repeatable")
        .in(kInput, kShared | repeatable | in_short_help),
    text("molecule.superpose_on", "--superpose-on", "EXPR",
         "Superpose the files of @add@ on FILE by these atoms. 'name CA' takes alpha carbons. Chains are paired "
         "and aligned by sequence; the number of atoms and the RMSD are printed")
        .in(kInput, kShared)
        .needs("molecule.add"),
    text("molecule.model", "--model", "N|all", "Model to read, from 1; all: all models as one molecule")
        .initially("1")
        .in(kInput, kShared),
    text("molecule.altloc", "--altloc", "WORD",
         "Alternate location to keep: best, first, a letter, or all. best: the one of highest occupancy in each "
         "residue")
        .proposes("best|first|all")
        .initially("best")
        .in(kInput, kShared),
    text("molecule.select", "--select", "EXPR",
         "Use these atoms, such as 'chain A and resid 10-50' or all. Default: the polymers of FILE, or all atoms if it "
         "has none. See meniscus help selections")
        .in(kInput, kShared | in_short_help),
    flag("molecule.keep_water", "--keep-water", "Use water molecules, too").in(kInput, kShared),
    flag("molecule.keep_ions", "--keep-ions", "Use free ions, too: lone metal and halogen atoms").in(kInput, kShared),
    word("molecule.unknown_element", "--unknown-element", "WORD",
         "Atoms of unknown element: halt, guess or skip. halt: stop with an error; guess: use a radius of 2.0 Å; "
         "skip: leave them out")
        .one_of("halt|guess|skip")
        .initially("halt")
        .in(kInput, kShared),
    word("molecule.warnings", "--warnings", "WORD",
         "Warnings about the file: summary, full (one line per atom) or none")
        .one_of("full|summary|none")
        .initially("summary")
        .in(kInput, in_bundle),
    flag("molecule.quiet", "-q,--quiet", "Print errors only").in(kInput, in_bundle | in_short_help),
    flag("molecule.verbose", "--verbose", "Print the device and the time of each stage, too").in(kInput, in_bundle),

    word("molecule.hydrogens", "--hydrogens", "WORD",
         "Hydrogens: keep, drop or auto. auto: drop them if the radii of heavy atoms include them")
        .one_of("keep|drop|auto")
        .initially("auto")
        .in(kRadii, kShared),
    text("molecule.radii", "--radii", "SET",
         "Van der Waals radii: bondi, united, protor, martini2, martini3 or file. bondi: by element; united "
         "(Chothia 1976) and protor (Tsai et al. 1999) include hydrogens; martini2 and martini3: for beads; file: "
         "those in FILE")
        .initially("file if it has radii, else bondi; for Martini's beads by its version")
        .in(kRadii, kShared),
    file("molecule.radii_file", "--radii-file", "FILE",
         "File of radii by residue and atom, used before @radii@. Formats: atmtypenumbers of MSMS, FreeSASA "
         ".config, CHARMM .rtf with .prm (or .str), PDB2PQR .DAT, or lines RESIDUE ATOM RADIUS. Repeatable; the "
         "last file that has an atom counts")
        .in(kRadii, kShared | repeatable),
    text("molecule.radius", "--radius", "EXPR=R",
         "Radius R in Å of the atoms of EXPR, before all others. Repeatable; the last one counts")
        .in(kRadii, kShared | repeatable),

    text("molecule.assembly", "--assembly", "ID",
         "Build this biological assembly; list: print all of FILE and stop. Assemblies come from REMARK 350 or "
         "mmCIF")
        .in(kAssembly, kShared | in_short_help),
    word("molecule.instances", "--instances", "WORD",
         "Compute one copy of an assembly and draw it many times. exact: refuse if a probe can touch two copies at "
         "once; separate: give each copy a surface as if it were alone")
        .one_of("exact|separate")
        .in(kAssembly, kShared)
        .needs("molecule.assembly"),
});

}  // namespace

std::span<const Property> molecule_properties() { return kTable; }

}  // namespace meniscus
