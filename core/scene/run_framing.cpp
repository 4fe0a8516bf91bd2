// SPDX-License-Identifier: BSD-3-Clause
// Measures all frames of a run, so that each of them can be made by itself.
#include "core/scene/run_framing.h"

#include "core/camera/camera_json.h"
#include "core/queries/copies.h"
#include "core/scene/view_aim.h"

namespace meniscus {
namespace {

/// Does `work`, and returns its exception if the frame has an error. The code that makes the frame reports that error.
template <typename Work>
std::exception_ptr fault_of_frame(const Work& work) {
  try {
    work();
  } catch (const InputError&) {
    return std::current_exception();
  } catch (const OpenSurfaceError&) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace

void ShownFrames::open(std::uint64_t place, Structure& structure, SurfaceComputer& computer) {
  pages_.resize(frames_.numbers().size());
  std::optional<OpenPages>& pages = pages_[place];
  if (pages) return open_book(structure, interface_groups(structure, *molecule_.interface), *pages);
  const Burial burial = burial_of(molecule_, structure, computer);
  most_buried_ = std::max(most_buried_, std::ranges::max(burial.areas));
  pages = open_pages(structure, burial.groups, burial.areas);
  open_book(structure, burial.groups, *pages);
}

void ShownFrames::find_first() {
  if (first_shown_) return;
  SurfaceComputer computer(molecule_.surface);
  std::exception_ptr first_fault;
  for (std::uint64_t place = 0; place < frames_.numbers().size(); ++place) {
    const std::exception_ptr fault = fault_of_frame([&] {
      first_ = frames_.at(frames_.numbers()[place]);
      Structure shown = *first_;
      open(place, shown, computer);
      first_shown_ = std::move(shown);
    });
    if (!fault) return;
    if (!first_fault) first_fault = fault;
  }
  std::rethrow_exception(first_fault);
}

const Structure& ShownFrames::first() {
  if (!molecule_.interface) return frames_.structure();
  find_first();
  return *first_;
}

const Structure& ShownFrames::first_shown() {
  if (!molecule_.interface) return frames_.structure();
  find_first();
  return *first_shown_;
}

void ShownFrames::survey(const Look& look) {
  if (!molecule_.interface)
    return frames_.survey([&](std::uint64_t place, const Structure& read) { look(place, read, read); });
  SurfaceComputer computer(molecule_.surface);
  frames_.survey([&](std::uint64_t place, const Structure& read) {
    Structure shown = read;
    if (!fault_of_frame([&] { open(place, shown, computer); })) look(place, read, shown);
  });
}

double ShownFrames::most_buried() {
  if (molecule_.interface) {
    survey([](std::uint64_t, const Structure&, const Structure&) {});
    return most_buried_;
  }
  SurfaceComputer computer(molecule_.surface);
  frames_.survey([&](std::uint64_t, const Structure& structure) {
    fault_of_frame([&] {
      most_buried_ = std::max(most_buried_, std::ranges::max(burial_of(molecule_, structure, computer).areas));
    });
  });
  return most_buried_;
}

namespace {

/// Returns the balls of some atoms. followed: one value for each of shown_atoms().
std::vector<Ball> followed_balls(const Structure& structure, const std::vector<bool>& followed) {
  const auto beside = followed.begin() + static_cast<std::ptrdiff_t>(structure.atoms.size());
  std::vector<Ball> balls = standing_balls(structure, {followed.begin(), beside});
  for (std::size_t n = 0; n < structure.extra_atoms.size() && structure.atoms.size() + n < followed.size(); ++n)
    if (beside[static_cast<std::ptrdiff_t>(n)])
      balls.push_back({structure.extra_atoms[n].position, structure.extra_atoms[n].radius});
  return balls;
}

/// The differences between the camera of each frame and the camera that the run starts with.
class CameraCourse {
 public:
  /// pivot: the point that the camera turns about, Å.
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
    start_ = mean_center(followed_balls(frames.first_shown(), followed_));
    follows_others_ = run.atoms_change() || motion.follow->uses_positions();
  }

  bool follows() const { return !followed_.empty(); }
  glm::dvec3 shift(const Structure& read, const Structure& shown) const {
    if (!follows()) return glm::dvec3(0.0);
    return mean_center(followed_balls(shown, follows_others_ ? followed_of(read) : followed_)) - start_;
  }
  double angle(std::uint64_t place) const {
    return 2.0 * std::numbers::pi * motion_.turns * static_cast<double>(place) / count_;
  }
  const glm::dvec3& pivot() const { return pivot_; }

 private:
  std::vector<bool> followed_of(const Structure& structure) const {
    std::vector<bool> followed = motion_.follow->evaluate(shown_atoms(structure));
    if (std::ranges::find(followed, true) == followed.end())
      throw RequestError(message("@follow {}@: selects none of the {} atoms of the surface{}",
                                 in_quotes(motion_.follow->text()), with_thousands(followed.size()),
                                 structure.frame ? fmt::format(" in frame {}", *structure.frame) : ""));
    return followed;
  }

  const CameraMotionRequest& motion_;
  std::vector<bool> followed_;   // per atom; empty: the camera follows no atoms
  bool follows_others_ = false;  // true if the followed atoms differ between frames
  glm::dvec3 pivot_{0.0}, start_{0.0};
  double count_ = 1.0;
};

/// Returns the balls in the coordinates of the camera that moves with them.
std::vector<Ball> before_camera(std::span<const Ball> balls, const glm::dvec3& shift, const glm::dvec3& pivot,
                                const glm::dvec3& axis, double angle) {
  std::vector<Ball> seen(balls.begin(), balls.end());
  Camera carrier;  // its position carries the point
  for (Ball& ball : seen) {
    carrier.position = ball.center - shift;
    ball.center = turned(carrier, pivot, axis, -angle).position;
  }
  return seen;
}

/// Returns the balls that must fill the picture of a frame, which may differ from the first frame's; none if nothing is
/// shown.
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
  for (const Atom& atom : structure.extra_atoms)
    if (is_drawn_beside(atom)) include_ball({atom.position, atom.radius}, extent.shown);
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
  ViewedBalls seen = aim.viewed_balls(shown, framed);
  seen.forward = aim.clear_side(frames.first_shown());
  const CameraCourse course(motion, frames, mean_center(framed));

  const ViewBasis basis = aimed_basis(view, given.still, seen);
  Camera lens;
  lens.projection = view.projection;
  DecisiveBalls decisive(basis, view.aspect(), given.still.value_or(lens));
  decisive.add(framed);
  std::vector<glm::dvec3> shifts(numbers.size(), glm::dvec3(0.0));
  const bool frames_all = !given.path && (!given.still || view.zoom_to);
  if (frames_all || course.follows() || extent) {
    const bool aims_per_frame = frames.run().selects_per_frame() || (show && show->uses_positions()) ||
                                (view.zoom_to && view.zoom_to->uses_positions());
    frames.survey([&](std::uint64_t place, const Structure& read, const Structure& shown_there) {
      if (extent) include(shown_there, *extent);
      shifts[place] = course.shift(read, shown_there);
      if (!frames_all) return;
      const std::vector<Ball> filling =
          aims_per_frame ? framed_there(view, show, read, shown_there) : aim.framed(shown_there);
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

glm::dvec3 RunFraming::origin() const { return glm::round((extent.surface.low + extent.surface.high) * 0.5e3) / 1e3; }

namespace {

/// Returns the range of the numbers of By::radial over all frames that can be read.
std::optional<std::array<double, 2>> radial_range(ShownFrames& frames) {
  std::optional<std::array<double, 2>> range;
  frames.survey([&range](std::uint64_t, const Structure&, const Structure& shown) {
    std::vector<glm::dvec3> centers;
    for (const Atom& atom : shown.atoms) centers.push_back(atom.position);
    const std::vector<double> distances = distances_from_middle(centers);
    const auto [low, high] = std::ranges::minmax(distances);
    range = range ? std::array{std::min((*range)[0], low), std::max((*range)[1], high)} : std::array{low, high};
  });
  return range;
}

/// Sets the range of numbers that atoms have by themselves, over all atoms that any frame may have, so that it is the
/// same in each frame.
void share_colors(ColorScheme& color, const FrameRun& frames) {
  const bool is_categorical = color.map == ColorMap::categorical && !color.own_map;
  if ((color.by == ColorScheme::By::buried || color.by == ColorScheme::By::accessibility) && is_categorical)
    throw RequestError(
        message("@map categorical@ gives each number of a picture its own colour, but areas change from frame to "
                "frame; choose another @map@"));
  if (!frames.atoms_change() || !color.has_scale() || color.of_points()) return;
  if (is_categorical)
    throw RequestError(
        message("@map categorical@ gives each number of a picture its own colour, but @select@ chooses other atoms in "
                "each frame; choose another @map@, or add @select-once@"));
  if (color.range || color.by == ColorScheme::By::radial || color.is_measured()) return;
  if (color.takes_file())
    throw RequestError(message(
        "@color-by-file@ needs @color-range LO:HI@ or @select-once@ where @select@ chooses other atoms in each frame"));
  color.frames_range = color_scale(frames.possible_structure(), color).range;
}

/// Measures a scheme without its rules and without buried areas.
void measure_scheme(ColorScheme& color, ShownFrames& frames) {
  FrameRun& run = frames.run();
  if (run.atoms_change()) color = resolved_scheme(run.possible_structure(), std::move(color));
  share_colors(color, run);
  if (color.by == ColorScheme::By::rmsf) color.file = {.path = run.structure().file, .numbers = fluctuations(run)};
  if (color.by == ColorScheme::By::radial && !color.range) color.frames_range = radial_range(frames);
}

}  // namespace

RunFraming run_framing(const ViewRequest& view, const CameraMotionRequest& motion, const GivenCameras& given,
                       ShownFrames& frames) {
  RunFraming framing;
  framing.cameras = run_cameras(view, motion, given, frames, &framing.extent);
  if (!motion.moves()) framing.cameras.resize(1);
  return framing;
}

void measure_colors(ColorScheme& color, ShownFrames& frames) {
  measure_scheme(color, frames);
  for (ColorRule& rule : color.rules) measure_scheme(rule.paint, frames);
  if (color.by != ColorScheme::By::buried && color.by != ColorScheme::By::accessibility) return;
  // The numbers are set with each frame.
  const Structure& possible = frames.run().possible_structure();
  color.file = {.path = possible.file, .numbers = std::vector<double>(possible.atoms.size(), 0.0)};
  if (color.by == ColorScheme::By::accessibility) return;
  if (!color.range) color.frames_range = std::array{0.0, frames.most_buried()};
}

Structure numbered_structure(const FrameRun& frames) {
  Structure possible = frames.possible_structure();
  possible.frame = frames.structure().frame;
  return possible;
}

std::vector<glm::vec3> run_colors(const Structure& structure, const ColorScheme& scheme, const Coloring& extras) {
  std::vector<glm::vec3> colors;
  const auto add = [&](const glm::vec3& color) {
    if (std::ranges::find(colors, color) == colors.end()) colors.push_back(color);
  };
  for (const ColorRule& rule : scheme.rules)  // rules may select any atoms in other frames
    for (const glm::vec3& color : run_colors(structure, rule.paint)) add(color);
  if (scheme.by == ColorScheme::By::component) {
    for (std::size_t n = 0; n < kCategoricalCount; ++n) add(categorical_color(n));
  } else {
    const Coloring coloring = color_atoms(structure, scheme);
    if (coloring.kind) {
      for (const glm::vec3& color : *coloring.kind) add(color);
    } else {
      for (const glm::vec3& color : coloring.atom) add(color);
    }
  }
  for (const glm::vec3& color : extras.atom) add(color);
  return colors;
}

}  // namespace meniscus
