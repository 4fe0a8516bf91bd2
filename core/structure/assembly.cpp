// SPDX-License-Identifier: BSD-3-Clause
// Parses operator expressions, multiplies motions, and builds assemblies.
#include "core/structure/assembly.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/ranges.h>
#include <glm/matrix.hpp>

#include "core/math/rigid_motion.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

/// Files have six decimals or fewer. A matrix that is farther from a rotation than this was not meant as one.
constexpr double kRotationTolerance = 1e-3;
constexpr std::size_t kMostFactors = 16;  // A product has at most this many factors; capsids have two.

double farthest_from_identity(const glm::dmat3& m) {
  double farthest = 0.0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) farthest = std::max(farthest, std::abs(m[column][row] - (column == row)));
  }
  return farthest;
}

/// Returns the nearest rotation, which is the orthogonal factor of the polar decomposition (N. J. Higham 1986, Newton's
/// iteration).
glm::dmat3 nearest_rotation(glm::dmat3 m) {
  for (int step = 0; step < 20; ++step) {
    const glm::dmat3 next = 0.5 * (m + glm::inverse(glm::transpose(m)));
    const double change = farthest_from_identity(next - m + glm::dmat3(1.0));
    m = next;
    if (change < 1e-15) break;
  }
  return m;
}

bool parse_count(std::string_view text, std::size_t& count) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  return !text.empty() && error == std::errc() && end == text.data() + text.size();
}

[[noreturn]] void bad_expression(std::string_view expression, const std::string& file) {
  throw InputError(file, 0,
                   "operator expression {} of an assembly cannot be read; examples are 1,2,5 and (1-60) and (X0)(1-5)",
                   in_quotes(expression));
}

/// Parses a list such as "1,2,5", "1-60" or "P,1-3".
std::vector<std::string> operator_list(std::string_view list, std::string_view expression, const std::string& file) {
  std::vector<std::string> names;
  while (true) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const std::string_view item = trimmed(list.substr(0, comma));
    const std::size_t dash = item.find('-', 1);
    std::size_t first = 0, last = 0;
    if (item.empty()) bad_expression(expression, file);
    if (dash == std::string_view::npos) {
      names.emplace_back(item);
    } else {
      if (!parse_count(item.substr(0, dash), first) || !parse_count(item.substr(dash + 1), last) || last < first ||
          last - first >= kMostOperators) {
        bad_expression(expression, file);
      }
      for (std::size_t n = first; n <= last; ++n) names.push_back(std::to_string(n));
    }
    if (names.size() > kMostOperators) bad_expression(expression, file);
    if (comma == list.size()) return names;
    list.remove_prefix(comma + 1);
  }
}

/// True if the part contains the chain of the atom. A part without a list of chains contains all.
bool names_chain_of(const AssemblyPart& part, const Atom& atom) {
  return part.chains.empty() || std::find(part.chains.begin(), part.chains.end(), atom.subchain) != part.chains.end();
}

/// Groups the atoms by their motions, which are those of all parts that contain their chain.
std::vector<Instances> group_by_motions(const std::vector<Atom>& atoms, const Assembly& assembly) {
  std::map<std::string, std::vector<std::size_t>> parts_of_chain;
  std::map<std::vector<std::size_t>, std::size_t> place;
  std::vector<Instances> groups;
  for (std::uint32_t n = 0; n < atoms.size(); ++n) {
    const auto [known, fresh] = parts_of_chain.try_emplace(atoms[n].subchain);
    for (std::size_t p = 0; fresh && p < assembly.parts.size(); ++p)
      if (names_chain_of(assembly.parts[p], atoms[n])) known->second.push_back(p);
    if (known->second.empty()) continue;
    const auto [group, added] = place.try_emplace(known->second, groups.size());
    if (added) {
      std::vector<RigidMotion>& motions = groups.emplace_back().motions;
      for (const std::size_t p : known->second)
        motions.insert(motions.end(), assembly.parts[p].motions.begin(), assembly.parts[p].motions.end());
    }
    groups[group->second].atoms.push_back(n);
  }
  return groups;
}

/// Removes all atoms that are in no group. The order of the others stays.
void keep_members(Structure& structure, std::vector<Instances>& groups) {
  std::vector<char> member(structure.atoms.size(), 0);
  for (const Instances& group : groups) {
    for (const std::uint32_t n : group.atoms) member[n] = 1;
  }
  std::vector<std::uint32_t> place(member.size());
  std::uint32_t kept = 0;
  for (std::size_t n = 0; n < member.size(); ++n) {
    place[n] = kept;
    if (!member[n]) continue;
    if (kept != n) structure.atoms[kept] = std::move(structure.atoms[n]);
    ++kept;
  }
  const std::size_t outside = structure.atoms.size() - kept;
  structure.atoms.resize(kept);
  structure.report.used = kept;
  if (outside > 0) structure.report.excluded[kExcludedAssembly] += outside;
  for (Instances& group : groups) {
    for (std::uint32_t& n : group.atoms) n = place[n];
  }
}

bool within_extent(const glm::dvec3& position) {
  return std::abs(position.x) <= kLargestCoordinate && std::abs(position.y) <= kLargestCoordinate &&
         std::abs(position.z) <= kLargestCoordinate;
}

/// Returns the atoms of all copies, copy after copy, with the atoms of each in file order.
std::vector<Atom> expanded(const std::vector<Atom>& atoms, const std::vector<Instances>& groups, std::size_t total,
                           std::size_t copies, const std::string& file) {
  std::vector<const Instances*> group_of(atoms.size());
  std::uint32_t residues = 0;
  for (const Instances& group : groups) {
    for (const std::uint32_t n : group.atoms) group_of[n] = &group;
  }
  for (const Atom& atom : atoms) residues = std::max(residues, atom.residue + 1);
  std::vector<Atom> result;
  result.reserve(total);
  for (std::uint32_t copy = 0; copy < copies; ++copy) {
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      if (copy >= group_of[n]->motions.size()) continue;
      Atom& atom = result.emplace_back(atoms[n]);
      atom.position = group_of[n]->motions[copy](atom.position);
      if (!within_extent(atom.position))
        throw InputError(file, 0, "copy {} of its assembly puts atoms beyond ±{} Å; correct its operators", copy + 1,
                         kLargestCoordinate);
      atom.copy = copy;
      atom.residue += copy * residues;
      if (copy > 0) atom.chain += fmt::format("-{}", copy + 1);
    }
  }
  return result;
}

}  // namespace

RigidMotion rigid_motion(const std::array<std::array<double, 4>, 3>& rows, const std::string& file, std::size_t line) {
  RigidMotion motion;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) motion.rotation[column][row] = rows[row][column];
    motion.translation[row] = rows[row][3];
  }
  const glm::dmat3& m = motion.rotation;
  const double deviation = farthest_from_identity(glm::transpose(m) * m);
  if (!(deviation <= kRotationTolerance))
    throw InputError(file, line,
                     "the matrix of an assembly is not a rotation: its columns are off unit length or right "
                     "angles by {:.2g}; correct it",
                     deviation);
  if (glm::determinant(m) < 0.0)
    throw InputError(file, line, "the matrix of an assembly mirrors the molecule (determinant -1); correct it");
  motion.rotation = nearest_rotation(m);
  return motion;
}

RigidMotion operator*(const RigidMotion& a, const RigidMotion& b) {
  return {a.rotation * b.rotation, a(b.translation)};
}

std::vector<std::vector<std::string>> operator_factors(std::string_view expression, const std::string& file) {
  std::vector<std::vector<std::string>> lists;
  std::size_t products = 1;
  std::string_view rest = trimmed(expression);
  if (rest.empty()) bad_expression(expression, file);
  while (!rest.empty()) {
    std::string_view list;
    if (rest.front() == '(') {
      const std::size_t close = rest.find(')');
      if (close == std::string_view::npos) bad_expression(expression, file);
      list = rest.substr(1, close - 1);
      rest = trimmed(rest.substr(close + 1));
    } else {
      list = rest.substr(0, rest.find('('));
      rest.remove_prefix(list.size());
    }
    lists.push_back(operator_list(list, expression, file));
    products *= lists.back().size();
    if (products > kMostOperators || lists.size() > kMostFactors) bad_expression(expression, file);
  }
  return lists;
}

const Assembly& find_assembly(std::span<const Assembly> assemblies, const std::string& id, const std::string& file) {
  const auto found = std::find_if(assemblies.begin(), assemblies.end(), [&](const Assembly& a) { return a.id == id; });
  if (found != assemblies.end()) return *found;
  if (assemblies.empty())
    throw InputError(file, 0,
                     message("describes no assembly (REMARK 350, _pdbx_struct_assembly_gen); leave @assembly@ out"));
  std::vector<std::string> ids;
  for (const Assembly& assembly : assemblies) ids.push_back(escaped(assembly.id));
  throw InputError(file, 0, "has no assembly {}; it has {}", in_quotes(id), fmt::join(ids, ", "));
}

bool names_chain_of(const Assembly& assembly, const Atom& atom) {
  return std::any_of(assembly.parts.begin(), assembly.parts.end(),
                     [&](const AssemblyPart& part) { return names_chain_of(part, atom); });
}

RigidMotion copy_motion(const Assembly& assembly, const Atom& atom) {
  std::size_t copy = atom.copy;
  for (const AssemblyPart& part : assembly.parts) {
    if (!names_chain_of(part, atom)) continue;
    if (copy < part.motions.size()) return part.motions[copy];
    copy -= part.motions.size();
  }
  return {};
}

void assemble(Structure& structure, const Assembly& assembly, CopyMode mode) {
  std::vector<Instances> groups = group_by_motions(structure.atoms, assembly);
  if (groups.empty())
    throw InputError(structure.file, 0, "none of the used atoms belongs to a chain of assembly {}",
                     in_quotes(assembly.id));
  keep_members(structure, groups);
  std::size_t total = 0, copies = 0;
  for (const Instances& group : groups) {
    total += group.atoms.size() * group.motions.size();
    copies = std::max(copies, group.motions.size());
  }
  structure.report.assembled = fmt::format("assembly {}: {} {}, {} atoms", escaped(assembly.id), with_thousands(copies),
                                           copies == 1 ? "copy" : "copies", with_thousands(total));
  if (mode == CopyMode::instances) {
    structure.instances = std::move(groups);
    return;
  }
  if (total > kMostAssembledAtoms)
    throw CapacityError(
        message("{}: assembly {} has {} atoms, more than the limit of {}; one surface of it would need about {} GB; "
                "@instances@ draws copies of one",
                structure.file, in_quotes(assembly.id), with_thousands(total), with_thousands(kMostAssembledAtoms),
                with_thousands(total / 250'000)));
  structure.atoms = expanded(structure.atoms, groups, total, copies, structure.file);
}

}  // namespace meniscus
