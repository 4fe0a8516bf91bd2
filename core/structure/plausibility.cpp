// SPDX-License-Identifier: BSD-3-Clause
// Finds coincident atoms and coordinates in other units, and summarizes warnings of one kind.
#include "core/structure/plausibility.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/math/vector_loops.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

// The first atom at each position, in a hash table with open addressing.
class Places {
 public:
  // Begins without atoms. of_models: true if atoms of several models may have the same position.
  Places(const std::vector<Atom>& atoms, bool of_models)
      : atoms_(atoms), of_models_(of_models), slots_(std::bit_ceil(2 * atoms.size() + 1), kFree) {}

  // Returns the first atom at the position of atom n, and adds n if there is none.
  std::uint32_t first_at_place_of(std::uint32_t n) {
    for (std::size_t slot = scrambled(n);; ++slot) {
      std::uint32_t& first = slots_[slot & (slots_.size() - 1)];
      if (first == kFree) return first = n;
      if (share_place(first, n)) return first;
    }
  }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

  std::size_t scrambled(std::uint32_t n) const {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      hash ^= std::bit_cast<std::uint64_t>(atoms_[n].position[axis] + 0.0);  // -0 becomes 0
      hash *= 0x9e3779b97f4a7c15;
      hash ^= hash >> 32;
    }
    return hash;
  }

  bool share_place(std::uint32_t a, std::uint32_t b) const {
    return atoms_[a].position == atoms_[b].position && (!of_models_ || atoms_[a].model == atoms_[b].model);
  }

  const std::vector<Atom>& atoms_;
  const bool of_models_;
  std::vector<std::uint32_t> slots_;
};

constexpr std::size_t kSample = 64;

// A sample of atoms, and the squared distance (Å²) from each of them to the nearest other atom.
struct Sample {
  std::array<double, kSample> x, y, z, nearest;
};

// True if the point is nearer to any atom of the sample than all points before. `squares` receives its squared distance
// to each atom of the sample.
MENISCUS_VECTOR_CLONES
bool is_nearer(const Sample& sample, const glm::dvec3& point, double* squares) {
  const double px = point.x, py = point.y, pz = point.z;
  std::int64_t nearer = 0;
  for (std::size_t s = 0; s < kSample; ++s) {
    const double dx = px - sample.x[s], dy = py - sample.y[s], dz = pz - sample.z[s];
    squares[s] = dx * dx + dy * dy + dz * dz;
    nearer |= squares[s] < sample.nearest[s] ? 1 : 0;
  }
  return nearer != 0;
}

enum class Neighbors { of_the_same_model, of_other_models };

// Returns the median distance (Å) from at most 64 atoms, evenly spread over the file, to the nearest atom of the same
// model and alternate location, or of another model.
double median_nearest(const std::vector<Atom>& atoms, Neighbors neighbors) {
  const std::size_t step = (atoms.size() + kSample - 1) / kSample, count = (atoms.size() + step - 1) / step;
  Sample sample{};  // unused entries have the distance 0, so that no atom is nearer
  for (std::size_t s = 0; s < count; ++s) {
    const glm::dvec3& position = atoms[s * step].position;
    sample.x[s] = position.x;
    sample.y[s] = position.y;
    sample.z[s] = position.z;
    sample.nearest[s] = std::numeric_limits<double>::infinity();
  }
  std::array<double, kSample> squares;
  for (const Atom& other : atoms) {
    if (!is_nearer(sample, other.position, squares.data())) continue;
    for (std::size_t s = 0; s < count; ++s) {
      const Atom& atom = atoms[s * step];
      const bool is_neighbor = neighbors == Neighbors::of_other_models
                                   ? atom.model != other.model
                                   : &atom != &other && atom.model == other.model && atom.altloc == other.altloc;
      if (is_neighbor) sample.nearest[s] = std::min(sample.nearest[s], squares[s]);
    }
  }
  std::vector<double> distances(sample.nearest.begin(), sample.nearest.begin() + static_cast<std::ptrdiff_t>(count));
  const auto median = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), median, distances.end());
  return std::sqrt(*median);
}

}  // namespace

void warn_of_coincident_atoms(Structure& structure) {
  const std::vector<Atom>& atoms = structure.atoms;
  Places places(atoms, !structure.added.empty());  // files that were superposed may have atoms in common
  std::vector<std::string> cases;
  for (std::uint32_t n = 0; n < atoms.size(); ++n) {
    const std::uint32_t first = places.first_at_place_of(n);
    if (first != n) cases.push_back(fmt::format("{} at {}", label_of(atoms[n]), label_of(atoms[first])));
  }
  if (cases.empty()) return;
  std::string sentence =
      fmt::format("{} {} at exactly the position of another; the surface treats them as one (first: {})",
                  with_thousands(cases.size()), cases.size() == 1 ? "atom lies" : "atoms lie", cases.front());
  structure.report.warnings.emplace_back(std::move(sentence), std::move(cases));
}

void warn_of_wrong_unit(Structure& structure) {
  constexpr std::size_t kFewest = 8;
  constexpr double kShortestUsual = 0.5;
  const std::vector<Atom>& atoms = structure.atoms;
  if (atoms.size() < kFewest) return;
  const double median = median_nearest(atoms, Neighbors::of_the_same_model);
  if (median >= kShortestUsual) return;
  structure.report.warnings.emplace_back(fmt::format(
      "atoms lie {:.2f} Å from their nearest neighbour (median); are the coordinates in nanometres?", median));
}

void warn_of_overlaid_models(Structure& structure) {
  constexpr double kShortestContact = 1.5;  // Å; atoms that are not bonded are farther apart
  if (structure.atoms.empty() || median_nearest(structure.atoms, Neighbors::of_other_models) >= kShortestContact)
    return;
  structure.report.warnings.emplace_back(
      message("{} models lie on one another, as states of one molecule do; the surface is that of all of them "
              "together; @model 1@ takes one",
              with_thousands(structure.report.models)));
}

void WarningCollector::add(std::size_t line, std::string_view text) {
  cases_.push_back(fmt::format("line {}, {}", line, in_quotes(text)));
}

void WarningCollector::warn(std::vector<Warning>& warnings, const char* what) {
  if (cases_.empty()) return;
  std::string sentence = fmt::format("{} {} {} (first: {})", with_thousands(cases_.size()),
                                     cases_.size() == 1 ? "atom has" : "atoms have", what, cases_.front());
  warnings.emplace_back(std::move(sentence), std::move(cases_));
  cases_.clear();
}

}  // namespace meniscus
