// SPDX-License-Identifier: BSD-3-Clause
// A run of frames of one molecule: atoms are chosen once, or anew in each frame where a selection depends on positions.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/scene/molecule.h"
#include "core/scene/representations.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"
#include "core/trajectory/prepared_frames.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {

/// Where the bonds come from along which molecules are made whole.
enum class WholeBy {
  nothing,  ///< molecules stay as they are
  bonds,    ///< those the file lists and those of standard residues
  guess     ///< those the file lists and all that distances suggest
};

/// Which frames of which trajectory, and how they are prepared.
struct RunRequest {
  std::vector<std::string> trajectories;      ///< in a row; none: the models of the molecule's file are the frames
  std::optional<Selection> trajectory_atoms;  ///< of the molecule's file, those that they have; nothing: all
  bool trust_atom_order = false;  ///< bonds of the first frame are not compared with those of the molecule's file
  std::string frames;             ///< as parse_frame_list reads it; empty: all
  std::uint64_t stride = 1;
  std::uint64_t repeat = 1;       ///< each frame chosen by these this often in a row
  std::uint64_t interpolate = 1;  ///< each as many: itself, and others on the way to the next
  std::string begin, end;         ///< a frame ("100", "-10", "last") or a time ("2.5ns", "300ps"); empty: no bound
  std::string only;               ///< the chunk of the run that is made; empty: all of it
  WholeBy whole = WholeBy::nothing;
  std::optional<Selection> superpose, center;
  std::string reference;     ///< a frame; empty: the first of the trajectory
  std::uint64_t smooth = 1;  ///< frames that a mean is taken over; odd

  bool select_once = false;  ///< selections that ask for positions mean what they do in the first frame of the run

  /// Atoms that are around the molecule's, which are those of its selection: RunFrame::together has both.
  std::optional<Selection> context;

  std::string index_folder;  ///< where indices of frames are kept; empty: nowhere

  /// Whether a run is requested.
  bool asked() const;
};

/// The molecule at one frame.
struct RunFrame {
  std::uint64_t number = 0;    ///< in the run (FrameRun::numbers), by which files are named
  std::uint64_t source = 0;    ///< in the trajectory, from 0
  std::uint64_t place = 0;     ///< in the run, from 0
  std::optional<double> time;  ///< ps
  Structure structure;
  Structure together;  ///< the same atoms and those of RunRequest::context, if it is asked for
  std::vector<glm::dvec3>
      velocities;  ///< per shown_atoms() of the structure, Å per frame of the run; only if asked for
};

/// What RunFrame::velocities are.
enum class Velocities {
  none,
  central,  ///< half of the difference between the frames before and after; at an end, the difference to the other
  forward   ///< the difference to the next frame; 0 at the end
};

class FrameRun {
 public:
  /// Opens and chooses the atoms. Selections are as they are: settle_selections comes before. Throws InputError,
  /// RequestError for what makes no sense together; texts name the options of the program.
  FrameRun(const MoleculeRequest& molecule, const RunRequest& request, Velocities velocities = Velocities::none);
  ~FrameRun();

  /// At the first frame of the run.
  const Structure& structure() const { return structure_; }
  /// The same with all atoms that any frame may have.
  const Structure& reach() const { return file_ ? file_->possible_structure() : structure_; }
  /// All atoms of the file, as they are there.
  std::vector<Atom> all_atoms();
  /// Whether the structures of two frames may have different atoms, or different ones beside them.
  bool chooses_anew() const { return file_ != nullptr; }
  /// Whether their surfaces may be of different atoms.
  bool atoms_change() const { return atoms_change_; }
  /// The frames of the run, and those of them that are to be made here, by their numbers: those in the trajectory. If
  /// each comes `repeat` times, `repeat` times that, and one more each time; likewise if there are others between them.
  const std::vector<std::uint64_t>& numbers() const { return run_; }
  const std::vector<std::uint64_t>& chunk() const { return chunk_; }
  /// The number in the trajectory of one of them, or of the frame before it.
  std::uint64_t source(std::uint64_t number) const { return number / copies_; }
  const Trajectory& trajectory() const { return *trajectory_; }
  /// Of the last frame of the run, ps; nothing if it has none or cannot be read. Not together with next().
  std::optional<double> last_time();

  /// Reads every frame of the run, without its surface, before any is made: place in the run, and the structure. What a
  /// camera for all of them needs. A frame that cannot be read is passed over here.
  void survey(const std::function<void(std::uint64_t place, const Structure& structure)>& look);

  /// Where the atoms of the structure are at a frame of the run, if they do not change; not together with next().
  /// Throws InputError.
  std::vector<glm::dvec3> positions(std::uint64_t number);

  /// The structure there, with what is shown beside the surface. Likewise.
  Structure at(std::uint64_t number);

  /// The next frame of the chunk; nothing after the last. Throws what reading it threw: then next() can be called
  /// again for the one behind it.
  std::optional<RunFrame> next();

 private:
  void choose_frames(const RunRequest& request);
  void multiply();
  void read(std::uint64_t number, Frame& frame);
  void read_velocities(ReadFrame& read);
  void read_atoms(const MoleculeRequest& molecule, const RunRequest& request);
  void prepare(const MoleculeRequest& molecule, const RunRequest& request);
  std::vector<Bond> known_bonds(WholeBy by) const;
  glm::dvec3 position_of(const Atom& atom, const std::vector<glm::dvec3>& positions) const;
  void place(const std::vector<glm::dvec3>& positions, Structure& structure) const;
  Structure structure_at(const Frame& frame, std::uint64_t number) const;

  std::unique_ptr<Trajectory> trajectory_;
  std::unique_ptr<PreparedFrames> frames_;
  std::unique_ptr<ReadAhead> ahead_;
  std::unique_ptr<StructureFile> file_, file_together_;  ///< if atoms are chosen again in each frame
  Structure structure_;
  std::optional<Structure> together_;
  std::optional<Assembly> assembly_;  ///< that the atoms are copied by
  std::vector<std::uint64_t> run_, chunk_;
  std::unordered_map<std::uint64_t, std::uint64_t> place_;  ///< in the run, by number
  std::size_t taken_ = 0;
  std::uint64_t copies_;  ///< RunRequest::repeat or interpolate, which is larger than 1
  bool interpolates_;
  Velocities velocities_;
  bool atoms_change_ = false;
};

/// Of each atom of the structure the root mean square distance from its mean place over the frames of the run, Å; they
/// are as --superpose and the like leave them. Throws InputError if no frame can be read, RequestError if the atoms
/// change.
std::vector<double> fluctuations(FrameRun& run);

}  // namespace meniscus
