// SPDX-License-Identifier: BSD-3-Clause
// Biological assemblies: the copies of each chain of an entry, and how a structure is built from them.
#pragma once

#include "core/base/text_file.h"

namespace meniscus {

struct Assembly;
struct Atom;
struct RigidMotion;
struct Structure;

/// The representation of the copies of an assembly.
enum class CopyMode {
  atoms,     ///< every copy has atoms of its own, and all of them together have one surface
  instances  ///< the atoms exist once; Structure::instances has the motions of the copies
};

/// The greatest number of atoms of an assembly with CopyMode::atoms. A larger one is an error of the file, or too large
/// for any machine; it can still be drawn with instances.
inline constexpr std::size_t kMostAssembledAtoms = 10'000'000;
inline constexpr std::size_t kMostOperators = 100'000;

/// Returns the motion of three rows (r1 r2 r3 t), which files have rounded. The rotation is replaced by the nearest
/// exact one. Throws InputError(file, line, ...) unless it is a rotation within 1e-3, for example if it is singular,
/// sheared, scaled or a mirror.
RigidMotion rigid_motion(const std::array<std::array<double, 4>, 3>& rows, const std::string& file, std::size_t line);

/// Returns the motion that applies first b, then a.
RigidMotion operator*(const RigidMotion& a, const RigidMotion& b);

/// Parses an operator expression into lists of operator identifiers. "1", "1,2,5", "(1-60)" and "P,1" have one list;
/// "(X0)(1-5)" has one list for each factor. A product takes one operator from each list, in the order written; the
/// last is applied first.
/// Throws InputError if the expression cannot be parsed, has more than kMostOperators products, or has more than 16
/// factors.
std::vector<std::vector<std::string>> operator_factors(std::string_view expression, const std::string& file);

/// Reads the assemblies of a PDB file from REMARK 350 (wwPDB format 3.3). Throws InputError with the line of a broken
/// or missing row.
std::vector<Assembly> read_pdb_assemblies(const TextFile& file);

/// Reads the assemblies of an mmCIF file from _pdbx_struct_assembly_gen and _pdbx_struct_oper_list. Throws InputError
/// and CapacityError.
std::vector<Assembly> read_mmcif_assemblies(const TextFile& file);

/// Returns the assembly with this id. Throws InputError, which lists the existing ids.
const Assembly& find_assembly(std::span<const Assembly> assemblies, const std::string& id, const std::string& file);

/// True if the atom is in one of the assembly's chains.
bool names_chain_of(const Assembly& assembly, const Atom& atom);

/// Returns the motion from the position of an atom in the file, or in a frame, to its position in the copy to which
/// assemble() added it.
RigidMotion copy_motion(const Assembly& assembly, const Atom& atom);

/// Builds the assembly from structure.atoms. Atoms of chains that are not in the assembly are left out and counted.
/// Chains of copies after the first are named "A-2", "A-3", as in the assembly files of the wwPDB.
/// Throws InputError if there is no such chain or if atoms are beyond 10 µm. Throws CapacityError above
/// kMostAssembledAtoms with CopyMode::atoms.
void assemble(Structure& structure, const Assembly& assembly, CopyMode mode);

}  // namespace meniscus
