// SPDX-License-Identifier: BSD-3-Clause
// Looks up the lipophilicity of atoms, and sums their potential on a grid.
#include "core/color/lipophilicity.h"

#include <cmath>
#include <tuple>

#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/math/box.h"
#include "core/structure/bonds.h"
#include "core/structure/residue_names.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<double, 2> kUsualRange{-0.3,
                                            0.3};  // contains 90 % of the surfaces of the proteins that were tested
constexpr double kReach = 8.0;                     // Å
constexpr double kStep = 0.5;                      // Å
constexpr double kMargin = 4.0;                    // Å beyond the centres of atoms
constexpr double kMostPoints = 1 << 26;

/// Atoms of the same type, with their hydrogens.
struct AtomType {
  double value;
  std::string_view atoms;  ///< "residue:name", or ":name" for all amino acids, each between blanks
};

constexpr AtomType kTypes[] = {
    // Charge states with the other atoms of their residue; the contributions of imidazolium, -0.1097 and -0.9048, are
    // halved.
    {-0.50725, " HIP:ND1 HIP:NE2 HSP:ND1 HSP:NE2 "},
    {-0.0024, " CYM:SG "},
    {-0.3187, " PRO:N "},
    {-0.4954, " :N "},
    {0.0425, " GLY:CA "},
    {-0.0821, " :CA "},
    {-0.2783, " :C "},
    {-0.1526, " :O "},
    {0.0087, " :OXT ASH:OD2 GLH:OE2 "},
    // CH3, CH2 and CH of alkanes; CH2 and CH next to N, O or S; CH3 next to S; CH2 next to a ring.
    {0.5131, " ALA:CB VAL:CG1 VAL:CG2 LEU:CD1 LEU:CD2 ILE:CG2 ILE:CD1 THR:CG2 "},
    {0.3901,
     " ARG:CB ARG:CG ASN:CB ASP:CB ASH:CB GLN:CB GLN:CG GLU:CB GLU:CG GLH:CB GLH:CG LEU:CB LYS:CB LYS:CG LYS:CD LYN:CB "
     "LYN:CG LYN:CD MET:CB PRO:CB PRO:CG ILE:CG1 "},
    {0.1230, " VAL:CB LEU:CG ILE:CB "},
    {0.0425, " ARG:CD CYS:CB LYS:CE LYN:CE MET:CG PRO:CD SER:CB "},
    {-0.0821, " THR:CB "},
    {0.1655, " MET:CE "},
    {0.1944, " HIS:CB PHE:CB TRP:CB TYR:CB "},
    // Rings.
    {0.1360, " HIS:CG PHE:CG TRP:CG TYR:CG "},
    {0.2811,
     " HIS:CD2 HIS:CE1 PHE:CD1 PHE:CD2 PHE:CE1 PHE:CE2 PHE:CZ TYR:CD1 TYR:CD2 TYR:CE1 TYR:CE2 TRP:CD1 TRP:CE3 TRP:CZ2 "
     "TRP:CZ3 TRP:CH2 "},
    {0.2955, " TRP:CD2 TRP:CE2 "},
    {0.5437, " TYR:CZ "},
    // Groups with N, O and S; the contributions of carboxylates, -0.1526 and -1.326, and of guanidinium, -1.5216 and
    // -0.5906, are halved.
    {-0.2783, " ASN:CG ASP:CG ASH:CG GLN:CD GLU:CD GLH:CD ARG:CZ "},
    {-0.1526, " ASN:OD1 GLN:OE1 ASH:OD1 GLH:OE1 "},
    {-0.7393, " ASP:OD1 ASP:OD2 GLU:OE1 GLU:OE2 "},
    {-0.5570, " SER:OG THR:OG1 TYR:OH "},
    {-0.5906, " ASN:ND2 GLN:NE2 LYN:NZ "},
    {-1.3074, " LYS:NZ "},
    {-0.4954, " ARG:NE "},
    {-1.0561, " ARG:NH1 ARG:NH2 "},
    {-0.1097, " HIS:NE2 TRP:NE1 "},
    {-0.3239, " HIS:ND1 "},
    {0.3805, " CYS:SG "},
    {0.6482, " MET:SD "}};

/// Force-field names for states of a residue, and the states with atoms of their own.
struct Residue {
  std::string_view name, as;
};
constexpr Residue kResidues[] = {
    {"ALA", "ALA"}, {"ARG", "ARG"}, {"ASN", "ASN"}, {"ASP", "ASP"}, {"CYS", "CYS"}, {"GLN", "GLN"}, {"GLU", "GLU"},
    {"GLY", "GLY"}, {"HIS", "HIS"}, {"ILE", "ILE"}, {"LEU", "LEU"}, {"LYS", "LYS"}, {"MET", "MET"}, {"PHE", "PHE"},
    {"PRO", "PRO"}, {"SER", "SER"}, {"THR", "THR"}, {"TRP", "TRP"}, {"TYR", "TYR"}, {"VAL", "VAL"}, {"ASH", "ASH"},
    {"GLH", "GLH"}, {"LYN", "LYN"}, {"CYX", "CYS"}, {"HID", "HIS"}, {"HIE", "HIS"}, {"HSD", "HIS"}, {"HSE", "HIS"},
    {"HIP", "HIS"}, {"HSP", "HIS"}, {"CYM", "CYS"}};

constexpr double kAmmonium = -1.3074, kAmmoniumOfProline = -1.5216, kCarboxylateOxygen = -0.7393,
                 kSulphurWithoutHydrogen = 0.6482;

/// The numbers of neighbours of an atom.
struct Neighbours {
  std::uint8_t heavy = 0, hydrogens = 0, oxygens = 0;  ///< oxygens: those without another neighbour
  bool of_other_residue = false;                       ///< true if at least one is of another residue
};

/// `bonds` has each bond in both directions.
std::vector<Neighbours> neighbours_of(const std::vector<Atom>& atoms, const std::vector<Bond>& bonds) {
  std::vector<Neighbours> all(atoms.size());
  for (const auto& [own, other] : bonds) {
    ++(atoms[other].element == 1 ? all[own].hydrogens : all[own].heavy);
    if (atoms[own].residue != atoms[other].residue) all[own].of_other_residue = true;
  }
  for (const auto& [own, other] : bonds)
    if (atoms[other].element == 8 && all[other].heavy == 1 && all[other].hydrogens == 0) ++all[own].oxygens;
  return all;
}

bool is_hydrogen(std::string_view name) {
  const std::size_t letter = name.find_first_not_of("0123456789");
  return letter != std::string_view::npos && (name[letter] == 'H' || name[letter] == 'D');
}

/// Computes exp(-d) from the square of d by linear interpolation: within 2e-6 where d is at least 1 Å.
class Decay {
 public:
  Decay() {
    for (std::size_t n = 0; n < values_.size(); ++n)
      values_[n] = std::exp(-std::sqrt(static_cast<double>(n) / kPlaces));
  }
  double at_square(double square) const {
    const double place = square * kPlaces;
    const auto below = static_cast<std::size_t>(place);
    return values_[below] + (place - static_cast<double>(below)) * (values_[below + 1] - values_[below]);
  }

 private:
  static constexpr std::size_t kPlaces = 128;  // number per Å²
  std::array<double, static_cast<std::size_t>(kReach* kReach) * kPlaces + 2> values_{};
};

/// A contribution to the potential.
struct Source {
  glm::dvec3 position;
  double value;
};

VolumeFrame frame_around(const Structure& structure) {
  Box box;
  for (const Atom& atom : structure.atoms) {
    box.include(atom.position - kMargin);
    box.include(atom.position + kMargin);
  }
  const glm::dvec3 room = box.high - box.low;
  const double step = std::max(kStep, std::cbrt(room.x * room.y * room.z / kMostPoints));
  VolumeFrame frame;
  frame.origin = box.low;
  frame.step = glm::dmat3(step);
  for (int axis = 0; axis < 3; ++axis) frame.size[axis] = static_cast<std::size_t>(std::ceil(room[axis] / step)) + 1;
  return frame;
}

/// Computes the potential in one plane of the grid, across the first axis.
void add_plane(const VolumeFrame& frame, std::size_t i, const std::vector<Source>& sources, const Decay& decay,
               float* plane) {
  const double step = frame.step[0][0], x = frame.origin.x + static_cast<double>(i) * step;
  std::vector<double> sums(frame.size[1] * frame.size[2], 0.0);
  for (const Source& source : sources) {
    const double off = x - source.position.x;
    if (std::abs(off) >= kReach) continue;
    const double reach = std::sqrt(kReach * kReach - off * off);
    const auto range = [&](int axis) {
      const double center = (source.position[axis] - frame.origin[axis]) / step,
                   most = static_cast<double>(frame.size[axis]) - 1;
      return std::array{static_cast<std::size_t>(std::clamp(std::ceil(center - reach / step), 0.0, most)),
                        static_cast<std::size_t>(std::clamp(std::floor(center + reach / step), 0.0, most))};
    };
    const auto [first_j, last_j] = range(1);
    const auto [first_k, last_k] = range(2);
    for (std::size_t j = first_j; j <= last_j; ++j) {
      const double y = frame.origin.y + static_cast<double>(j) * step - source.position.y;
      for (std::size_t k = first_k; k <= last_k; ++k) {
        const double z = frame.origin.z + static_cast<double>(k) * step - source.position.z;
        const double square = off * off + y * y + z * z;
        if (square < kReach * kReach) sums[j * frame.size[2] + k] += source.value * decay.at_square(square);
      }
    }
  }
  std::ranges::transform(sums, plane, [](double sum) { return static_cast<float>(sum); });
}

}  // namespace

double lipophilicity(std::string_view residue_name, std::string_view atom_name) {
  const auto residue = std::ranges::find(kResidues, residue_name, &Residue::name);
  if (residue == std::end(kResidues)) return kNoValue;
  const std::string given(residue_name),
      atom = ":" + canonical_atom(canonical_residue(given), std::string(atom_name)) + " ", state = " " + given + atom,
      own = " " + std::string(residue->as) + atom, any = " " + atom;
  for (const AtomType& type : kTypes)
    for (const std::string& name : {state, own, any})
      if (type.atoms.find(name) != std::string_view::npos) return type.value;
  return is_hydrogen(atom_name) ? 0.0 : kNoValue;
}

std::vector<double> lipophilicities(const Structure& structure) {
  const std::vector<Atom>& atoms = structure.atoms;
  std::vector<Bond> bonds = molecule_bonds(
      atoms, structure.topology ? std::span<const Bond>(structure.topology->bonds) : std::span<const Bond>());
  for (std::size_t n = bonds.size(); n-- > 0;) bonds.push_back({bonds[n][1], bonds[n][0]});
  const std::vector<Neighbours> near = neighbours_of(atoms, bonds);
  std::map<std::tuple<std::int32_t, std::uint32_t, std::string_view>, std::uint32_t>
      first;  // first residue of each chain
  std::vector<double> values;
  for (std::size_t a = 0; a < atoms.size(); ++a) {
    const Atom& atom = atoms[a];
    double& value = values.emplace_back(lipophilicity(atom.residue_name, atom.name));
    if (std::isnan(value)) continue;
    const std::uint32_t begin = first.try_emplace({atom.model, atom.copy, atom.chain}, atom.residue).first->second;
    if (atom.name == "SG" && near[a].heavy > 1) value = kSulphurWithoutHydrogen;
    const bool is_ammonium = near[a].hydrogens ? near[a].heavy + near[a].hydrogens == 4 : atom.residue == begin;
    if (atom.name == "N" && is_ammonium && !near[a].of_other_residue)
      value = atom.residue_name == "PRO" ? kAmmoniumOfProline : kAmmonium;
  }
  for (const auto& [own, other] : bonds) {
    const bool is_carboxylate = atoms[own].name == "C" && near[own].oxygens == 2 && near[own].heavy == 3;
    if (is_carboxylate && atoms[other].element == 8 && !std::isnan(values[other])) values[other] = kCarboxylateOxygen;
  }
  return values;
}

ColorScale lipophilicity_scale(const ColorScheme& scheme) {
  ColorScale scale;
  scale.title = scheme.title.empty() ? "lipophilicity potential (Wildman & Crippen 1999)" : scheme.title;
  scale.unit = scheme.unit;
  scale.map = scheme.map.value_or(ColorMap::blue_white_red);
  scale.own_map = scheme.own_map;
  scale.range = scheme.range.value_or(kUsualRange);
  scale.missing_color = scheme.missing.value_or(default_missing_color(scale.map));
  return scale;
}

std::shared_ptr<const VolumePaint> lipophilicity_paint(const Structure& structure, const ColorScheme& scheme) {
  std::vector<Source> sources;
  const std::vector<double> of_atoms = lipophilicities(structure);
  for (std::size_t a = 0; a < of_atoms.size(); ++a)
    if (of_atoms[a] != 0.0 && !std::isnan(of_atoms[a])) sources.push_back({structure.atoms[a].position, of_atoms[a]});
  if (sources.empty())
    throw InputError(structure.file, 0,
                     message("has no amino acids, so there is no lipophilicity potential; choose another @color@"));
  const VolumeFrame frame = frame_around(structure);
  const Decay decay;
  std::vector<float> values(frame.count());
  tbb::parallel_for(std::size_t{0}, frame.size[0], [&](std::size_t i) {
    add_plane(frame, i, sources, decay, values.data() + i * frame.size[1] * frame.size[2]);
  });
  return std::make_shared<VolumePaint>(
      VolumePaint{VolumeGrid(structure.file, frame, std::move(values)), lipophilicity_scale(scheme), 0.0});
}

}  // namespace meniscus
