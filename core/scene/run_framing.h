// SPDX-License-Identifier: BSD-3-Clause
// The frames of a run as they are shown: their atoms, their cameras, and the range of their colours.
#pragma once

#include "core/camera/camera.h"
#include "core/camera/view_request.h"
#include "core/color/color_schemes.h"
#include "core/math/box.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// The shown frames of a run. The interface of a frame is measured when the frame is first needed; the motions of its
/// pages are kept.
class ShownFrames {
 public:
  /// Both must outlive this object. molecule: the request with which `frames` was opened.
  ShownFrames(const MoleculeRequest& molecule, FrameRun& frames) : molecule_(molecule), frames_(frames) {}

  const MoleculeRequest& molecule() const { return molecule_; }
  FrameRun& run() { return frames_; }

  /// Return the first frame of the run that can be shown: as it is read, and as it is shown, with the same atoms. Throw
  /// the error of the first frame if none can be shown.
  const Structure& first();
  const Structure& first_shown();

  /// Calls FrameRun::survey(), and skips frames that cannot be shown.
  using Look = std::function<void(std::uint64_t place, const Structure& read, const Structure& shown)>;
  void survey(const Look& look);

  /// Returns the largest buried area of an atom in any frame, Å².
  double most_buried();

 private:
  void find_first();
  void open(std::uint64_t place, Structure& structure, SurfaceComputer& computer);

  const MoleculeRequest& molecule_;
  FrameRun& frames_;
  std::vector<std::optional<OpenPages>> pages_;   ///< one for each place in the run
  std::optional<Structure> first_, first_shown_;  ///< set for an interface only
  double most_buried_ = 0.0;
};

/// The motion of the camera over a run.
struct CameraMotionRequest {
  std::string path_file;  ///< empty: one camera, from a file or framing all frames
  double turns = 0.0;     ///< turns during the run about the camera's up axis through the middle of the framed atoms
  std::optional<Selection> follow;

  bool moves() const { return !path_file.empty() || turns != 0.0 || follow.has_value(); }
};

/// The cameras of a run that are read from files.
struct GivenCameras {
  std::optional<Camera> still;     ///< a camera for all frames
  std::optional<CameraPath> path;  ///< a camera that moves

  bool any() const { return still || path; }
};

/// Boxes around all atoms at all frames, Å.
struct RunExtent {
  Box surface;  ///< around the atoms of the surface
  Box shown;    ///< around these and the atoms drawn in addition
};

/// Reads the cameras of the named files. Should be called before anything else is read or computed. Throws InputError.
GivenCameras given_cameras(const ViewRequest& view, const CameraMotionRequest& motion);

/// Returns a camera for each frame of the run, by its place. All frames are read once if no file gives a camera, or if
/// the camera must fill the picture with some atoms, so that these are visible in every frame. extent: found in the
/// same pass; nullptr: not needed. Throws InputError, RequestError, and the errors of opening an interface.
std::vector<Camera> run_cameras(const ViewRequest& view, const CameraMotionRequest& motion, const GivenCameras& given,
                                ShownFrames& frames, RunExtent* extent = nullptr);

/// The cameras of a run, and the boxes around its atoms.
struct RunFraming {
  std::vector<Camera> cameras;  ///< one, or one per frame if the camera moves
  RunExtent extent;

  /// Returns the origin of the coordinates of scenes, Å, rounded to three decimals.
  glm::dvec3 origin() const;
};

/// Returns the cameras and the extent of the run. Reads all its frames once. Throws what run_cameras() throws.
RunFraming run_framing(const ViewRequest& view, const CameraMotionRequest& motion, const GivenCameras& given,
                       ShownFrames& frames);

/// Completes the scheme by numbers that depend on all frames of the run: fluctuations, and one range for numbers that
/// change with the positions of atoms. Reads the run again for each scheme that needs it. Throws InputError if no frame
/// can be read, and RequestError if the atoms change from frame to frame (fluctuations).
void measure_colors(ColorScheme& color, ShownFrames& frames);

/// Returns FrameRun::possible_structure() with the number of the first frame, whose numbers a file may have.
Structure numbered_structure(const FrameRun& frames);

/// Returns all colours that a frame of the run may have, in the order of the atoms; for components, all their colours.
/// scheme: must not change with the frames. `extras`: the colours of everything drawn in addition to the surface.
std::vector<glm::vec3> run_colors(const Structure& structure, const ColorScheme& scheme, const Coloring& extras = {});

}  // namespace meniscus
