// SPDX-License-Identifier: BSD-3-Clause
// Interpolates figures of a film, and averages pictures over the time of a frame.
#include "core/scene/transition.h"

#include <cassert>

#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

double between(double from, double to, double share) { return std::lerp(from, to, share); }
float between(float from, float to, double share) { return std::lerp(from, to, static_cast<float>(share)); }

template <glm::length_t count, typename Number>
glm::vec<count, Number> between(glm::vec<count, Number> from, const glm::vec<count, Number>& to, double share) {
  for (glm::length_t n = 0; n < count; ++n) from[n] = between(from[n], to[n], share);
  return from;
}

glm::vec3 color_between(const glm::vec3& from, const glm::vec3& to, double share) {
  return srgb_from_linear(between(linear_from_srgb(from), linear_from_srgb(to), share));
}

/// Returns the camera with another projection and the same view of the plane of its target. lens: has that projection.
Camera seen_through(const Camera& camera, const Camera& lens) {
  if (camera.projection == lens.projection) return camera;
  const auto half_angle = [](double fov) { return fov * std::numbers::pi / 360.0; };
  Camera seen = camera;
  seen.projection = lens.projection;
  const double distance = glm::distance(camera.position, camera.target);
  if (lens.projection == Projection::orthographic) {
    seen.height = 2.0 * distance * std::tan(half_angle(camera.vertical_fov));
  } else {
    seen.vertical_fov = lens.vertical_fov;
    const double from = 0.5 * camera.height / std::tan(half_angle(lens.vertical_fov));
    seen.position = camera.target - view_basis(camera).forward * from;
  }
  return seen;
}

/// Returns the offset at which a plane with this normal cuts none of the balls.
double offset_outside(const glm::dvec3& normal, std::span<const Ball> balls) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Ball& ball : balls) most = std::max(most, glm::dot(normal, ball.center) + ball.radius);
  return most;
}

/// True unless the value changes steadily or does not affect what is drawn.
bool is_drawn_as_it_is(const Property& property) {
  constexpr std::array<std::string_view, 5> kSections{"molecule", "frames", "surface", "shapes", "objects"};
  constexpr std::array<std::string_view, 6> kOthers{"surface.probe",       "surface.clip",       "surface.device",
                                                    "shapes.stick_radius", "shapes.tube_radius", "surface.threads"};
  return is_scene_value(property) && property.heading != "Film" &&
         std::ranges::find(kSections, property.section()) != kSections.end() &&
         std::ranges::find(kOthers, property.key) == kOthers.end();
}

/// The radii of a scene, Å.
struct Radii {
  double probe, stick, tube;

  bool operator==(const Radii&) const = default;
};

Radii radii_of(const Scene& scene) {
  const ShapeRadii& shapes = scene.figure.representations;
  return {scene.molecule.surface.probe_radius, shapes.stick_radius.value_or(0.0), shapes.tube_radius.value_or(0.0)};
}

Radii between(const Radii& from, const Radii& to, double share) {
  return {radius_between(from.probe, to.probe, share), radius_between(from.stick, to.stick, share),
          radius_between(from.tube, to.tube, share)};
}

void set_radii(const Radii& radii, Scene& scene) {
  scene.molecule.surface.probe_radius = radii.probe;
  ShapeRadii& shapes = scene.figure.representations;
  if (shapes.stick_radius) shapes.stick_radius = radii.stick;
  if (shapes.tube_radius) shapes.tube_radius = radii.tube;
}

/// Blends the second picture into the first, pixel by pixel.
void blend(Framebuffer& from, const Framebuffer& to, double share) {
  assert(from.size == to.size);
  for (std::size_t n = 0; n < from.color.size(); ++n) from.color[n] = between(from.color[n], to.color[n], share);
}

struct PartedAnnotations {
  Annotations common, of_first, of_second;
};

PartedAnnotations parted(const Annotations& first, const Annotations& second) {
  PartedAnnotations parts{first, first, second};
  for (Annotations* const one : {&parts.common, &parts.of_first, &parts.of_second}) one->labels_must_fit = false;
  const auto part = [&](auto Annotations::*member, bool is_common) {
    if (is_common)
      parts.of_first.*member = parts.of_second.*member = {};
    else
      parts.common.*member = {};
  };
  const auto is_same = [](const PlaceLabel& a, const PlaceLabel& b) {
    return a.text == b.text && a.position == b.position;
  };
  part(&Annotations::panel, first.panel == second.panel);
  part(&Annotations::title, first.title == second.title);
  part(&Annotations::time, first.time == second.time);
  part(&Annotations::scale_bar, first.scale_bar == second.scale_bar && first.bar_length == second.bar_length);
  part(&Annotations::labels, std::ranges::equal(first.labels, second.labels, is_same));
  part(&Annotations::curve, false);
  return parts;
}

bool are_equal(const std::optional<Legend>& one, const std::optional<Legend>& other) {
  return one && other && one->texts() == other->texts() && one->boxes() == other->boxes();
}

}  // namespace

double eased(double time, Pace pace) { return pace == Pace::even ? time : time * time * (3.0 - 2.0 * time); }

RenderSettings settings_of(const Shot& shot) {
  RenderSettings settings = render_settings(shot.scene, *shot.layout);
  settings.aovs = settings.mattes = false;
  return settings;
}

Framebuffer picture_of(const Shot& shot, Framebuffer molecule) {
  return finished_picture(std::move(molecule), shot.annotations, *shot.layout, shot.camera,
                          shot.scene.image.background);
}

Camera camera_between(const Camera& from, const Camera& to, double share) {
  if (share == 0.0) return from;
  return CameraPath({{0.0, from}, {1.0, seen_through(to, from)}}).at(share);
}

double radius_between(double from, double to, double share) {
  return from > 0.0 && to > 0.0 ? between(from, to, share) : from;
}

std::vector<Cut> cuts_at(std::span<const ClipPlane> planes) {
  std::vector<Cut> cuts;
  for (const ClipPlane& plane : planes) {
    Cut cut;
    cut.direction = plane.normal;
    cut.bound = plane.offset;
    cuts.push_back(cut);
  }
  return cuts;
}

std::vector<ClipPlane> planes_between(std::span<const ClipPlane> from, std::span<const ClipPlane> to,
                                      std::span<const Ball> balls, double share) {
  glm::dvec3 middle(0.0);
  for (const Ball& ball : balls) middle += ball.center / static_cast<double>(balls.size());
  std::vector<ClipPlane> planes;
  const auto leave = [&](const ClipPlane& plane, double way) {
    if (way < 1.0) planes.push_back({plane.normal, between(plane.offset, offset_outside(plane.normal, balls), way)});
  };
  for (std::size_t n = 0; n < std::max(from.size(), to.size()); ++n) {
    if (n < from.size() && n < to.size() && glm::dot(from[n].normal, to[n].normal) > 0.0) {
      const auto beyond = [&](const ClipPlane& plane) { return plane.offset - glm::dot(plane.normal, middle); };
      const glm::dvec3 normal = glm::normalize(between(from[n].normal, to[n].normal, share));
      planes.push_back({normal, glm::dot(normal, middle) + between(beyond(from[n]), beyond(to[n]), share)});
      continue;
    }
    if (n < from.size()) leave(from[n], share);
    if (n < to.size()) leave(to[n], 1.0 - share);
  }
  return planes;
}

Look look_between(const Look& from, const Look& to, double share) {
  Look look = from;
  Look other = to;
  for (const LookNumber& number : look_numbers()) {
    // The number of rays does not change steadily, because few rays make a noisy picture.
    if (!number.in || &number.in(look) == &look.ambient_occlusion_rays) continue;
    number.in(look) = between(number.in(look), number.in(other), share);
  }
  const auto widths = [&](std::optional<float> Look::*width) {
    if (from.*width || to.*width)
      look.*width = between((from.*width).value_or(from.silhouettes), (to.*width).value_or(to.silhouettes), share);
  };
  widths(&Look::outer_lines);
  widths(&Look::inner_lines);
  widths(&Look::part_lines);
  look.silhouettes = between(from.silhouettes, to.silhouettes, share);
  look.patch_lines = between(from.patch_lines, to.patch_lines, share);
  look.patch_line_color = color_between(from.patch_line_color, to.patch_line_color, share);
  look.line_step = between(from.line_step, to.line_step, share);
  look.background = color_between(from.background, to.background, share);
  const glm::vec3 light = between(glm::normalize(from.light_direction), glm::normalize(to.light_direction), share);
  if (glm::length(light) > 1e-3f) look.light_direction = light;
  return look;
}

Transition::Side Transition::side_of(Shot shot) {
  const Figure& figure = shot.figure;
  std::vector<ClipPlane> planes;
  if (!shot.scene.figure.hides_surface || shot.scene.figure.cuts_all)
    planes = surface_planes(shot.scene.figure, figure.extras.cut_atoms, shot.camera, figure.molecule.objects);
  const Look look = settings_of(shot).look;
  return {std::move(shot), std::move(planes), look};
}

Transition::Transition(Shot from, Shot to, const EglContext* context)
    : from_(side_of(std::move(from))), to_(side_of(std::move(to))), context_(context) {
  Scene &first = from_.shot.scene, &second = to_.shot.scene;
  assert(first.picture.size() == second.picture.size());
  if (from_.planes.empty()) first.figure.cap = second.figure.cap;
  if (to_.planes.empty()) second.figure.cap = first.figure.cap;
  for (const Side* side : {&from_, &to_}) {
    const double reach = side->shot.scene.molecule.surface.probe_radius;
    for (Ball ball : side->shot.figure.balls()) {
      ball.radius += reach;
      balls_.push_back(ball);
    }
  }
  // Frames of a run have other positions, even if their scenes are equal.
  const bool is_of_run = first.frames.is_requested() || second.frames.is_requested();
  is_steady_ = !is_of_run && from_.shot.camera.projection == to_.shot.camera.projection &&
               look_between(from_.look, to_.look, 1.0) == look_between(to_.look, from_.look, 0.0) &&
               std::ranges::all_of(properties(),
                                   [&](const Property* property) {
                                     return !is_drawn_as_it_is(*property) ||
                                            value_texts(first, *property) == value_texts(second, *property);
                                   }) &&
               between(radii_of(first), radii_of(second), 1.0) == radii_of(second);
}

Camera Transition::camera_of(const Side& side, double share) const {
  return &side == &from_ ? camera_between(from_.shot.camera, to_.shot.camera, share)
                         : camera_between(to_.shot.camera, from_.shot.camera, 1.0 - share);
}

Transition::Place Transition::place(double share) const {
  const PictureLayout &from = *from_.shot.layout, &to = *to_.shot.layout;
  const auto pixels = [share](int a, int b) {
    return static_cast<int>(std::lround(between(double(a), double(b), share)));
  };
  return {{pixels(from.size.width, to.size.width), pixels(from.size.height, to.size.height)},
          {pixels(from.strips.top, to.strips.top), pixels(from.strips.bottom, to.strips.bottom)}};
}

MoleculeShot Transition::shot(const Side& side, const Side& other, double share) const {
  const double way = &side == &from_ ? share : 1.0 - share;
  Scene scene = side.shot.scene;
  const Radii radii = between(radii_of(scene), radii_of(other.shot.scene), way);
  const bool is_computed = radii == radii_of(scene);
  set_radii(radii, scene);
  Figure figure =
      is_computed ? side.shot.figure
                  : make_figure(MoleculeBuilder(scene.molecule, context_).build(side.shot.figure.molecule.structure),
                                scene.figure);
  scene.figure.cuts = cuts_at(planes_between(from_.planes, to_.planes, balls_, share));
  figure.extras.cut_atoms.clear();
  RenderSettings settings = settings_of(side.shot);
  settings.size = place(share).size;
  settings.look = look_between(side.look, other.look, way);
  return {std::move(scene), std::move(figure), camera_of(side, share), settings};
}

std::vector<MoleculeShot> Transition::shots(double share) const {
  std::vector<MoleculeShot> shots;
  shots.push_back(shot(from_, to_, share));
  if (!is_steady_) shots.push_back(shot(to_, from_, share));
  return shots;
}

void Transition::write(Framebuffer& picture, const Annotations& annotations, const Side& side, double share,
                       double weight) const {
  if (weight <= 0.0 || !annotations.any()) return;
  Framebuffer written = picture;
  annotate(written, annotations, camera_of(side, share), side.shot.scene.image.background, place(share).strips);
  blend(picture, written, weight);
}

void Transition::add_legend(Framebuffer& picture, const Side& side, double share, double weight) const {
  const std::optional<Legend>& legend = side.shot.layout->legend;
  if (!legend || weight <= 0.0) return;
  Framebuffer none;
  none.size = legend->molecule_size();
  none.color.assign(static_cast<std::size_t>(none.size.x) * none.size.y, glm::vec4(0.0f));
  const Framebuffer over = legend->add_to(none, side.shot.scene.image.background);
  assert(picture.size == over.size);
  const auto [size, strips] = place(share);
  const int bottom = strips.top + size.y + strips.bottom;
  for (int y = 0; y < picture.size.y; ++y)
    for (int x = y < bottom ? size.x : 0; x < picture.size.x; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * picture.size.x + x;
      const glm::vec4 ink = over.color[pixel] * static_cast<float>(weight);
      picture.color[pixel] = ink + picture.color[pixel] * (1.0f - ink.w);
    }
}

Framebuffer Transition::picture(double share, StillRenderer& renderer) {
  const auto drawn = [&](MoleculeShot shot) {
    return draw(renderer, std::move(shot.figure), shot.scene.figure, shot.camera, shot.settings);
  };
  Framebuffer picture = drawn(shot(from_, to_, share));
  if (!is_steady_) blend(picture, drawn(shot(to_, from_, share)), share);
  const Strips strips = place(share).strips;
  picture = with_margin(picture, picture.size + glm::ivec2(0, strips.top + strips.bottom), strips.top, false);
  const double first = 1.0 - 2.0 * share, second = -first;
  const auto [common, of_first, of_second] = parted(from_.shot.annotations, to_.shot.annotations);
  write(picture, common, share < 0.5 ? from_ : to_, share, 1.0);
  write(picture, of_first, from_, share, first);
  write(picture, of_second, to_, share, second);
  picture = with_margin(picture, from_.shot.scene.picture.size(), 0, false);
  const bool has_one_legend = are_equal(from_.shot.layout->legend, to_.shot.layout->legend);
  add_legend(picture, from_, share, has_one_legend ? 1.0 : 1.0 - 4.0 * share);
  if (!has_one_legend) add_legend(picture, to_, share, 4.0 * share - 3.0);
  return picture;
}

std::optional<glm::vec3> Transition::background(double share) const {
  const std::optional<glm::vec3>&from = from_.shot.scene.image.background, &to = to_.shot.scene.image.background;
  if (!from && !to) return {};
  return color_between(from.value_or(glm::vec3(1.0f)), to.value_or(glm::vec3(1.0f)), share);
}

namespace {

/// The number of grid lines per step and moment: moments lie in the middles of equal parts of the shutter, which is
/// half a step wide.
constexpr int kGridLines = 4;

RunRequest with_moments(const Scene& scene, int moments) {
  if (scene.molecule.interface)
    throw RequestError(
        message("@motion-blur@: pages of an open interface do not move with their atoms; leave one of them out"));
  if (scene.frames.repeat > 1)
    throw RequestError(
        message("@motion-blur@: nothing moves between the repeats of a frame; use @interpolate@, not @repeat@"));
  RunRequest request = scene.frames;
  request.interpolate *= static_cast<std::uint64_t>(kGridLines) * static_cast<std::uint64_t>(moments);
  request.only.clear();
  return request;
}

}  // namespace

MotionBlur::MotionBlur(const Scene& scene, int moments, std::vector<Camera> cameras, const EglContext* context)
    : scene_(scene),
      moments_(moments),
      cameras_(std::move(cameras)),
      run_(scene.molecule, with_moments(scene, moments)),
      builder_(scene.molecule, context) {}

Camera MotionBlur::camera(std::uint64_t place, double later) const {
  if (cameras_.size() == 1) return cameras_.front();
  const std::uint64_t last = cameras_.size() - 1;
  const std::uint64_t other = later < 0.0 ? std::max<std::uint64_t>(place, 1) - 1 : std::min(place + 1, last);
  return camera_between(cameras_[place], cameras_[other], std::abs(later));
}

Framebuffer MotionBlur::draw(std::uint64_t place, StillRenderer& renderer, RenderSettings settings) {
  const std::lock_guard lock(mutex_);
  settings.take_band = {};
  settings.progress = {};
  const std::vector<std::uint64_t>& numbers = run_.numbers();
  const int lines = kGridLines * moments_;
  Framebuffer mean;
  for (int n = 0; n < moments_; ++n) {
    const int line = 2 * n + 1 - moments_;  // number of the grid line, counted from the frame
    const auto at = static_cast<std::int64_t>(place) * lines + line;
    const auto found =
        static_cast<std::size_t>(std::clamp<std::int64_t>(at, 0, static_cast<std::int64_t>(numbers.size()) - 1));
    Figure figure = make_figure(builder_.build(run_.at(numbers[found])), scene_.figure);
    Framebuffer drawn = meniscus::draw(renderer, std::move(figure), scene_.figure,
                                       camera(place, static_cast<double>(line) / lines), settings);
    if (mean.color.empty()) {
      mean.size = drawn.size;
      mean.color.assign(drawn.color.size(), glm::vec4(0.0f));
    }
    for (std::size_t p = 0; p < mean.color.size(); ++p) mean.color[p] += drawn.color[p] / static_cast<float>(moments_);
  }
  return mean;
}

}  // namespace meniscus
