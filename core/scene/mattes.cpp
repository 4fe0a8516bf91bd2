// SPDX-License-Identifier: BSD-3-Clause
// Names chains, residues and atoms for mattes.
#include "core/scene/mattes.h"

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/scene/representations.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

std::string named(const std::string& text) { return text.empty() ? "-" : escaped(text); }

std::string residue_of(const Atom& atom) {
  if (atom.residue_name.empty()) return "-";
  const std::string code = atom.insertion_code == ' ' ? "" : escaped(std::string(1, atom.insertion_code));
  return fmt::format("{} {}{}", escaped(atom.residue_name), atom.residue_number, code);
}

/// Collects a matte name by name.
class Namer {
 public:
  explicit Namer(const char* layer) : matte_{layer, {}, {}} {}

  void add(const std::string& name) {
    const auto [known, is_new] = ids_.try_emplace(name, 0);
    if (is_new) known->second = matte_id(name);
    matte_.id.push_back(known->second);
  }

  Matte take() {
    nlohmann::json manifest = nlohmann::json::object();
    for (const auto& [name, id] : ids_) manifest[name] = fmt::format("{:08x}", id);
    matte_.manifest = manifest.dump();
    return std::move(matte_);
  }

 private:
  Matte matte_;
  std::unordered_map<std::string, std::uint32_t> ids_;
};

}  // namespace

std::shared_ptr<const std::vector<Matte>> mattes_of(const Structure& structure) {
  Namer chains("CryptoChain"), residues("CryptoResidue"), atoms("CryptoAtom");
  std::unordered_map<std::string, std::uint32_t> places;  // places in the file, by name
  for (const Atom& atom : shown_atoms(structure)) {
    const std::string chain = named(atom.chain), residue = chain + "/" + residue_of(atom);
    std::string name = residue + "/" + named(atom.name);
    const std::uint32_t first = places.try_emplace(name, atom.index).first->second;
    if (first != atom.index) name += fmt::format("#{}", atom.index);
    chains.add(chain);
    residues.add(residue);
    atoms.add(name);
  }
  auto mattes = std::make_shared<std::vector<Matte>>();
  for (Namer* const namer : {&chains, &residues, &atoms}) mattes->push_back(namer->take());
  return mattes;
}

}  // namespace meniscus
