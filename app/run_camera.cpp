// SPDX-License-Identifier: BSD-3-Clause
// Puts together the camera of each frame of a run.
#include "app/run_camera.h"

#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/program_error.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

glm::dvec3 middle_of(std::span<const Ball> balls) {
  glm::dvec3 sum(0.0);
  for (const Ball& ball : balls) sum += ball.center;
  return sum / static_cast<double>(balls.size());
}

/// How the camera of each frame differs from the one it starts with.
class CameraMotion {
 public:
  CameraMotion(const RunCameraOptions& options, const Sequence& sequence) : options_(options) {
    const std::vector<Atom>& atoms = sequence.structure().atoms;
    const std::vector<Ball> balls = balls_of(sequence.structure());
    pivot_ = middle_of(balls);
    count_ = static_cast<double>(sequence.run().size());
    if (!options.follow) return;
    const std::vector<bool> selected = options.follow->evaluate(atoms);
    for (std::size_t n = 0; n < atoms.size(); ++n)
      if (selected[n]) followed_.push_back(n);
    if (followed_.empty())
      throw UsageError(fmt::format("--follow {}: selects none of the {} atoms of the surface",
                                   in_quotes(options.follow->text()), with_thousands(atoms.size())));
    start_ = followed_middle(balls);
  }

  bool follows() const { return !followed_.empty(); }
  glm::dvec3 shift(std::span<const Ball> balls) const {
    return follows() ? followed_middle(balls) - start_ : glm::dvec3(0.0);
  }
  double angle(std::uint64_t place) const {
    return 2.0 * std::numbers::pi * options_.turns * static_cast<double>(place) / count_;
  }
  const glm::dvec3& pivot() const { return pivot_; }

 private:
  glm::dvec3 followed_middle(std::span<const Ball> balls) const {
    glm::dvec3 sum(0.0);
    for (const std::size_t n : followed_) sum += balls[n].center;
    return sum / static_cast<double>(followed_.size());
  }

  const RunCameraOptions& options_;
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

}  // namespace

void add_run_camera_options(CLI::App& command, RunCameraOptions& options) {
  const Heading heading(command, "Frames");
  CLI::Option* const path =
      command.add_option("--camera-path", options.path_file, "Key frames of the camera as JSON: frame, camera");
  path->type_name("FILE")->excludes(command.get_option("--camera"));
  command
      .add_option("--turntable", options.turns,
                  "Turns of the camera about the molecule's middle over the run; negative: the other way round")
      ->type_name("TURNS");
  command
      .add_option_function<std::string>(
          "--follow",
          [&options](const std::string& text) { options.follow = parse_selection_option("--follow", text); },
          "Move the camera with the middle of these atoms")
      ->type_name("EXPR");
}

GivenCameras given_cameras(const PictureOptions& picture, const RunCameraOptions& options) {
  GivenCameras given;
  given.still = given_camera(picture);
  if (!options.path_file.empty()) given.path = read_camera_path(options.path_file);
  return given;
}

std::vector<Camera> run_cameras(const PictureOptions& picture, const RunCameraOptions& options,
                                const GivenCameras& given, Sequence& sequence) {
  const double aspect = static_cast<double>(picture.width) / picture.height;
  const std::vector<Ball> first = balls_of(sequence.structure());
  const CameraMotion motion(options, sequence);

  const ViewBasis basis = broad_side(first);
  Camera lens;
  lens.projection = picture.projection;
  DecisiveBalls decisive(basis, aspect, lens);
  decisive.add(first);
  std::vector<glm::dvec3> shifts(sequence.run().size(), glm::dvec3(0.0));
  if (!given.any() || motion.follows()) {
    sequence.survey([&](std::uint64_t place, std::span<const Ball> balls) {
      shifts[place] = motion.shift(balls);
      if (given.any()) return;
      decisive.add(options.moves() ? before_camera(balls, shifts[place], motion.pivot(), basis.up, motion.angle(place))
                                   : std::vector<Ball>(balls.begin(), balls.end()));
    });
  }
  const Camera still = given.path ? Camera{} : given.still ? *given.still : decisive.frame();
  std::vector<Camera> cameras;
  for (std::uint64_t place = 0; place < sequence.run().size(); ++place) {
    Camera camera = given.path ? given.path->at(static_cast<double>(sequence.run()[place])) : still;
    if (options.turns != 0.0) camera = turned(camera, motion.pivot(), view_basis(camera).up, motion.angle(place));
    cameras.push_back(shifted(camera, shifts[place]));
  }
  return cameras;
}

}  // namespace meniscus
