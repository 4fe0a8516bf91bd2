// SPDX-License-Identifier: BSD-3-Clause
// Frames of a run as they are shown: their atoms, their cameras, and the range of their colours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/camera/view_request.h"
#include "core/color/color_schemes.h"
#include "core/math/box.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/open_book.h"
#include "core/structure/selection/selection.h"
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

/// How the camera moves over a run.
struct CameraMotionRequest {
  std::string path_file;  ///< empty: one camera, of a file or framing all frames
  double turns = 0.0;     ///< about the camera's up axis through the middle of what is framed, over the run
  std::optional<Selection> follow;

  bool moves() const { return !path_file.empty() || turns != 0.0 || follow.has_value(); }
};

/// The cameras that files give to a run.
struct GivenCameras {
  std::optional<Camera> still;
  std::optional<CameraPath> path;

  bool any() const { return still || path; }
};

/// Boxes around all atoms at all frames, Å.
struct RunExtent {
  Box surface;  ///< those of the surface
  Box shown;    ///< and those beside it
};

/// Those of the files that are named. Ask for them before anything is read or computed. Throws InputError.
GivenCameras given_cameras(const ViewRequest& view, const CameraMotionRequest& motion);

/// A camera for each frame of the run, by its place. Without a camera from a file, and where it is asked to fill the
/// picture with some atoms, all frames are read once, so that these are seen in every frame. extent: is found in the
/// same pass; nullptr: not asked for. Throws InputError, RequestError, and what opening an interface throws.
std::vector<Camera> run_cameras(const ViewRequest& view, const CameraMotionRequest& motion, const GivenCameras& given,
                                ShownFrames& frames, RunExtent* extent = nullptr);

struct RunFraming {
  std::vector<Camera> cameras;  ///< one, or one a frame if it moves
  RunExtent extent;

  /// Where coordinates of scenes begin, Å, to three decimals.
  glm::dvec3 origin() const;
};

/// Reads all frames of the run once. Throws what run_cameras throws.
RunFraming run_framing(const ViewRequest& view, const CameraMotionRequest& motion, const GivenCameras& given,
                       ShownFrames& frames);

/// Takes from all frames of the run what its colours mean in each of them: fluctuations, and one range of numbers that
/// change with the places of atoms. Reads the run again for each scheme that needs it. Throws what fluctuations throws.
void measure_colors(ColorScheme& color, ShownFrames& frames);

/// FrameRun::reach() with the number of the first frame, of which a file may have numbers.
Structure numbered_reach(const FrameRun& frames);

/// All colours that a frame of the run may have, in the order of the atoms; of components all there are. Of schemes
/// that do not change with the frames.
std::vector<glm::vec3> run_colors(const Structure& structure, const ColorScheme& scheme, const Coloring& beside = {});

}  // namespace meniscus
