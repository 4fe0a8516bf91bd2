// SPDX-License-Identifier: BSD-3-Clause
// A run of frames of one molecule. Atoms are selected once, or again in each frame if a selection depends on positions
// and is not frozen to the atoms of the first frame (--select-once).
#pragma once

#include "core/scene/molecule.h"
#include "core/scene/representations.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"
#include "core/trajectory/prepared_frames.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {

struct Scene;

/// The source of the bonds along which molecules are made whole.
enum class WholeBy {
  nothing,  ///< molecules stay as they are
  bonds,    ///< bonds that the file lists, and bonds of standard residues
  guess     ///< bonds that the file lists, and all bonds that distances suggest
};

/// The frames of a trajectory in a run, and their preparation.
struct RunRequest {
  std::vector<std::string> trajectories;      ///< joined in this order; empty: the models of the molecule's file
  std::optional<Selection> trajectory_atoms;  ///< atoms of the molecule's file that the trajectories have; nothing: all
  bool trust_atom_order = false;  ///< bonds of the first frame are not compared with bonds of the molecule's file
  std::string frames;             ///< a list for parse_frame_list; empty: all
  std::uint64_t stride = 1;
  std::uint64_t repeat = 1;       ///< number of times in a row that each selected frame is in the run
  std::uint64_t interpolate = 1;  ///< number of frames made from each: itself, and frames on the way to the next
  std::string begin, end;         ///< a frame ("100", "-10", "last") or a time ("2.5ns", "300ps"); empty: no bound
  std::string only;               ///< the chunk of the run that is made, as a list of frames; empty: all of it
  WholeBy whole = WholeBy::nothing;
  std::optional<Selection> superpose, center;
  std::string reference;     ///< a frame; empty: the first of the trajectory
  std::uint64_t smooth = 1;  ///< number of frames in a running mean; odd

  bool select_once = false;  ///< true: selections by position are evaluated once, in the first frame of the run

  /// Further atoms around the selected ones. RunFrame::together has both.
  std::optional<Selection> context;

  std::string index_folder;  ///< folder for indices of frames; empty: none are kept

  /// True if a run is requested.
  bool is_requested() const;
};

/// The molecule at one frame.
struct RunFrame {
  std::uint64_t number = 0;    ///< number in the run (FrameRun::numbers), by which files are named
  std::uint64_t source = 0;    ///< number in the trajectory, from 0
  std::uint64_t place = 0;     ///< place in the run, from 0
  std::optional<double> time;  ///< ps
  Structure structure;
  Structure together;  ///< the same atoms with the atoms of RunRequest::context; empty without a context
  std::vector<glm::dvec3>
      velocities;  ///< Å per frame of the run, per shown_atoms() of the structure; empty for Velocities::none
};

/// The kind of RunFrame::velocities.
enum class Velocities {
  none,
  central,  ///< half of the difference between the frames before and after; at an end, the difference between the end
            ///< and its neighbour
  forward   ///< the difference between the next frame and this one; 0 at the end
};

/// A run of frames of one molecule, which are read one after another.
class FrameRun {
 public:
  /// Opens the trajectory and selects the atoms. Selections are used as they are, so freeze_selections() must be called
  /// before. Throws InputError; RequestError for requests that exclude each other, whose texts name options of the
  /// program.
  FrameRun(const MoleculeRequest& molecule, const RunRequest& request, Velocities velocities = Velocities::none);
  ~FrameRun();

  /// Returns the structure at the first frame of the run.
  const Structure& structure() const { return structure_; }
  /// Returns the structure with all atoms that any frame may have.
  const Structure& possible_structure() const { return file_ ? file_->possible_structure() : structure_; }
  /// Returns all atoms of the file, with the file's positions.
  std::vector<Atom> all_atoms();
  /// True if the structures of two frames may have different atoms, drawn by the surface or in addition to it.
  bool selects_per_frame() const { return file_ != nullptr; }
  /// True if the surfaces of two frames may have different atoms.
  bool atoms_change() const { return atoms_change_; }
  /// Return the numbers of the frames of the run, and of the frames that are to be made here. A number is the place in
  /// the trajectory; with `repeat` or `interpolate` it is that place times their value, plus 0, 1, 2 and so on.
  const std::vector<std::uint64_t>& numbers() const { return run_; }
  const std::vector<std::uint64_t>& chunk() const { return chunk_; }
  /// Returns the place in the trajectory of a frame of the run or, for an interpolated frame, of the frame before it.
  std::uint64_t source(std::uint64_t number) const { return number / copies_; }
  const Trajectory& trajectory() const { return *trajectory_; }
  /// Returns the time of the last frame of the run, ps; nothing if it has none or cannot be read. Must not run at the
  /// same time as next().
  std::optional<double> last_time();

  /// Reads every frame of the run without making its surface, before any frame is made, and passes the place in the run
  /// and the structure to `look`. A camera for all frames needs this. Frames that cannot be read are skipped here.
  void survey(const std::function<void(std::uint64_t place, const Structure& structure)>& look);

  /// Returns the positions of the structure's atoms at a frame of the run, provided that atoms do not change. Must not
  /// run at the same time as next(). Throws InputError.
  std::vector<glm::dvec3> positions(std::uint64_t number);

  /// Returns the structure at a frame of the run, with the atoms that are drawn in addition to the surface. Must not
  /// run at the same time as next(). Throws InputError.
  Structure at(std::uint64_t number);

  /// Returns the next frame of the chunk; nothing after the last. Throws the error of reading the frame; then next()
  /// can be called again for the frame after it.
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
  std::unique_ptr<StructureFile> file_, file_together_;  ///< set if atoms are selected again in each frame
  Structure structure_;
  std::optional<Structure> together_;
  std::optional<Assembly> assembly_;  ///< the assembly by which atoms are copied
  std::vector<std::uint64_t> run_, chunk_;
  std::unordered_map<std::uint64_t, std::uint64_t> place_;  ///< place in the run by number
  std::size_t taken_ = 0;
  std::uint64_t copies_;  ///< the larger of RunRequest::repeat and interpolate
  bool interpolates_;
  Velocities velocities_;
  bool atoms_change_ = false;
};

/// Returns the root mean square distance of each atom of the structure from its mean place over the frames of the run,
/// Å. Positions are used after --superpose and other preparations. Throws InputError if no frame can be read,
/// RequestError if the atoms change.
std::vector<double> fluctuations(FrameRun& run);

/// If RunRequest::select_once is set, replaces all selections of the scene that depend on positions by the atoms that
/// they select in the first frame. Must be called before the scene is used. `of_atoms` are further selections, which
/// select atoms of the surface. Throws RequestError if no selection depends on positions; otherwise like FrameRun.
void freeze_selections(Scene& scene, const std::vector<Selection*>& of_atoms = {});

}  // namespace meniscus
