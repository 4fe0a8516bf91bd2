// SPDX-License-Identifier: BSD-3-Clause
// Turns a request into prepared frames.
#include "core/scene/frame_run.h"

#include <charconv>
#include <iterator>
#include <unordered_set>

#include "core/structure/bonds.h"
#include "core/trajectory/frame_list.h"

namespace meniscus {
namespace {

void check_options(const MoleculeRequest& molecule, const RunRequest& request) {
  if (molecule.reading.model.all || molecule.reading.model.number != 1)
    throw RequestError(
        message("@model@ and @frames@: the models of a file are its frames, counted from 0; leave @model@ out"));
  if (request.trajectories.empty() && request.trajectory_atoms)
    throw RequestError(message("@trajectory-atoms@ selects the atoms that a trajectory has; add @trajectory FILE@"));
  if (request.trajectories.empty() && molecule.file == "-")
    throw RequestError("standard input is read once, so it has no frames; save it as a file");
  if (request.smooth % 2 == 0) throw RequestError(message("@smooth {}@: give an odd number of frames", request.smooth));
  if (request.select_once && !molecule.reading.added.empty())
    throw RequestError(
        message("@select-once@ and @add@: frames have the atoms of the first file only; leave one of them out"));
}

/// Returns a time in ps if the text is a number with a unit: "fs", "ps", "ns" or "us"; else nothing.
std::optional<double> time_of(std::string_view text) {
  constexpr std::pair<std::string_view, double> kUnits[] = {{"fs", 1e-3}, {"ps", 1.0}, {"ns", 1e3}, {"us", 1e6}};
  for (const auto& [unit, ps] : kUnits) {
    if (!text.ends_with(unit)) continue;
    const std::string_view number = text.substr(0, text.size() - unit.size());
    double value = 0.0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error == std::errc() && end == number.data() + number.size()) return value * ps;
  }
  return {};
}

/// A bound of a run, given as a frame or as a time.
class Bound {
 public:
  Bound(const std::string& option, const std::string& text, Trajectory& trajectory)
      : option_(option), text_(text), trajectory_(trajectory), time_(time_of(text)) {
    if (time_) {
      if (trajectory.frame_count() > 1) tolerance_ = kPartOfStep * std::abs(time_at(1) - time_at(0));
      return;
    }
    // A number may lie after the last frame; then no frame is left, or all are.
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), frame_);
    if (error == std::errc() && end == text.data() + text.size()) return;
    try {
      frame_ = parse_frame(option, text, trajectory.frame_count());
    } catch (const RequestError&) {
      throw RequestError(
          "{}: {} is neither a frame such as 100, -10 or last, nor a time such as 300ps; there are {} "
          "frames",
          option, in_quotes(text), with_thousands(trajectory.frame_count()));
    }
  }

  /// Returns less than 0 if the frame is before the bound, 0 if it is at the bound, more if it is after it.
  double compare(std::uint64_t number) const {
    if (!time_) return static_cast<double>(number) - static_cast<double>(frame_);
    const double difference = time_at(number) - *time_;
    return std::abs(difference) <= tolerance_ ? 0.0 : difference;
  }

 private:
  /// The tolerance of times as a part of the step between frames: times in files are rounded, and no user gives a time
  /// this close to another frame.
  static constexpr double kPartOfStep = 1e-3;

  double time_at(std::uint64_t number) const {
    Frame frame;
    trajectory_.read(number, frame);
    if (!frame.time)
      throw RequestError("{} {}: the frames of {} have no times; give a frame", option_, text_, trajectory_.path());
    return *frame.time;
  }

  std::string option_;
  std::string text_;
  Trajectory& trajectory_;
  std::optional<double> time_;  // ps
  double tolerance_ = 0.0;      // ps
  std::uint64_t frame_ = 0;
};

/// True if the positions of atoms decide which atoms a frame has, or how atoms are drawn in addition to the surface.
bool chooses_by_positions(const MoleculeRequest& molecule, const RunRequest& request) {
  const auto asks = [](const std::optional<Selection>& selection) { return selection && selection->uses_positions(); };
  const ReadOptions& reading = molecule.reading;
  return reading.secondary_structure || !reading.added.empty() || asks(reading.selection) || asks(request.context) ||
         std::ranges::any_of(reading.shown, [](const ShownAtoms& shown) { return shown.atoms.uses_positions(); }) ||
         std::ranges::any_of(reading.radii.overrides,
                             [](const RadiusOverride& radius) { return radius.atoms.uses_positions(); });
}

/// Returns the atoms that are moved by frames: all but the atoms of added files.
std::vector<Atom> without_added(const std::vector<Atom>& atoms, const Topology& topology) {
  std::vector<Atom> own;
  std::ranges::copy_if(atoms, std::back_inserter(own),
                       [&](const Atom& atom) { return atom.index < topology.atoms.size(); });
  return own;
}

/// Adds the atoms from which selections measure distances.
void add_measured(const Selection& selection, const std::vector<Atom>& atoms, std::vector<std::uint32_t>& places) {
  if (!selection.uses_positions()) return;
  const std::vector<bool> measured = selection.possible(atoms).measured;
  for (std::uint32_t n = 0; n < atoms.size(); ++n)
    if (measured[n]) places.push_back(n);
}

std::vector<std::uint32_t> chosen(const Selection& selection, const std::vector<Atom>& atoms, const char* option,
                                  std::size_t least) {
  std::vector<std::uint32_t> indices;
  const std::vector<bool> selected = selection.evaluate(atoms);
  for (std::uint32_t n = 0; n < atoms.size(); ++n)
    if (selected[n]) indices.push_back(n);
  if (indices.size() < least)
    throw RequestError("{}: selects {} of {} atoms; at least {} are needed",
                       option_name(fmt::format("{} {}", option, in_quotes(selection.text()))), indices.size(),
                       with_thousands(atoms.size()), least);
  return indices;
}

std::unique_ptr<Trajectory> open_all(const std::vector<std::string>& paths, const TrajectoryOptions& options) {
  if (paths.size() == 1) return open_trajectory(paths.front(), options);
  std::vector<std::unique_ptr<Trajectory>> parts;
  for (const std::string& path : paths) parts.push_back(open_trajectory(path, options));
  return std::make_unique<JoinedFrames>(std::move(parts));
}

std::uint64_t reference_of(const RunRequest& request, const Trajectory& trajectory) {
  return request.reference.empty() ? 0
                                   : parse_frame(option_name("reference"), request.reference, trajectory.frame_count());
}

}  // namespace

bool RunRequest::is_requested() const {
  return !trajectories.empty() || !frames.empty() || stride != 1 || repeat != 1 || !begin.empty() || !end.empty() ||
         interpolate != 1 || !only.empty();
}

FrameRun::FrameRun(const MoleculeRequest& molecule, const RunRequest& request, Velocities velocities)
    : copies_(std::max(request.repeat, request.interpolate)),
      interpolates_(request.interpolate > 1),
      velocities_(velocities) {
  check_options(molecule, request);
  TrajectoryOptions options{request.index_folder, {}, request.trust_atom_order};
  if (!request.trajectories.empty())
    options.atoms = [&] { return count_atoms(molecule.file, request.trajectory_atoms); };
  trajectory_ = open_all(request.trajectories.empty() ? std::vector{molecule.file} : request.trajectories, options);
  choose_frames(request);
  read_atoms(molecule, request);
  prepare(molecule, request);
  Frame frame;
  frames_->read(source(run_.front()), frame);
  structure_ = structure_at(frame, run_.front());
}

FrameRun::~FrameRun() = default;

/// Reads the atoms with the coordinates of their file, or of the first frame if the file has none. If atoms are
/// selected again in each frame, reads all that may be selected.
void FrameRun::read_atoms(const MoleculeRequest& molecule, const RunRequest& request) {
  MoleculeRequest reading = molecule;
  reading.reading.keep_topology = true;
  reading.reading.trajectory_atoms = request.trajectory_atoms;
  const bool copies_atoms = !molecule.reading.assembly.empty() && molecule.division.instances == InstanceMode::none;
  reading.reading.list_assemblies = copies_atoms;
  Frame first;
  if (!request.trajectories.empty()) {
    trajectory_->read(source(run_.front()), first);
    reading.reading.positions = first.positions;
  }
  atoms_change_ = reading.reading.selection && reading.reading.selection->uses_positions();
  if (!request.select_once && chooses_by_positions(reading, request)) {
    file_ = open_molecule(reading);
    structure_ = file_->possible_structure();
    if (request.context) file_together_ = open_molecule(with_context(reading, *request.context));
    if (request.context) together_ = file_together_->possible_structure();
  } else {
    structure_ = read_molecule(reading);
    if (request.context) together_ = read_molecule(with_context(reading, *request.context));
  }
  if (copies_atoms) assembly_ = find_assembly(structure_.assemblies, molecule.reading.assembly, structure_.file);
  const std::size_t atoms = structure_.topology->atoms.size();
  if (atoms != trajectory_->atom_count())
    throw InputError(trajectory_->path(), 0, "its frames have {} atoms, but {} has {}: {}",
                     with_thousands(trajectory_->atom_count()), structure_.file, with_thousands(atoms),
                     advice_on_count(structure_.topology->atoms, trajectory_->atom_count()));
  if (!request.trajectories.empty() && !request.trust_atom_order)
    check_atom_order(
        *structure_.topology, without_added(structure_.atoms, *structure_.topology), first,
        {structure_.file, !structure_.topology->without_positions, trajectory_->path(), source(run_.front())});
}

void FrameRun::choose_frames(const RunRequest& request) {
  run_ = parse_frame_list(option_name("frames"), request.frames.empty() ? "all" : request.frames,
                          trajectory_->frame_count());
  const auto keep = [this](const std::string& option, const std::string& text, int side) {
    if (text.empty()) return;
    const Bound bound(option, text, *trajectory_);
    std::erase_if(run_, [&](std::uint64_t number) { return side * bound.compare(number) < 0.0; });
  };
  keep(option_name("begin"), request.begin, 1);
  keep(option_name("end"), request.end, -1);
  if (run_.empty()) throw RequestError(message("no frame is left between @begin@ and @end@"));
  for (std::size_t n = 0; n * request.stride < run_.size(); ++n) run_[n] = run_[n * request.stride];
  run_.resize((run_.size() + request.stride - 1) / request.stride);
  multiply();
  for (std::uint64_t place = 0; place < run_.size(); ++place) place_.try_emplace(run_[place], place);
  if (request.only.empty()) {
    chunk_ = run_;
    return;
  }
  const std::unordered_set<std::uint64_t> members(run_.begin(), run_.end());
  chunk_ = parse_frame_list(option_name("only"), request.only, trajectory_->frame_count() * copies_);
  for (const std::uint64_t number : chunk_)
    if (!members.contains(number)) throw RequestError(message("@only@: frame {} is not in the run", number));
}

/// Replaces each frame by `copies_` frames. If frames are interpolated, the last frame is not multiplied.
void FrameRun::multiply() {
  if (copies_ == 1) return;
  if (run_.size() > kMostListedFrames / copies_)
    throw RequestError("{}: makes more than {} frames",
                       option_name(fmt::format("{} {}", interpolates_ ? "interpolate" : "repeat", copies_)),
                       with_thousands(kMostListedFrames));
  if (interpolates_ && std::unordered_set<std::uint64_t>(run_.begin(), run_.end()).size() < run_.size())
    throw RequestError(
        message("@interpolate@: @frames@ names a frame twice, so the next one is not known; name each once"));
  std::vector<std::uint64_t> multiplied;
  for (const std::uint64_t number : run_)
    for (std::uint64_t n = 0; n < copies_; ++n) multiplied.push_back(number * copies_ + n);
  if (interpolates_) multiplied.resize(multiplied.size() - (copies_ - 1));
  run_ = std::move(multiplied);
}

/// Reads a frame of the run, which may lie between two frames of the trajectory.
void FrameRun::read(std::uint64_t number, Frame& frame) {
  const std::uint64_t step = number % copies_;
  if (!interpolates_ || step == 0) return frames_->read(source(number), frame);
  const std::uint64_t place = place_.at(number - step);
  const std::uint64_t next = place + copies_;
  BetweenFrames between{{}, source(run_[place]), source(run_[next]), {}, 0.0};
  between.share = static_cast<double>(step) / static_cast<double>(copies_);
  for (std::uint64_t k = copies_; k <= kPathNeighbors * copies_; k += copies_) {
    if (k <= place) between.before.push_back(source(run_[place - k]));
    if (next + k < run_.size()) between.after.push_back(source(run_[next + k]));
  }
  frames_->read_between(between, frame);
}

void FrameRun::prepare(const MoleculeRequest& molecule, const RunRequest& request) {
  const Topology& topology = *structure_.topology;
  Preparation preparation;
  preparation.reference = reference_of(request, *trajectory_);
  preparation.smooth_half = request.smooth / 2;
  if (request.superpose) preparation.superposed = chosen(*request.superpose, topology.atoms, "superpose", 3);
  if (request.center) preparation.centered = chosen(*request.center, topology.atoms, "center", 1);
  std::vector<std::uint32_t> own;  // atoms with a part in surfaces, and atoms drawn in addition to surfaces
  const auto add_own = [&](const std::vector<Atom>& atoms) {
    for (const Atom& atom : without_added(atoms, topology)) own.push_back(atom.index);
  };
  add_own(structure_.atoms);
  add_own(structure_.extra_atoms);
  if (together_) add_own(together_->atoms);
  std::vector<Bond> bonds;
  if (request.whole != WholeBy::nothing || interpolates_) bonds = known_bonds(request.whole);
  if (request.whole != WholeBy::nothing) {
    std::vector<std::uint32_t> wanted = preparation.superposed;
    wanted.insert(wanted.end(), preparation.centered.begin(), preparation.centered.end());
    wanted.insert(wanted.end(), own.begin(), own.end());
    if (molecule.reading.selection) add_measured(*molecule.reading.selection, topology.atoms, wanted);
    if (request.context) add_measured(*request.context, topology.atoms, wanted);
    for (const ShownAtoms& shown : molecule.reading.shown) add_measured(shown.atoms, topology.atoms, wanted);
    preparation.whole.emplace(topology.atoms, bonds, wanted, molecule.file);
  }
  if (interpolates_) {
    preparation.bonds.emplace(topology.atoms.size(), bonds, own);
    preparation.followed = std::move(own);
  }
  frames_ = std::make_unique<PreparedFrames>(*trajectory_, std::move(preparation));
}

/// Returns the bonds of the file together with the bonds of standard residues or, if bonds are guessed, of atoms that
/// are near each other in the first frame of the run.
std::vector<Bond> FrameRun::known_bonds(WholeBy by) const {
  const Topology& topology = *structure_.topology;
  Frame frame;
  trajectory_->read(source(run_.front()), frame);
  const std::optional<PeriodicCell> cell = frame.cell ? PeriodicCell::of(*frame.cell) : std::nullopt;
  std::vector<Bond> bonds = by == WholeBy::guess ? guessed_bonds(topology.atoms, frame.positions, cell)
                                                 : template_bonds(topology.atoms, frame.positions, cell);
  bonds.insert(bonds.end(), topology.bonds.begin(), topology.bonds.end());
  return bonds;
}

/// Returns the position of an atom, which may be an atom of a copy.
glm::dvec3 FrameRun::position_of(const Atom& atom, const std::vector<glm::dvec3>& positions) const {
  const glm::dvec3& position = positions[atom.index];
  return assembly_ ? copy_motion(*assembly_, atom)(position) : position;
}

void FrameRun::place(const std::vector<glm::dvec3>& positions, Structure& structure) const {
  for (Atom& atom : structure.atoms) atom.position = position_of(atom, positions);
  for (Atom& atom : structure.extra_atoms) atom.position = position_of(atom, positions);
}

Structure FrameRun::structure_at(const Frame& frame, std::uint64_t number) const {
  Structure structure = file_ ? file_->at(frame.positions) : structure_;
  if (!file_) place(frame.positions, structure);
  structure.frame = source(number);
  return structure;
}

std::vector<Atom> FrameRun::all_atoms() {
  Frame frame;
  frames_->read(source(run_.front()), frame);
  std::vector<Atom> atoms = structure_.topology->atoms;
  for (std::size_t n = 0; n < atoms.size(); ++n) atoms[n].position = frame.positions[n];
  return atoms;
}

std::vector<glm::dvec3> FrameRun::positions(std::uint64_t number) {
  Frame frame;
  read(number, frame);
  std::vector<glm::dvec3> positions;
  if (file_) {
    for (const Atom& atom : file_->at(frame.positions).atoms) positions.push_back(atom.position);
  } else {
    for (const Atom& atom : structure_.atoms) positions.push_back(position_of(atom, frame.positions));
  }
  return positions;
}

std::optional<double> FrameRun::last_time() {
  Frame frame;
  try {
    trajectory_->read(source(run_.back()), frame);
  } catch (const InputError&) {
    return std::nullopt;  // the code that makes this frame reports the error
  }
  return frame.time;
}

Structure FrameRun::at(std::uint64_t number) {
  Frame frame;
  read(number, frame);
  return structure_at(frame, number);
}

void FrameRun::survey(const std::function<void(std::uint64_t, const Structure&)>& look) {
  Structure structure = structure_;
  Frame frame;
  for (std::uint64_t number = 0; number < run_.size(); ++number) {
    try {
      read(run_[number], frame);
      if (file_)
        structure = structure_at(frame, run_[number]);
      else
        place(frame.positions, structure);
    } catch (const InputError&) {
      continue;  // the code that makes this frame reports the error
    }
    look(number, structure);
  }
}

/// Computes the differences that Velocities names, Å per frame of the run. Unreadable frames count as missing.
void FrameRun::read_velocities(ReadFrame& into) {
  const std::uint64_t place = place_.at(into.number);
  double steps = 0.0;
  // A damaged neighbour is an error of its own frame, not of this one.
  const auto read_neighbor = [&](std::uint64_t neighbor, Frame& frame) {
    try {
      if (neighbor >= run_.size()) return read(into.number, frame);  // no frame is before the first or after the last
      read(run_[neighbor], frame);
      steps += 1.0;
    } catch (const InputError&) {
      read(into.number, frame);
    }
  };
  Frame first, last;
  if (velocities_ == Velocities::forward)
    read(into.number, first);
  else
    read_neighbor(place - 1, first);
  read_neighbor(place + 1, last);
  into.velocities.resize(first.positions.size());
  for (std::size_t a = 0; a < into.velocities.size(); ++a)
    into.velocities[a] = (last.positions[a] - first.positions[a]) / std::max(1.0, steps);
}

std::optional<RunFrame> FrameRun::next() {
  if (taken_ == chunk_.size()) return {};
  if (!ahead_) {
    ahead_ = std::make_unique<ReadAhead>(
        [this](ReadFrame& ahead) {
          read(ahead.number, ahead.frame);
          if (velocities_ != Velocities::none) read_velocities(ahead);
        },
        chunk_);
  }
  std::optional<ReadFrame> read = ahead_->next();
  ++taken_;
  if (read->error) std::rethrow_exception(read->error);
  RunFrame frame;
  frame.number = read->number;
  frame.source = source(read->number);
  frame.place = place_.at(read->number);
  frame.time = read->frame.time;
  frame.structure = structure_at(read->frame, read->number);
  if (file_together_) {
    frame.together = file_together_->at(read->frame.positions);
  } else if (together_) {
    frame.together = *together_;
    place(read->frame.positions, frame.together);
  }
  if (velocities_ == Velocities::none) return frame;
  for (const Atom& atom : shown_atoms(frame.structure)) {
    const bool moves = atom.index < read->velocities.size();  // atoms of added files do not move
    const glm::dvec3 velocity = moves ? read->velocities[atom.index] : glm::dvec3(0.0);
    frame.velocities.push_back(assembly_ ? copy_motion(*assembly_, atom).rotation * velocity : velocity);
  }
  return frame;
}

std::vector<double> fluctuations(FrameRun& run) {
  if (run.atoms_change())
    throw RequestError(
        message("@color rmsf@ needs the same atoms in all frames, but @select@ chooses others in each; add "
                "@select-once@ to keep those of the first"));
  const std::size_t count = run.structure().atoms.size();
  std::vector<glm::dvec3> mean(count, glm::dvec3(0.0));
  std::vector<double> squares(count, 0.0);  // sums of squared distances from the mean so far (Welford 1962)
  double frames = 0.0;
  run.survey([&](std::uint64_t, const Structure& structure) {
    frames += 1.0;
    for (std::size_t a = 0; a < count; ++a) {
      const glm::dvec3 step = structure.atoms[a].position - mean[a];
      mean[a] += step / frames;
      squares[a] += glm::dot(step, structure.atoms[a].position - mean[a]);
    }
  });
  if (frames == 0.0) throw InputError(run.structure().file, 0, "no frame of the run can be read");
  for (double& square : squares) square = std::sqrt(square / frames);
  return squares;
}

}  // namespace meniscus
