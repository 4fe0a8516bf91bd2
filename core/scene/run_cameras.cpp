// SPDX-License-Identifier: BSD-3-Clause
// Puts together the camera of each frame of a run.
#include "core/scene/run_cameras.h"

#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/text.h"
#include "core/base/error.h"
#include "core/scene/view_aim.h"

namespace meniscus {
namespace {

glm::dvec3 middle_of(std::span<const Ball> balls) {
  glm::dvec3 sum(0.0);
  for (const Ball& ball : balls) sum += ball.center;
  return sum / static_cast<double>(balls.size());
}

/// How the camera of each frame differs from the one it starts with.
class CameraCourse {
 public:
  /// pivot: what the camera turns about, Å.
  CameraCourse(const CameraMotionRequest& motion, const FrameRun& frames, const glm::dvec3& pivot)
      : motion_(motion), pivot_(pivot) {
    const std::vector<Atom>& atoms = frames.structure().atoms;
    const std::vector<Ball> balls = balls_of(frames.structure());
    count_ = static_cast<double>(frames.numbers().size());
    if (!motion.follow) return;
    const std::vector<bool> selected = motion.follow->evaluate(atoms);
    for (std::size_t n = 0; n < atoms.size(); ++n)
      if (selected[n]) followed_.push_back(n);
    if (followed_.empty())
      throw RequestError(fmt::format("--follow {}: selects none of the {} atoms of the surface",
                                     in_quotes(motion.follow->text()), with_thousands(atoms.size())));
    start_ = followed_middle(balls);
  }

  bool follows() const { return !followed_.empty(); }
  glm::dvec3 shift(std::span<const Ball> balls) const {
    return follows() ? followed_middle(balls) - start_ : glm::dvec3(0.0);
  }
  double angle(std::uint64_t place) const {
    return 2.0 * std::numbers::pi * motion_.turns * static_cast<double>(place) / count_;
  }
  const glm::dvec3& pivot() const { return pivot_; }

 private:
  glm::dvec3 followed_middle(std::span<const Ball> balls) const {
    glm::dvec3 sum(0.0);
    for (const std::size_t n : followed_) sum += balls[n].center;
    return sum / static_cast<double>(followed_.size());
  }

  const CameraMotionRequest& motion_;
  std::vector<std::size_t> followed_;
  glm::dvec3 pivot_{0.0}, start_{0.0};
  double count_ = 1.0;
};

/// The balls as they stand before the camera that moves with them.
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

void include(std::span<const Ball> balls, Box& box) {
  for (const Ball& ball : balls) {
    box.include(ball.center - ball.radius);
    box.include(ball.center + ball.radius);
  }
}

}  // namespace

GivenCameras given_cameras(const ViewRequest& view, const CameraMotionRequest& motion) {
  GivenCameras given;
  given.still = given_camera(view);
  if (!motion.path_file.empty()) given.path = read_camera_path(motion.path_file);
  return given;
}

std::vector<Camera> run_cameras(const ViewRequest& view, const std::optional<Selection>& show,
                                const CameraMotionRequest& motion, const GivenCameras& given, FrameRun& frames,
                                Box* extent) {
  const std::vector<Ball> first = balls_of(frames.structure());
  const ViewAim aim(view, show, frames.structure());
  const std::vector<Ball> shown = aim.shown(first), framed = aim.framed(first);
  const ViewedBalls seen{shown, framed, aim.symmetry()};
  const CameraCourse course(motion, frames, middle_of(framed));

  const ViewBasis basis = aimed_basis(view, given.still, seen);
  Camera lens;
  lens.projection = view.projection;
  DecisiveBalls decisive(basis, view.aspect(), given.still.value_or(lens));
  decisive.add(framed);
  std::vector<glm::dvec3> shifts(frames.numbers().size(), glm::dvec3(0.0));
  const bool frames_all = !given.path && (!given.still || view.zoom_to);
  if (frames_all || course.follows() || extent) {
    frames.survey([&](std::uint64_t place, std::span<const Ball> balls) {
      if (extent) include(balls, *extent);
      shifts[place] = course.shift(balls);
      if (!frames_all) return;
      const std::vector<Ball> filling = aim.framed(balls);
      decisive.add(motion.moves() ? before_camera(filling, shifts[place], course.pivot(), basis.up, course.angle(place))
                                  : filling);
    });
  }
  const Camera still = given.path ? Camera{} : frames_all ? decisive.frame() : view_camera(view, given.still, seen);
  std::vector<Camera> cameras;
  for (std::uint64_t place = 0; place < frames.numbers().size(); ++place) {
    Camera camera = given.path ? given.path->at(static_cast<double>(frames.numbers()[place])) : still;
    if (motion.turns != 0.0) camera = turned(camera, course.pivot(), view_basis(camera).up, course.angle(place));
    cameras.push_back(shifted(camera, shifts[place]));
  }
  return cameras;
}

}  // namespace meniscus
