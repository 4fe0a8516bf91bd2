// SPDX-License-Identifier: BSD-3-Clause
// Biological assemblies: which chains of an entry occur where and how often, and how a structure is built of them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/text_file.h"

namespace meniscus {

struct Assembly;
struct Atom;
struct RigidMotion;
struct Structure;

/// How the copies of an assembly are made.
enum class CopyMode {
  atoms,     ///< every copy becomes atoms of its own, and the whole gets one surface
  instances  ///< the atoms stay one copy; Structure::instances says where it is
};

/// A file that asks for more is broken, or no machine at hand can take it; it can still be drawn by instances.
inline constexpr std::size_t kMostAssembledAtoms = 10'000'000;
inline constexpr std::size_t kMostOperators = 100'000;

/// The motion of three rows (r1 r2 r3 t) as files round them; the rotation becomes the nearest exact one.
/// Throws InputError(file, line, ...) unless it is a rotation within 1e-3: singular, sheared, scaled or mirrored.
RigidMotion rigid_motion(const std::array<std::array<double, 4>, 3>& rows, const std::string& file, std::size_t line);

/// First b, then a.
RigidMotion operator*(const RigidMotion& a, const RigidMotion& b);

/// The operator identifiers of "1", "1,2,5", "(1-60)", "P,1": one list; of "(X0)(1-5)": one list a factor. A product
/// takes one operator of each list, in the order written (the last is applied first).
/// Throws InputError when the expression cannot be read, has more than kMostOperators products or 16 factors in one.
std::vector<std::vector<std::string>> operator_factors(std::string_view expression, const std::string& file);

/// From REMARK 350 of a PDB file (wwPDB format 3.3). Throws InputError with the line of a broken or missing row.
std::vector<Assembly> read_pdb_assemblies(const TextFile& file);

/// From _pdbx_struct_assembly_gen and _pdbx_struct_oper_list of mmCIF. Throws InputError, CapacityError.
std::vector<Assembly> read_mmcif_assemblies(const TextFile& file);

/// The assembly of this id. Throws InputError naming those there are.
const Assembly& find_assembly(std::span<const Assembly> assemblies, const std::string& id, const std::string& file);

/// Is the atom in one of the assembly's chains?
bool names_chain_of(const Assembly& assembly, const Atom& atom);

/// Where assemble() put this atom of one of its copies, from where the file or a frame has it.
RigidMotion copy_motion(const Assembly& assembly, const Atom& atom);

/// Builds the assembly out of structure.atoms; atoms of chains that it does not name are left out and counted. Copies
/// beyond the first are chains "A-2", "A-3", as in the assembly files of the wwPDB.
/// Throws InputError (no such chain, atoms beyond 10 µm), CapacityError (above kMostAssembledAtoms by CopyMode::atoms).
void assemble(Structure& structure, const Assembly& assembly, CopyMode mode);

}  // namespace meniscus
