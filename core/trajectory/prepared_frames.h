// SPDX-License-Identifier: BSD-3-Clause
// Preparation of frames: checking the order of atoms, making molecules whole, centring, superposing, smoothing, and
// reading ahead on a thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "core/structure/structure.h"
#include "core/trajectory/morph.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {

/// Makes molecules whole that a periodic box has cut.
class WholeMolecules {
 public:
  /// Finds the molecules, which are the atoms that bonds connect. Only those with an atom in `wanted` are made whole.
  /// Throws InputError(file) if a residue of such a molecule falls apart because bonds are missing.
  WholeMolecules(std::span<const Atom> atoms, std::span<const Bond> bonds, std::span<const std::uint32_t> wanted,
                 const std::string& file);

  /// Moves atoms by lattice vectors, so that each molecule is connected by its bonds and its centre is as near as
  /// possible to the centre of the largest molecule. cell: vectors a, b, c in the columns, Å. Throws InputError(where)
  /// for a box without volume, and for a molecule that is bonded to its own image.
  void apply(const glm::dmat3& cell, std::vector<glm::dvec3>& positions, const std::string& where) const;

 private:
  /// An atom, and an earlier atom of its molecule that it is bonded to. For the first atom both are the same.
  struct Step {
    std::uint32_t atom, from;
  };

  std::vector<Step> steps_;  ///< molecule after molecule, each atom after the one that it is bonded to
  /// First step of each molecule, the largest first; the last entry is the number of steps.
  std::vector<std::size_t> begins_;
  std::vector<Bond> bonds_;  ///< bonds of these molecules
};

/// The changes of each frame, which are made in this order. Atoms are given by their place in the file.
struct Preparation {
  std::optional<WholeMolecules> whole;
  /// Atoms that are superposed on their positions in the reference frame, at least three. All other atoms move with
  /// them. Empty: no superposition.
  std::vector<std::uint32_t> superposed;
  /// Atoms whose mean position is moved to where it is in the reference frame, without rotation. Empty: no centring.
  std::vector<std::uint32_t> centered;
  std::uint64_t reference = 0;  ///< number of a frame of the trajectory
  /// Each position becomes the mean over so many frames before and after. Beyond the ends of the trajectory its frames
  /// are reflected in its first and last frame. So these two frames stay as they are, and steps near them are as smooth
  /// as others.
  std::uint64_t smooth_half = 0;
  /// Atoms that read_between() follows from frame to frame, and their bonds.
  std::vector<std::uint32_t> followed;
  std::optional<BondNetwork> bonds;
};

/// The number of frames before and after two frames that the path between these two depends on.
inline constexpr std::size_t kPathNeighbors = 3;

/// A place between two frames, and the frames around them. Frames are given by their numbers in the trajectory.
struct BetweenFrames {
  std::vector<std::uint64_t>
      before;  ///< the nearest first; kPathNeighbors of them, or fewer at the beginning of the run
  std::uint64_t from = 0, to = 0;
  std::vector<std::uint64_t> after;  ///< the nearest first; kPathNeighbors of them, or fewer at the end of the run
  double share = 0.0;                ///< share of the path from `from` to `to`, in (0, 1)
};

/// Reads frames of a trajectory and prepares them. A prepared frame depends on the trajectory and its number only, not
/// on what was read before, so that processes that share a run make equal frames.
class PreparedFrames {
 public:
  /// Reads the reference frame if it is needed. `trajectory` must outlive this object. Throws as read() does.
  PreparedFrames(Trajectory& trajectory, Preparation preparation);

  /// Reads a frame and prepares it. Throws InputError with the number of the frame if Trajectory::read throws, if
  /// molecules are to be made whole and the box is missing or flat, or if a molecule is bonded to its own image.
  void read(std::uint64_t number, Frame& frame);

  /// Reads positions on a path through all frames, which are equally spaced. The path consists of polynomials of degree
  /// five with continuous acceleration. Its speeds and accelerations at frames are chosen so that atoms are on average
  /// as fast there as halfway, even if frames are independent of each other. Uniform motion stays uniform; parabolas
  /// and cubics are reproduced. Before the first frame and after the last one the path is continued on a straight line.
  /// The same holds where the next frame cannot be read or atoms jump on the way to it. The positions are then
  /// corrected by BondedPath. Time is interpolated linearly.
  /// Throws InputError as read() does, and for an atom of Preparation::followed that jumps across the periodic box
  /// between the two frames.
  void read_between(const BetweenFrames& place, Frame& frame);

 private:
  struct CachedFrame {
    std::uint64_t number;
    Frame frame;
  };
  void read_aligned(std::uint64_t number, Frame& frame);
  const Frame& aligned(std::uint64_t number);
  const BondedPath& path(const BetweenFrames& place, const Frame& from, const Frame& to);
  void refuse_jumps(std::uint64_t number, const Frame& from, std::uint64_t next, const Frame& to) const;

  Trajectory& trajectory_;
  Preparation preparation_;
  std::vector<glm::dvec3> reference_;  ///< Å, all atoms of the reference frame after they were made whole
  std::optional<BondedPath> path_;     ///< path between the two frames of path_ends_
  std::pair<std::uint64_t, std::uint64_t> path_ends_;
  std::deque<CachedFrame> cache_;  ///< aligned frames that smoothing and paths may need again
};

/// A frame, or the error of reading it.
struct ReadFrame {
  std::uint64_t number = 0;
  Frame frame;
  std::vector<glm::dvec3> velocities;  ///< Å per frame; empty unless the reader function computes them
  std::exception_ptr error;            ///< if set, the other members are not valid
};

/// Reads frames ahead on a thread of its own.
class ReadAhead {
 public:
  /// Starts a thread that calls `read` for each number in order, at most `depth` frames ahead of next().
  ReadAhead(std::function<void(ReadFrame&)> read, std::vector<std::uint64_t> numbers, std::size_t depth = 3);
  /// Ends the thread after the frame that is being read.
  ~ReadAhead();
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// Waits for the next frame and returns it; nothing after the last.
  std::optional<ReadFrame> next();

 private:
  void work();

  std::function<void(ReadFrame&)> read_;
  std::vector<std::uint64_t> numbers_;
  std::size_t depth_, taken_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ReadFrame> ready_;
  bool stop_ = false;
  std::thread thread_;
};

/// The frame that is compared, and the files that it belongs to.
struct ComparedFrame {
  const std::string& file;        ///< the structure file
  bool file_has_positions;        ///< true if the structure file has coordinates, in which bonds are found by distance
  const std::string& trajectory;  ///< the trajectory file
  std::uint64_t number;
};

/// Checks that bonds of the structure file, in residues with an atom in `used`, are short enough in the frame, which
/// has as many atoms. These bonds are the listed ones and, if the file has coordinates, the bonds of standard residues
/// that are short enough there. A bond is too long if it exceeds the sum of the covalent radii (B. Cordero et al.,
/// Dalton Trans. 2008, 2832) by three tenths. Distances are to the nearest image in the periodic box. In a frame
/// without a box, a bond that spans half of the frame's extent and 8 Å may be a jump across a box and does not count.
/// Metals, sites without element and bonds between hydrogens are ignored. Files without bonds (XYZ, beads) always pass,
/// because nothing is known about their order. Molecules or residues of the same kind may be exchanged without notice.
/// Throws InputError if three bonds and a third of the bonds of a residue, or three bonds and a tenth of all, are too
/// long.
void check_atom_order(const Topology& topology, std::span<const Atom> used, const Frame& frame,
                      const ComparedFrame& compared);

}  // namespace meniscus
