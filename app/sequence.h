// SPDX-License-Identifier: BSD-3-Clause
// A run of frames of one molecule: which atoms and radii is decided once, positions come frame by frame.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/options/molecule_options.h"
#include "app/options/sequence_options.h"
#include "core/structure/structure.h"
#include "core/trajectory/prepared_frames.h"
#include "core/trajectory/read_ahead.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {

/// Where frame indices are kept: beside other caches of the user, or nowhere.
std::string frame_index_folder();

/// The molecule at one frame.
struct SequenceFrame {
  std::uint64_t number = 0;    ///< in the trajectory, from 0
  std::uint64_t place = 0;     ///< in the run, from 0
  std::optional<double> time;  ///< ps
  Structure structure;
  std::vector<glm::dvec3> velocities;  ///< per atom of the structure, Å per frame of the trajectory; only if asked for
};

class Sequence {
 public:
  /// Opens, chooses the atoms and says on stderr what was read. velocities: frames shall have them. Throws InputError,
  /// RequestError for options that make no sense together.
  Sequence(const MoleculeOptions& molecule, const SequenceOptions& options, bool velocities = false);
  ~Sequence();

  /// At the first frame of the run.
  const Structure& structure() const { return structure_; }
  /// The frames of the run, and those of them that are to be made here, by their numbers in the trajectory.
  const std::vector<std::uint64_t>& run() const { return run_; }
  const std::vector<std::uint64_t>& share() const { return share_; }
  const Trajectory& trajectory() const { return *trajectory_; }

  /// Reads every frame of the run, without its surface, before any is made: place in the run, and the balls. What a
  /// camera for all of them needs. A frame that cannot be read is passed over here.
  void survey(const std::function<void(std::uint64_t place, std::span<const Ball> balls)>& look);

  /// Where the atoms of the structure stand at any frame of the trajectory; not together with next(). Throws
  /// InputError.
  std::vector<glm::dvec3> positions(std::uint64_t number);

  /// The next frame of the share; nothing behind the last. Throws what reading it threw: then next() can be called
  /// again for the one behind it.
  std::optional<SequenceFrame> next();
  /// The number of the frame that next() gives or throws about.
  std::uint64_t upcoming() const { return share_[taken_]; }

 private:
  void choose_frames(const SequenceOptions& options);
  void prepare(const MoleculeOptions& molecule, const SequenceOptions& options);
  void place(const std::vector<glm::dvec3>& positions, Structure& structure) const;

  std::unique_ptr<Trajectory> trajectory_;
  std::unique_ptr<PreparedFrames> frames_;
  std::unique_ptr<ReadAhead> ahead_;
  Structure structure_;
  std::vector<std::uint64_t> run_, share_;
  std::size_t taken_ = 0;
  bool velocities_;
};

}  // namespace meniscus
