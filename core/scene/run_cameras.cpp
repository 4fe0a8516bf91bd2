// SPDX-License-Identifier: BSD-3-Clause
// Computes the camera of each frame of a run.
#include "core/scene/run_cameras.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/message.h"
#include "core/camera/camera_json.h"
#include "core/base/error.h"
#include "core/scene/copied_atoms.h"
#include "core/scene/view_aim.h"

namespace meniscus {
namespace {

glm::dvec3 mean_center(std::span<const Ball> balls) {
  glm::dvec3 sum(0.0);
  for (const Ball& ball : balls) sum += ball.center;
  return sum / static_cast<double>(balls.size());
}

/// How the camera of each frame differs from the one it starts with.
class CameraCourse {
 public:
  /// pivot: what the camera turns about, Å.
  CameraCourse(const CameraMotionRequest& motion, ShownFrames& frames, const glm::dvec3& pivot)
      : motion_(motion), pivot_(pivot) {
    const FrameRun& run = frames.run();
    count_ = static_cast<double>(run.numbers().size());
    if (motion.turns != 0.0 && run.numbers().size() == 1)
      throw RequestError(
          message("@turntable@: the camera turns from frame to frame, but this run has one frame; add @repeat N@ to "
                  "show it N times"));
    if (!motion.follow) return;
    followed_ = followed_of(frames.first());
    start_ = mean_center(standing_balls(frames.first_shown(), followed_));
    follows_others_ = run.atoms_change() || motion.follow->uses_positions();
  }

  bool follows() const { return !followed_.empty(); }
  glm::dvec3 shift(const Structure& read, const Structure& shown) const {
    if (!follows()) return glm::dvec3(0.0);
    return mean_center(standing_balls(shown, follows_others_ ? followed_of(read) : followed_)) - start_;
  }
  double angle(std::uint64_t place) const {
    return 2.0 * std::numbers::pi * motion_.turns * static_cast<double>(place) / count_;
  }
  const glm::dvec3& pivot() const { return pivot_; }

 private:
  std::vector<bool> followed_of(const Structure& structure) const {
    std::vector<bool> followed = motion_.follow->evaluate(structure.atoms);
    if (std::ranges::find(followed, true) == followed.end())
      throw RequestError(message("@follow {}@: selects none of the {} atoms of the surface{}",
                                 in_quotes(motion_.follow->text()), with_thousands(followed.size()),
                                 structure.frame ? fmt::format(" in frame {}", *structure.frame) : ""));
    return followed;
  }

  const CameraMotionRequest& motion_;
  std::vector<bool> followed_;   // per atom; empty: the camera follows none
  bool follows_others_ = false;  // from frame to frame
  glm::dvec3 pivot_{0.0}, start_{0.0};
  double count_ = 1.0;
};

/// The balls as they are before the camera that moves with them.
std::vector<Ball> before_camera(std::span<const Ball> balls, const glm::dvec3& shift, const glm::dvec3& pivot,
                                const glm::dvec3& axis, double angle) {
  std::vector<Ball> seen(balls.begin(), balls.end());
  Camera carrier;  // its position is carried as a point
  for (Ball& ball : seen) {
    carrier.position = ball.center - shift;
    ball.center = turned(carrier, pivot, axis, -angle).position;
  }
  return seen;
}

/// Of a frame the balls that fill the picture, which may be others than in the first; none where nothing is shown.
std::vector<Ball> framed_there(const ViewRequest& view, const std::optional<Selection>& show, const Structure& read,
                               const Structure& shown) {
  try {
    return ViewAim(view, show, read).framed(shown);
  } catch (const InputError&) {
  } catch (const RequestError&) {
  }
  return {};
}

void include(const Structure& structure, RunExtent& extent) {
  const auto include_ball = [](const Ball& ball, Box& box) {
    box.include(ball.center - ball.radius);
    box.include(ball.center + ball.radius);
  };
  for (const Ball& ball : standing_balls(structure))
    for (Box* const box : {&extent.surface, &extent.shown}) include_ball(ball, *box);
  for (const Atom& atom : structure.extra_atoms) include_ball({atom.position, atom.radius}, extent.shown);
}

}  // namespace

GivenCameras given_cameras(const ViewRequest& view, const CameraMotionRequest& motion) {
  GivenCameras given;
  given.still = given_camera(view);
  if (!motion.path_file.empty()) given.path = read_camera_path(motion.path_file);
  return given;
}

std::vector<Camera> run_cameras(const ViewRequest& view, const CameraMotionRequest& motion, const GivenCameras& given,
                                ShownFrames& frames, RunExtent* extent) {
  const std::optional<Selection>& show = frames.molecule().show;
  const std::vector<std::uint64_t>& numbers = frames.run().numbers();
  const ViewAim aim(view, show, frames.first());
  const std::vector<Ball> shown = aim.shown(frames.first_shown()), framed = aim.framed(frames.first_shown());
  const ViewedBalls seen{shown, framed, aim.symmetry()};
  const CameraCourse course(motion, frames, mean_center(framed));

  const ViewBasis basis = aimed_basis(view, given.still, seen);
  Camera lens;
  lens.projection = view.projection;
  DecisiveBalls decisive(basis, view.aspect(), given.still.value_or(lens));
  decisive.add(framed);
  std::vector<glm::dvec3> shifts(numbers.size(), glm::dvec3(0.0));
  const bool frames_all = !given.path && (!given.still || view.zoom_to);
  if (frames_all || course.follows() || extent) {
    const bool aims_anew = frames.run().chooses_anew() || (show && show->uses_positions()) ||
                           (view.zoom_to && view.zoom_to->uses_positions());
    frames.survey([&](std::uint64_t place, const Structure& read, const Structure& shown_there) {
      if (extent) include(shown_there, *extent);
      shifts[place] = course.shift(read, shown_there);
      if (!frames_all) return;
      const std::vector<Ball> filling =
          aims_anew ? framed_there(view, show, read, shown_there) : aim.framed(shown_there);
      if (filling.empty()) return;
      decisive.add(motion.moves() ? before_camera(filling, shifts[place], course.pivot(), basis.up, course.angle(place))
                                  : filling);
    });
  }
  const Camera still = given.path ? Camera{} : frames_all ? decisive.frame() : view_camera(view, given.still, seen);
  std::vector<Camera> cameras;
  for (std::uint64_t place = 0; place < numbers.size(); ++place) {
    Camera camera = given.path ? given.path->at(static_cast<double>(numbers[place])) : still;
    if (motion.turns != 0.0) camera = turned(camera, course.pivot(), view_basis(camera).up, course.angle(place));
    cameras.push_back(shifted(camera, shifts[place]));
  }
  return cameras;
}

}  // namespace meniscus
