// SPDX-License-Identifier: BSD-3-Clause
// Prepared frames: molecules whole, centred, superposed and smoothed; and frames read ahead on a thread.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/structure/structure.h"
#include "core/trajectory/bonded_path.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {

class WholeMolecules {
 public:
  /// Molecules are what the bonds join; those with an atom in `wanted` are treated. Throws InputError(file) when a
  /// residue of theirs falls apart because bonds are missing.
  WholeMolecules(std::span<const Atom> atoms, std::span<const Bond> bonds, std::span<const std::uint32_t> wanted,
                 const std::string& file);

  /// Moves atoms by lattice vectors: each molecule is whole as it hangs together by its bonds, and its centre is as
  /// near as can be to the centre of the one with most atoms. cell: columns a, b, c, Å. Throws InputError(where) for a
  /// box without volume, and for a molecule that is bonded to its own image.
  void apply(const glm::dmat3& cell, std::vector<glm::dvec3>& positions, const std::string& where) const;

 private:
  /// An atom, and the one before it in its molecule that it is bonded to; itself for the first.
  struct Step {
    std::uint32_t atom, from;
  };

  std::vector<Step> steps_;          ///< molecule after molecule, each atom behind the one it hangs on
  std::vector<std::size_t> begins_;  ///< of the molecules in steps_, and its end; the largest comes first
  std::vector<Bond> bonds_;          ///< of these molecules
};

/// What is done to each frame, in this order. Atoms are given by their place in the file.
struct Preparation {
  std::optional<WholeMolecules> whole;
  /// Turned and moved onto where they are in the reference frame, and all others with them; empty: not. At least 3.
  std::vector<std::uint32_t> superposed;
  /// Moved, not turned, so that the mean of their positions stays where it is in the reference frame; empty: not.
  std::vector<std::uint32_t> centered;
  std::uint64_t reference = 0;  ///< a frame of the trajectory
  /// Each position becomes the mean over the frames from this many before to as many after. Beyond an end of the
  /// trajectory are the frames before it, reflected in the end: so the first and the last frame stay as they are, and
  /// steps near them are as even as others.
  std::uint64_t smooth_half = 0;
  /// For read_between(): atoms that are followed from frame to frame, and their bonds.
  std::vector<std::uint32_t> followed;
  std::optional<BondNetwork> bonds;
};

/// How many frames on each side of two a path between them depends on.
inline constexpr std::size_t kPathReach = 3;

/// A place between two frames, and the frames on both sides of these, by their numbers in the trajectory.
struct BetweenFrames {
  std::vector<std::uint64_t> before;  ///< kPathReach of them, or fewer where the run begins; the nearest first
  std::uint64_t from = 0, to = 0;
  std::vector<std::uint64_t> behind;  ///< likewise, to the end of the run
  double share = 0.0;                 ///< of the way from `from` to `to`, in (0, 1)
};

/// A prepared frame depends on the trajectory and its number only, not on what was read before: processes that share a
/// run make equal frames.
class PreparedFrames {
 public:
  /// `trajectory` must live as long. Throws as read does, for the reference frame.
  PreparedFrames(Trajectory& trajectory, Preparation preparation);

  /// Throws InputError naming the frame: what Trajectory::read throws, a missing or flat box where molecules are to be
  /// made whole, a molecule bonded to its own image.
  void read(std::uint64_t number, Frame& frame);

  /// Reads positions on a path through all frames, which have equal steps: polynomials of the fifth degree with
  /// continuous acceleration. Its speeds and accelerations at frames are such that on the average atoms are as fast
  /// there as halfway, also where frames are independent of each other. Uniform motion stays uniform, parabolas and
  /// cubics are kept. Before the first frame and behind the last one it goes on straight; so it does where a frame
  /// beyond cannot be read, or atoms jump on the way to it. Then it is corrected as by BondedPath. Time goes evenly.
  /// Throws InputError as read() does, and for an atom of Preparation::followed that jumps across the periodic box from
  /// one to the other.
  void read_between(const BetweenFrames& place, Frame& frame);

 private:
  struct Kept {
    std::uint64_t number;
    Frame frame;
  };
  void read_placed(std::uint64_t number, Frame& frame);
  const Frame& placed(std::uint64_t number);
  const BondedPath& path(const BetweenFrames& place, const Frame& from, const Frame& to);
  void refuse_jumps(std::uint64_t number, const Frame& from, std::uint64_t next, const Frame& to) const;

  Trajectory& trajectory_;
  Preparation preparation_;
  std::vector<glm::dvec3> reference_;  ///< all atoms of the reference frame, whole
  std::optional<BondedPath> path_;     ///< between the two frames that path_ends_ has
  std::pair<std::uint64_t, std::uint64_t> path_ends_;
  std::deque<Kept> kept_;  ///< placed frames that smoothing and paths will ask for again
};

/// A frame as it was read, or why it could not be.
struct ReadFrame {
  std::uint64_t number = 0;
  Frame frame;
  std::vector<glm::dvec3> velocities;  ///< Å per frame; empty unless the reader fills them in
  std::exception_ptr error;            ///< then the rest is worthless
};

class ReadAhead {
 public:
  /// Calls `read` for each number in order, on its thread, `depth` frames ahead at most.
  ReadAhead(std::function<void(ReadFrame&)> read, std::vector<std::uint64_t> numbers, std::size_t depth = 3);
  /// Waits for the frame that is being read.
  ~ReadAhead();
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// The next frame, as soon as it is there; nothing after the last.
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

}  // namespace meniscus
