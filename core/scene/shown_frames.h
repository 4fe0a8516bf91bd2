// SPDX-License-Identifier: BSD-3-Clause
// The frames of a run as they are shown: with the sides of an interface opened.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/open_book.h"
#include "core/structure/structure.h"

namespace meniscus {

/// An interface is measured when its frame is first asked for; where its pages go is kept.
class ShownFrames {
 public:
  /// Both must live as long. molecule: as the frames were opened with it.
  ShownFrames(const MoleculeRequest& molecule, FrameRun& frames) : molecule_(molecule), frames_(frames) {}

  const MoleculeRequest& molecule() const { return molecule_; }
  FrameRun& run() { return frames_; }

  /// The first frame of the run that can be shown: as it is read, and as it is shown, with the same atoms. Throws why
  /// the first frame cannot, if none can.
  const Structure& first();
  const Structure& first_shown();

  /// FrameRun::survey(); a frame that cannot be shown is passed over.
  using Look = std::function<void(std::uint64_t place, const Structure& read, const Structure& shown)>;
  void survey(const Look& look);

  /// The most that is buried of an atom of any frame, Å².
  double most_buried();

 private:
  void find_first();
  void open(std::uint64_t place, Structure& structure, SurfaceComputer& computer);

  const MoleculeRequest& molecule_;
  FrameRun& frames_;
  std::vector<std::optional<OpenPages>> pages_;   ///< by place
  std::optional<Structure> first_, first_shown_;  ///< of an interface
  double most_buried_ = 0.0;
};

}  // namespace meniscus
