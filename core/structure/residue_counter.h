// SPDX-License-Identifier: BSD-3-Clause
// Tells which atoms of a file form one residue, though numbers wrap, repeat and come in pieces.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace meniscus {

struct Atom;

/// Numbers residues in the order of the file. Neighbouring atoms of one model, chain, segment, number, insertion code
/// and name are one residue (of several names only where all are alternate locations). Where such a combination comes
/// again later it is the same residue too, unless it brings an atom that the residue has already: then its number has
/// wrapped (after 9,999 in PDB and 99,999 in GRO), and it is another one.
class ResidueCounter {
 public:
  /// `atoms` are those counted so far; the caller appends each atom after it was numbered.
  explicit ResidueCounter(const std::vector<Atom>& atoms) : atoms_(atoms) {}

  /// Sets atom.index and atom.residue.
  void number(Atom& atom);
  /// The next atom begins a new piece, as after TER.
  void end_piece() { piece_open_ = false; }

 private:
  struct Piece {
    std::uint32_t residue;
    std::size_t begin, end;  ///< atoms
  };
  bool continues(const Piece& piece, const Atom& atom) const;

  const std::vector<Atom>& atoms_;
  std::unordered_map<std::string, Piece> last_piece_;
  Piece* piece_ = nullptr;
  bool piece_open_ = false;
  std::uint32_t residues_ = 0;
};

}  // namespace meniscus
