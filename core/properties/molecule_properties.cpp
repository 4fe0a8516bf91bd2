// SPDX-License-Identifier: BSD-3-Clause
// Properties of the molecule: the file, the atoms that are used, their radii, and assemblies.
#include <array>

#include "core/properties/tables.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr unsigned kForMolecules = kForRuns | for_info;
constexpr std::string_view kInput = "Input", kRadii = "Radii", kAssembly = "Assembly";

constexpr auto kTable = of_commands(
    kForMolecules,
    std::to_array<Property>({
        file("molecule.file", "FILE", "", "Molecule").in(kInput, in_scene),
        text("molecule.model", "--model", "N|all", "Model or frame to read, from 1; all: all models as one molecule")
            .initially("1")
            .in(kInput, kShared),
        text("molecule.altloc", "--altloc", "WORD",
             "Alternate location to keep in each residue: best (highest occupancy), first, a letter, or all")
            .proposes("best|first|all")
            .initially("best")
            .in(kInput, kShared),
        text("molecule.select", "--select", "EXPR",
             "Use only these atoms, as in 'chain A and resid 10-50'; see meniscus help selections")
            .in(kInput, kShared)
            .in_short_help(),
        flag("molecule.keep_water", "--keep-water", "Use water molecules too").in(kInput, kShared),
        flag("molecule.keep_ions", "--keep-ions", "Use free ions too: lone metal and halogen atoms")
            .in(kInput, kShared),
        word("molecule.unknown_element", "--unknown-element", "WORD",
             "Atoms of unknown element: halt with an error, guess a radius of 2.0 Å, or skip them")
            .one_of("halt|guess|skip")
            .initially("halt")
            .in(kInput, kShared),
        word("molecule.warnings", "--warnings", "WORD",
             "Warnings about the file: summary, full (a line for each atom), or none")
            .one_of("full|summary|none")
            .initially("summary")
            .in(kInput, in_bundle),
        flag("molecule.quiet", "-q,--quiet", "Print errors only: no notes on standard error")
            .in(kInput, in_bundle)
            .in_short_help()
            .of(kForMolecules | for_bench),

        word("molecule.hydrogens", "--hydrogens", "WORD",
             "Hydrogens: keep, drop, or auto: drop them where the radii of heavy atoms include them")
            .one_of("keep|drop|auto")
            .initially("auto")
            .in(kRadii, kShared),
        text("molecule.radii", "--radii", "SET",
             "Van der Waals radii: bondi (by element); united (Chothia 1976) or protor (Tsai et al. 1999), which "
             "include hydrogens; or file, those of the molecule's file")
            .initially("file if it has radii, else bondi")
            .in(kRadii, kShared),
        file("molecule.radii_file", "--radii-file", "FILE",
             "Radii by residue and atom, used before those of --radii: atmtypenumbers of MSMS, FreeSASA .config, "
             "CHARMM .rtf with .prm (or .str), PDB2PQR .DAT, or lines RESIDUE ATOM RADIUS. Repeatable; the last file "
             "that has the atom counts")
            .in(kRadii, kShared | repeatable),
        text("molecule.radius", "--radius", "EXPR=R",
             "Radius R in Å of the atoms that EXPR selects, before all other radii. Repeatable; the last counts")
            .in(kRadii, kShared | repeatable),

        text("molecule.assembly", "--assembly", "ID",
             "Build this biological assembly (REMARK 350 or mmCIF); list: print the assemblies of the file and stop")
            .in(kAssembly, kShared)
            .in_short_help(),
        word("molecule.instances", "--instances", "WORD",
             "Compute one copy and draw it many times. exact: refuse where a probe can touch two copies at once; "
             "separate: each copy has a surface of its own, as if alone")
            .one_of("exact|separate")
            .in(kAssembly, kShared)
            .of(kForRuns)
            .needs("molecule.assembly"),
    }));

}  // namespace

std::span<const Property> molecule_properties() { return kTable; }

}  // namespace meniscus
