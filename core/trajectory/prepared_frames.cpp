// SPDX-License-Identifier: BSD-3-Clause
// Checks the order of atoms by bonds that are too long, makes molecules whole, centres, superposes and smooths the
// frames of a trajectory, and reads some ahead into a queue.
#include "core/trajectory/prepared_frames.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include <gemmi/elem.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/bonds.h"
#include "core/structure/superposition.h"

namespace meniscus {
namespace {

glm::dvec3 mean_of(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> atoms) {
  glm::dvec3 sum(0.0);
  for (const std::uint32_t a : atoms) sum += positions[a];
  return sum / static_cast<double>(atoms.size());
}

/// The weights of the frames around a place, in order. The two frames next to the place are in the middle.
using PathWeights = std::array<double, 2 * kPathNeighbors + 2>;

/// Returns the weights of the frames for the path at t in (0, 1) between two frames. At both frames its speed and its
/// acceleration are finite differences of the frames. Differences of fourth order would make it slow at frames, because
/// the path turns at frames that are noise. The share kMore of the next difference, and the second differences over two
/// and three frames (kTwo, kThree), are those with which the speed varies least. It varies by at most 2.5 %, both for
/// frames that are independent of each other and for frames whose steps are independent. Cubics are reproduced.
PathWeights path_weights(double t) {
  constexpr double kMore = 0.076, kTwo = -0.42, kThree = -0.0485;
  constexpr std::array kSpeed{2.0 / 3.0 + 5.0 * kMore, -1.0 / 12.0 - 4.0 * kMore, kMore};
  constexpr std::array kAcceleration{1.0 - 4.0 * kTwo - 9.0 * kThree, kTwo, kThree};
  static_assert(kSpeed.size() == kPathNeighbors && kAcceleration.size() == kPathNeighbors);
  const double t2 = t * t, t3 = t2 * t, to = t3 * (10.0 - 15.0 * t + 6.0 * t2);
  const std::array position{1.0 - to, to}, speed{t - t3 * (6.0 - 8.0 * t + 3.0 * t2), t3 * (7.0 * t - 4.0 - 3.0 * t2)},
      acceleration{0.5 * t2 * (1.0 - t * (3.0 - 3.0 * t + t2)), t3 * (0.5 - t + 0.5 * t2)};
  PathWeights weights{};
  for (std::size_t end = 0; end < 2; ++end) {
    const std::size_t here = kPathNeighbors + end;
    weights[here] += position[end];
    for (std::size_t k = 1; k <= kPathNeighbors; ++k) {
      const double of_speed = speed[end] * kSpeed[k - 1], of_bend = acceleration[end] * kAcceleration[k - 1];
      weights[here - k] += of_bend - of_speed;
      weights[here] -= 2.0 * of_bend;
      weights[here + k] += of_bend + of_speed;
    }
  }
  return weights;
}

/// Returns weights that use no frames before `first` or after `last`. Beyond them the path goes on straight, with the
/// speed of the last two steps.
PathWeights restrict_weights(PathWeights weights, std::size_t first, std::size_t last) {
  const std::size_t steps = std::min<std::size_t>(2, last - first);
  const auto fold = [&](std::size_t beyond, std::size_t end, std::size_t other, std::size_t far) {
    const double ways = static_cast<double>(far) / static_cast<double>(steps);
    weights[end] += (1.0 + ways) * weights[beyond];
    weights[other] -= ways * weights[beyond];
    weights[beyond] = 0.0;
  };
  for (std::size_t n = 0; n < first; ++n) fold(n, first, first + steps, first - n);
  for (std::size_t n = last + 1; n < weights.size(); ++n) fold(n, last, last - steps, n - last);
  return weights;
}

}  // namespace

PreparedFrames::PreparedFrames(Trajectory& trajectory, Preparation preparation)
    : trajectory_(trajectory), preparation_(std::move(preparation)) {
  if (preparation_.superposed.empty() && preparation_.centered.empty()) return;
  Frame frame;
  read_aligned(preparation_.reference, frame);  // does not move anything yet, because there is no reference
  reference_ = std::move(frame.positions);
}

void PreparedFrames::read_aligned(std::uint64_t number, Frame& frame) {
  trajectory_.read(number, frame);
  std::vector<glm::dvec3>& positions = frame.positions;
  if (preparation_.whole) {
    const std::string where = fmt::format("{}: frame {}", trajectory_.path(), number);
    if (!frame.cell) throw InputError(where, 0, message("has no periodic box, which @whole@ needs; leave @whole@ out"));
    preparation_.whole->apply(*frame.cell, positions, where);
  }
  if (reference_.empty()) return;
  if (!preparation_.superposed.empty()) {
    const RigidMotion motion = superposition(reference_, positions, preparation_.superposed);
    for (glm::dvec3& x : positions) x = motion(x);
  }
  if (!preparation_.centered.empty()) {
    const glm::dvec3 shift = mean_of(reference_, preparation_.centered) - mean_of(positions, preparation_.centered);
    for (glm::dvec3& x : positions) x += shift;
  }
}

const Frame& PreparedFrames::aligned(std::uint64_t number) {
  for (const CachedFrame& kept : cache_)
    if (kept.number == number) return kept.frame;
  // Room for one window of smoothing or of a path, and one neighbour on each side for velocities.
  const std::size_t around = preparation_.bonds ? 2 * kPathNeighbors + 1 : 0;
  if (cache_.size() > 2 * preparation_.smooth_half + around + 2) cache_.pop_front();
  CachedFrame fresh{number, {}};
  read_aligned(number, fresh.frame);
  return cache_.emplace_back(std::move(fresh)).frame;
}

void PreparedFrames::read(std::uint64_t number, Frame& frame) {
  // Throws an error that describes the fault.
  if (number >= trajectory_.frame_count()) return trajectory_.read(number, frame);
  const auto last = static_cast<std::int64_t>(trajectory_.frame_count()) - 1;
  const std::int64_t half = std::min(static_cast<std::int64_t>(preparation_.smooth_half), last);
  if (half == 0) {
    frame = aligned(number);
    return;
  }
  std::vector<glm::dvec3> sum(trajectory_.atom_count(), glm::dvec3(0.0));
  const auto add = [&](std::int64_t n, double weight) {
    const Frame& one = aligned(static_cast<std::uint64_t>(n));
    for (std::size_t a = 0; a < sum.size(); ++a) sum[a] += weight * one.positions[a];
  };
  const auto here = static_cast<std::int64_t>(number);
  for (std::int64_t n = here - half; n <= here + half; ++n) {
    const std::int64_t end = n < 0 ? 0 : last;
    if (n >= 0 && n <= last) {
      add(n, 1.0);
    } else {
      add(end, 2.0);
      add(2 * end - n, -1.0);
    }
  }
  frame = aligned(number);
  for (std::size_t a = 0; a < sum.size(); ++a) frame.positions[a] = sum[a] / static_cast<double>(2 * half + 1);
}

void PreparedFrames::read_between(const BetweenFrames& place, Frame& frame) {
  std::array<Frame, std::tuple_size_v<PathWeights>> frames;
  std::size_t first = kPathNeighbors, last = kPathNeighbors + 1;
  const Frame &from = frames[first], &to = frames[last];
  read(place.from, frames[first]);
  read(place.to, frames[last]);
  refuse_jumps(place.from, from, place.to, to);
  // The path ends as a run does where a frame cannot be read or atoms jump.
  const auto read_on = [&](const std::vector<std::uint64_t>& numbers, std::uint64_t near, bool is_after) {
    std::size_t& end = is_after ? last : first;
    for (const std::uint64_t number : numbers) {
      const std::size_t beyond = is_after ? end + 1 : end - 1;
      try {
        read(number, frames[beyond]);
        refuse_jumps(near, frames[end], number, frames[beyond]);
      } catch (const InputError&) {
        return;
      }
      end = beyond;
      near = number;
    }
  };
  read_on(place.before, place.from, false);
  read_on(place.after, place.to, true);
  const PathWeights weights = restrict_weights(path_weights(place.share), first, last);
  frame = from;
  if (from.time && to.time) frame.time = *from.time + place.share * (*to.time - *from.time);
  for (std::size_t a = 0; a < frame.positions.size(); ++a) {
    glm::dvec3 sum(0.0);
    for (std::size_t n = first; n <= last; ++n) sum += weights[n] * frames[n].positions[a];
    frame.positions[a] = sum;
  }
  if (preparation_.bonds) path(place, from, to).correct(place.share, frame.positions);
}

const BondedPath& PreparedFrames::path(const BetweenFrames& place, const Frame& from, const Frame& to) {
  const std::pair ends(place.from, place.to);
  if (!path_ || path_ends_ != ends) path_.emplace(*preparation_.bonds, from.positions, to.positions);
  path_ends_ = ends;
  return *path_;
}

/// Throws InputError for an atom that moves by more than half of the box between two frames. Such an atom has left the
/// box and come in at its other side.
void PreparedFrames::refuse_jumps(std::uint64_t number, const Frame& from, std::uint64_t next, const Frame& to) const {
  if (!from.cell || !to.cell) return;
  const std::optional<PeriodicCell> cell = PeriodicCell::of(*to.cell);
  if (!cell) return;
  for (const std::uint32_t a : preparation_.followed) {
    const glm::dvec3 step = to.positions[a] - from.positions[a];
    if (glm::length(step - cell->shortest(step)) < 1e-3) continue;
    throw InputError(fmt::format("{}: frame {}", trajectory_.path(), next), 0,
                     message("atom {} is {:.1f} Å from where it was in frame {}, across the periodic box, so there is "
                             "no way between them; add @whole bonds@, or leave its molecule out by @select@",
                             a + 1, glm::length(step), number));
  }
}

namespace {

constexpr std::uint32_t kUnassigned = 0xffffffffu;

/// The neighbours of each atom, as one list after another.
struct Neighbors {
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> atom;

  Neighbors(std::size_t count, std::span<const Bond> bonds) : begin(count + 1), atom(2 * bonds.size()) {
    for (const Bond& bond : bonds)
      for (const std::uint32_t end : bond) ++begin[end + 1];
    for (std::size_t n = 0; n < count; ++n) begin[n + 1] += begin[n];
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (const auto& [a, b] : bonds) {
      atom[next[a]++] = b;
      atom[next[b]++] = a;
    }
  }
  std::span<const std::uint32_t> of(std::uint32_t a) const {
    return std::span(atom).subspan(begin[a], begin[a + 1] - begin[a]);
  }
};

/// Throws InputError for a residue in several pieces, whose relative positions are unknown.
void refuse_pieces(std::span<const Atom> atoms, std::span<const std::uint32_t> molecule,
                   const std::vector<bool>& is_chosen, const std::string& file) {
  for (std::size_t n = 1; n < atoms.size(); ++n) {
    const bool same_residue = atoms[n].residue == atoms[n - 1].residue;
    if (!same_residue || molecule[n] == molecule[n - 1]) continue;
    if (!is_chosen[molecule[n]] && !is_chosen[molecule[n - 1]]) continue;
    throw InputError(
        file, 0,
        message(
            "no bond is known between {} and the rest of its residue, so it cannot be made whole; give a topology that "
            "lists bonds (PSF, PDB with CONECT), choose @whole guess@ (bonds by distance), or leave it out by @select@",
            label_of(atoms[n])));
  }
}

}  // namespace

WholeMolecules::WholeMolecules(std::span<const Atom> atoms, std::span<const Bond> bonds,
                               std::span<const std::uint32_t> wanted, const std::string& file) {
  const Neighbors neighbors(atoms.size(), bonds);
  std::vector<std::uint32_t> molecule(atoms.size(), kUnassigned);
  std::vector<std::vector<Step>> molecules;
  for (std::uint32_t first = 0; first < atoms.size(); ++first) {
    if (molecule[first] != kUnassigned) continue;
    const auto number = static_cast<std::uint32_t>(molecules.size());
    std::vector<Step>& steps = molecules.emplace_back();
    molecule[first] = number;
    steps.push_back({first, first});
    for (std::size_t n = 0; n < steps.size(); ++n) {  // breadth-first search
      const std::uint32_t from = steps[n].atom;
      for (const std::uint32_t next : neighbors.of(from)) {
        if (molecule[next] != kUnassigned) continue;
        molecule[next] = number;
        steps.push_back({next, from});
      }
    }
  }
  std::vector<bool> is_chosen(molecules.size());
  for (const std::uint32_t a : wanted) is_chosen[molecule[a]] = true;
  refuse_pieces(atoms, molecule, is_chosen, file);
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t number = 0; number < molecules.size(); ++number)
    if (is_chosen[number]) chosen.push_back(number);
  std::ranges::stable_sort(chosen,
                           [&](std::uint32_t a, std::uint32_t b) { return molecules[a].size() > molecules[b].size(); });
  begins_.push_back(0);
  for (const std::uint32_t number : chosen) {
    steps_.insert(steps_.end(), molecules[number].begin(), molecules[number].end());
    begins_.push_back(steps_.size());
  }
  for (const Bond& bond : bonds)
    if (is_chosen[molecule[bond[0]]]) bonds_.push_back(bond);
}

void WholeMolecules::apply(const glm::dmat3& vectors, std::vector<glm::dvec3>& positions,
                           const std::string& where) const {
  const std::optional<PeriodicCell> cell = PeriodicCell::of(vectors);
  if (!cell) throw InputError(where, 0, message("has a periodic box without volume; leave @whole@ out"));
  for (const auto& [atom, from] : steps_)
    if (atom != from) positions[atom] = positions[from] + cell->shortest(positions[atom] - positions[from]);
  // A bond that is not in steps_ closes a ring. If it crosses the box, it joins the molecule with its own image.
  for (const auto& [a, b] : bonds_) {
    const glm::dvec3 bond = positions[b] - positions[a];
    // The two vectors are equal except for rounding, or they differ by a lattice vector, which is longer than any bond.
    if (glm::length(bond - cell->shortest(bond)) > 1e-3)
      throw InputError(where, 0,
                       message("atoms {} and {} are bonded across the periodic box to an image of their own molecule, "
                               "which cannot be made whole; leave @whole@ out",
                               a + 1, b + 1));
  }
  std::vector<std::uint32_t> atoms;
  glm::dvec3 anchor(0.0);
  for (std::size_t m = 0; m + 1 < begins_.size(); ++m) {
    atoms.clear();
    for (std::size_t n = begins_[m]; n < begins_[m + 1]; ++n) atoms.push_back(steps_[n].atom);
    const glm::dvec3 center = mean_of(positions, atoms);
    if (m == 0) anchor = center;
    const glm::dvec3 shift = cell->shortest(center - anchor) - (center - anchor);
    for (const std::uint32_t a : atoms) positions[a] += shift;
  }
}

ReadAhead::ReadAhead(std::function<void(ReadFrame&)> read, std::vector<std::uint64_t> numbers, std::size_t depth)
    : read_(std::move(read)), numbers_(std::move(numbers)), depth_(depth), thread_([this] { work(); }) {}

ReadAhead::~ReadAhead() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ReadAhead::work() {
  for (const std::uint64_t number : numbers_) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stop_ || ready_.size() < depth_; });
      if (stop_) return;
    }
    ReadFrame fresh;
    fresh.number = number;
    try {
      read_(fresh);
    } catch (...) {
      fresh.error = std::current_exception();
    }
    {
      const std::lock_guard lock(mutex_);
      ready_.push_back(std::move(fresh));
    }
    changed_.notify_all();
  }
}

std::optional<ReadFrame> ReadAhead::next() {
  if (taken_ == numbers_.size()) return {};
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !ready_.empty(); });
  std::optional<ReadFrame> frame(std::move(ready_.front()));
  ready_.pop_front();
  ++taken_;
  lock.unlock();
  changed_.notify_all();
  return frame;
}

namespace {

constexpr double kShortest = 0.5;  // Å; shorter means that atoms have no positions yet, for example all at the origin
constexpr double kShortestJump = 8.0;  // Å; a jump across any box is at least as long
constexpr std::size_t kFewest = 3;

bool makes_covalent_bonds(const Atom& atom) {
  return atom.element != 0 && !gemmi::is_metal(gemmi::Element(int{atom.element}).elem);
}

double longest(const Atom& a, const Atom& b) {
  constexpr double kStretch = 1.3;  // vibrations reach 1.15, second neighbours begin at 1.5
  const auto radius = [](const Atom& atom) { return double{gemmi::Element(int{atom.element}).covalent_r()}; };
  return kStretch * (radius(a) + radius(b));
}

std::vector<bool> residues_of(std::span<const Atom> atoms) {
  std::vector<bool> residues;
  for (const Atom& atom : atoms) {
    if (atom.residue >= residues.size()) residues.resize(atom.residue + std::size_t{1});
    residues[atom.residue] = true;
  }
  return residues;
}

/// Returns the bonds of the standard residues among these residues.
std::vector<Bond> standard_bonds(std::span<const Atom> atoms, const std::vector<bool>& residues) {
  std::vector<Atom> part;
  std::vector<std::uint32_t> place;
  std::vector<glm::dvec3> positions;
  for (std::uint32_t n = 0; n < atoms.size(); ++n) {
    if (atoms[n].residue >= residues.size() || !residues[atoms[n].residue]) continue;
    part.push_back(atoms[n]);
    place.push_back(n);
    positions.push_back(atoms[n].position);
  }
  std::vector<Bond> bonds = template_bonds(part, positions, std::nullopt);
  for (auto& [a, b] : bonds) {
    a = place[a];
    b = place[b];
  }
  return bonds;
}

/// Returns the bonds whose lengths can be compared with the frame.
std::vector<Bond> comparable_bonds(const Topology& topology, std::span<const Atom> used, bool has_positions) {
  const std::vector<Atom>& atoms = topology.atoms;
  const std::vector<bool> residues = residues_of(used);
  const auto wanted = [&](const Atom& atom) { return atom.residue < residues.size() && residues[atom.residue]; };
  std::vector<Bond> bonds = topology.bonds;
  if (has_positions) {
    const std::vector<Bond> standard = standard_bonds(atoms, residues);
    bonds.insert(bonds.end(), standard.begin(), standard.end());
  }
  std::erase_if(bonds, [&](const Bond& bond) {
    const Atom &a = atoms[bond[0]], &b = atoms[bond[1]];
    if (!wanted(a) || !wanted(b)) return true;
    if (!makes_covalent_bonds(a) || !makes_covalent_bonds(b) || (a.element == 1 && b.element == 1)) return true;
    if (!has_positions) return false;
    const double distance = glm::distance(a.position, b.position);
    return distance < kShortest || distance > longest(a, b);
  });
  return bonds;
}

class FrameDistances {
 public:
  explicit FrameDistances(const Frame& frame) : positions_(frame.positions) {
    if (frame.cell) cell_ = PeriodicCell::of(*frame.cell);
    if (cell_ || positions_.empty()) return;
    glm::dvec3 low = positions_.front(), high = low;
    for (const glm::dvec3& x : positions_) {
      low = glm::min(low, x);
      high = glm::max(high, x);
    }
    shortest_jump_ = glm::max(0.5 * (high - low), glm::dvec3(kShortestJump));
  }

  /// Returns the distance (Å) of two atoms, or nothing if they may be on two sides of a box that the frame lacks.
  std::optional<double> between(std::uint32_t a, std::uint32_t b) const {
    const glm::dvec3 d = positions_[a] - positions_[b];
    if (cell_) return glm::length(cell_->shortest(d));
    if (glm::any(glm::greaterThan(glm::abs(d), shortest_jump_))) return std::nullopt;
    return glm::length(d);
  }

 private:
  const std::vector<glm::dvec3>& positions_;
  std::optional<PeriodicCell> cell_;
  glm::dvec3 shortest_jump_{0.0};  ///< Å, along each axis; a longer distance may be a jump across a box
};

struct Count {
  std::size_t bonds = 0, too_long = 0;
  void add(bool is_too_long) {
    ++bonds;
    too_long += is_too_long ? 1 : 0;
  }
  bool exceeds(std::size_t part) const { return too_long >= kFewest && too_long * part >= bonds; }
};

}  // namespace

void check_atom_order(const Topology& topology, std::span<const Atom> used, const Frame& frame,
                      const ComparedFrame& compared) {
  const FrameDistances distances(frame);
  Count all;
  std::unordered_map<std::uint32_t, Count> residues;
  std::string first;
  for (const auto& [a, b] : comparable_bonds(topology, used, compared.file_has_positions)) {
    const Atom &one = topology.atoms[a], &other = topology.atoms[b];
    const std::optional<double> distance = distances.between(a, b);
    if (!distance) continue;
    const bool too_long = *distance > longest(one, other);
    all.add(too_long);
    residues[one.residue].add(too_long);
    if (other.residue != one.residue) residues[other.residue].add(too_long);
    if (too_long && first.empty())
      first = fmt::format("{} to {} is {:.2f} Å", label_of(one), label_of(other), *distance);
  }
  const auto scattered = std::ranges::count_if(residues, [](const auto& entry) { return entry.second.exceeds(3); });
  if (scattered == 0 && !all.exceeds(10)) return;
  throw InputError(
      compared.trajectory, 0,
      message("frame {}: {} of {} bonds of {} are too long (first: {}); its atoms are in another order, or are "
              "different atoms; write both files from the same atoms, or add @trust-atom-order@ if molecules may come "
              "apart like this",
              compared.number, with_thousands(all.too_long), with_thousands(all.bonds), compared.file, first));
}

}  // namespace meniscus
