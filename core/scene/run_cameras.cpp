// SPDX-License-Identifier: BSD-3-Clause
// Puts together the camera of each frame of a run.
#include "core/scene/run_cameras.h"

#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/text.h"
#include "core/base/error.h"

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
  CameraCourse(const CameraMotionRequest& motion, const FrameRun& frames) : motion_(motion) {
    const std::vector<Atom>& atoms = frames.structure().atoms;
    const std::vector<Ball> balls = balls_of(frames.structure());
    pivot_ = middle_of(balls);
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

std::vector<Camera> run_cameras(const ViewRequest& view, const CameraMotionRequest& motion, const GivenCameras& given,
                                FrameRun& frames, Box* extent) {
  const double aspect = static_cast<double>(view.width) / view.height;
  const std::vector<Ball> first = balls_of(frames.structure());
  const CameraCourse course(motion, frames);

  const ViewBasis basis = broad_side(first);
  Camera lens;
  lens.projection = view.projection;
  DecisiveBalls decisive(basis, aspect, lens);
  decisive.add(first);
  std::vector<glm::dvec3> shifts(frames.numbers().size(), glm::dvec3(0.0));
  if (!given.any() || course.follows() || extent) {
    frames.survey([&](std::uint64_t place, std::span<const Ball> balls) {
      if (extent) include(balls, *extent);
      shifts[place] = course.shift(balls);
      if (given.any()) return;
      decisive.add(motion.moves() ? before_camera(balls, shifts[place], course.pivot(), basis.up, course.angle(place))
                                  : std::vector<Ball>(balls.begin(), balls.end()));
    });
  }
  const Camera still = given.path ? Camera{} : given.still ? *given.still : decisive.frame();
  std::vector<Camera> cameras;
  for (std::uint64_t place = 0; place < frames.numbers().size(); ++place) {
    Camera camera = given.path ? given.path->at(static_cast<double>(frames.numbers()[place])) : still;
    if (motion.turns != 0.0) camera = turned(camera, course.pivot(), view_basis(camera).up, course.angle(place));
    cameras.push_back(shifted(camera, shifts[place]));
  }
  return cameras;
}

}  // namespace meniscus
