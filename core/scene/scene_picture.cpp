// SPDX-License-Identifier: BSD-3-Clause
// Lays out the picture of a scene, and finds atoms that cannot be seen in it.
#include "core/scene/scene_picture.h"

#include <unordered_set>

#include "core/camera/open_side.h"
#include "core/render/cpu/unevenness.h"
#include "core/scene/scene_value.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

constexpr double kFewPixels = 3e5, kMostPixels = 2e6;

/// Atoms that a picture should show at least partly.
struct Sought {
  std::string what;
  std::vector<std::uint32_t> atoms;  ///< places in shown_atoms()
  PlaceLabel* label = nullptr;
  bool is_seen = false;
};

glm::ivec2 smaller(glm::ivec2 size, double most_pixels) {
  const double share = std::min(1.0, std::sqrt(most_pixels / (static_cast<double>(size.x) * size.y)));
  return glm::max(glm::ivec2(glm::dvec2(size) * share), glm::ivec2(1));
}

bool is_seen_through(const Scene& scene) {
  return !scene.molecule.color.opacities.empty() ||
         std::ranges::any_of(scene.figure.objects, [](const auto& object) { return !object.opacities.empty(); });
}

std::vector<Sought> sought_in(const Scene& scene, const std::vector<Atom>& atoms, Annotations& annotations,
                              bool with_colors) {
  std::vector<Sought> sought;
  std::vector<bool> taken(atoms.size());
  const auto add = [&](const char* option, const std::string& text, const Selection& selection) -> Sought& {
    Sought& added = sought.emplace_back();
    added.what = option_name(fmt::format("{} {}", option, in_quotes(text)));
    const std::vector<bool> selected = selection.evaluate(atoms);
    for (std::uint32_t a = 0; a < atoms.size(); ++a)
      if (selected[a] && !taken[a]) added.atoms.push_back(a);
    return added;
  };
  for (std::size_t n = 0; n < scene.annotations.labels.size(); ++n) {
    const LabelRequest& label = scene.annotations.labels[n];
    add("label", label.text, label.atoms).label = &annotations.labels[n];
  }
  if (!with_colors) return sought;
  if (scene.molecule.patches) add("patches", scene.molecule.patches->text(), *scene.molecule.patches);
  const std::vector<ColorRule>& rules = scene.molecule.color.rules;
  for (auto rule = rules.rbegin(); rule != rules.rend(); ++rule)  // the last rule of an atom counts
    for (const std::uint32_t a : add("color", color_rule_text(*rule), rule->atoms).atoms) taken[a] = true;
  return sought;
}

void find_seen(std::vector<Sought>& sought, const std::vector<Atom>& atoms, const Framebuffer& picture) {
  const std::unordered_set<std::uint32_t> seen(picture.atom.begin(), picture.atom.end());
  for (Sought& one : sought)
    one.is_seen =
        one.is_seen || std::ranges::any_of(one.atoms, [&](std::uint32_t a) { return seen.contains(atoms[a].index); });
}

/// Hides the lengths of dashed lines that lie behind what the picture shows at three points.
void hide_lengths(std::span<PlaceLabel> labels, const Camera& camera, const Framebuffer& picture) {
  constexpr double kInFront = 0.2;  // Å; the dashes themselves are in front of their middle
  const glm::dvec3 forward = view_basis(camera).forward;
  const auto is_seen = [&](const glm::dvec3& point) {
    const glm::ivec2 pixel(place_in_picture(camera, glm::dvec2(picture.size), point));
    if (glm::clamp(pixel, glm::ivec2(0), picture.size - 1) != pixel) return true;
    const glm::dvec3 way = point - camera.position;
    const double depth = camera.projection == Projection::orthographic ? glm::dot(way, forward) : glm::length(way);
    return picture.z[static_cast<std::size_t>(pixel.y) * picture.size.x + pixel.x] >= depth - kInFront;
  };
  for (PlaceLabel& label : labels) {
    if (!label.is_length()) continue;
    const glm::dvec3 part = 0.5 * label.along;
    label.is_hidden = !is_seen(label.position) && !is_seen(label.position + part) && !is_seen(label.position - part);
  }
}

/// Returns the end of a sentence: the turns after which some of the atoms are visible.
std::string advice(const Sought& hidden, const std::vector<Atom>& atoms, const Camera& camera, const CastSurvey& cast,
                   glm::ivec2 size) {
  std::vector<Ball> all, own;
  for (const Atom& atom : atoms) all.push_back({atom.position, atom.radius});
  for (const std::uint32_t a : hidden.atoms) own.push_back(all[a]);
  const ViewBasis now = view_basis(camera);
  const glm::dvec3 toward = -open_side(own, all).forward;
  const double x = glm::dot(toward, now.right), y = glm::dot(toward, now.up), z = -glm::dot(toward, now.forward);
  const auto degrees = [](double radians) { return std::round(radians * 180.0 / std::numbers::pi) + 0.0; };
  ViewRequest turned;
  turned.turns = {{1, degrees(std::atan2(-x, z))}, {0, degrees(std::atan2(y, std::hypot(x, z)))}};
  std::vector<Sought> again{hidden};
  find_seen(again, atoms, cast(view_camera(turned, camera, {all, all, {}}), size));
  if (!again.front().is_seen) return "no side was found that shows them";
  std::string words;
  for (const Turn& turn : turned.turns)
    if (turn.degrees != 0.0) words += message("@turn {}{}@ ", "xyz"[turn.axis], turn.degrees);
  return words + "shows some";
}

}  // namespace

Survey survey_of(const Scene& scene, const Structure& structure, const Camera& camera, glm::ivec2 size,
                 Annotations& annotations, std::vector<std::string>* sentences) {
  if ((annotations.labels.empty() && !sentences) || is_seen_through(scene)) return {};
  std::vector<Atom> atoms = shown_atoms(structure);
  std::vector<Sought> sought = sought_in(scene, atoms, annotations, sentences != nullptr);
  std::erase_if(sought, [](const Sought& one) { return one.atoms.empty(); });
  const std::span<PlaceLabel> labels = annotations.labels;
  if (sought.empty() && std::ranges::none_of(labels, &PlaceLabel::is_length)) return {};
  return [&camera, sentences, labels, atoms = std::move(atoms), sought = std::move(sought),
          few = smaller(size, kFewPixels), many = smaller(size, kMostPixels)](const CastSurvey& cast) {
    std::vector<Sought> found = sought;
    const Framebuffer seen = cast(camera, few);
    find_seen(found, atoms, seen);
    hide_lengths(labels, camera, seen);
    if (few != many && !std::ranges::all_of(found, &Sought::is_seen)) find_seen(found, atoms, cast(camera, many));
    for (const Sought& one : found) {
      if (one.label) one.label->is_hidden = !one.is_seen;
      if (sentences && !one.is_seen)
        sentences->push_back(
            fmt::format("{}: no pixel shows any of its atoms; {}", one.what, advice(one, atoms, camera, cast, few)));
    }
  };
}

PictureLayout::PictureLayout(const Scene& scene, const ColorKey& key) : size(scene.picture) {
  const LegendStyle style = legend_style(scene.legend.style, scene.annotations.letters);
  if (!scene.legend.file.empty()) legend_apart.emplace(key, size.size(), style);
  if (scene.legend.within) legend.emplace(key, size.size(), style);
  if (legend) size.width = legend->molecule_size().x;
  if (legend) size.height = legend->molecule_size().y;
  strips = scene_strips(scene, size.size());
  size.height -= strips.top + strips.bottom;
}

Strips scene_strips(const Scene& scene, glm::ivec2 size) {
  const LetterStyle& letters = scene.annotations.letters;
  Strips strips = strips_for(strip_contents(scene.annotations, scene.frames.is_requested()), letters, size);
  // Around a molecule that fills its picture there is no free corner.
  if (scene.picture.fits && scene.annotations.scale_bar)
    strips.bottom = std::max({strips.bottom, 3 * LetterHeights(letters, size).scale_bar,
                              letters.border + 2 * LetterHeights(letters, size).scale_bar});
  return strips;
}

glm::ivec2 fitted_margin(const Scene& scene, glm::ivec2 size) {
  constexpr double kMillimetersPerInch = 25.4, kUsual = 2.0;
  const double dots = scene.picture.dots_per_inch > 0.0 ? scene.picture.dots_per_inch : scene_values::kUsualResolution;
  glm::ivec2 margin(scene.picture.margin.value_or(static_cast<int>(std::lround(kUsual / kMillimetersPerInch * dots))));
  if (scene.annotations.labels.empty()) return margin;
  const LetterStyle& letters = scene.annotations.letters;
  const Font font(LetterHeights(letters, size).labels, Weight::regular, letters.font);
  int widest = 0;
  for (const LabelRequest& label : scene.annotations.labels) widest = std::max(widest, font.width(label.text));
  return margin + glm::ivec2(std::min(widest + font.height(), size.x / 4), 0);
}

SurfaceRequest picture_request(const Scene& scene) {
  SurfaceRequest request = scene.molecule.surface;
  // The CPU looks up values of volume maps point by point.
  request.cpu = request.cpu || scene.molecule.color.of_points();
  return request;
}

RenderSettings render_settings(const Scene& scene, const PictureLayout& layout) {
  RenderSettings settings;
  settings.size = layout.size.size();
  settings.samples = scene.image.samples;
  settings.adaptive = Unevenness::pays_off(scene.picture.size());
  settings.aovs = scene.image.aovs;
  settings.mattes = scene.image.cryptomatte;
  settings.look =
      look_of(scene.look, scene.picture.size(), scene.image.background,
              hues_of(scene.molecule.color, uses_atoms(scene.figure.cuts)), scene.molecule.patches.has_value());
  return settings;
}

void check_picture(const Scene& scene) {
  scene.figure.check();
  if (scene.picture.fits && (scene.frames.is_requested() || scene.image.extent || !scene.picture.camera_file.empty()))
    throw RequestError(
        message("@size auto@ and @height auto@ fit a picture of one molecule whose camera is not given; "
                "give a size, or leave @frames@, @extent@ or @camera@ out"));
  constexpr int kAnyHeight = 12;
  if (const FontChoice& font = scene.annotations.letters.font; font != FontChoice())
    Font(kAnyHeight, Weight::regular, font);  // throws if there is no such font
  const auto has_color = [](const FigureObjectRequest& object) { return object.color.has_value(); };
  if (scene.legend.is_requested() && scene.molecule.color.by == ColorScheme::By::fixed &&
      scene.molecule.color.rules.empty() && std::ranges::none_of(scene.figure.objects, has_color))
    throw RequestError(message("@legend@ has nothing to explain: everything has one colour; choose another @color@"));
}

Framebuffer finished_picture(Framebuffer molecule, const Annotations& annotations, const PictureLayout& layout,
                             const Camera& camera, const std::optional<glm::vec3>& background, bool* lacks_labels) {
  const Strips& strips = layout.strips;
  if (strips.top + strips.bottom > 0)
    molecule = with_margin(molecule, molecule.size + glm::ivec2(0, strips.top + strips.bottom), strips.top,
                           layers_of(molecule));
  const bool is_whole = annotate(molecule, annotations, camera, background, strips);
  if (lacks_labels) *lacks_labels = !is_whole;
  return layout.legend ? layout.legend->add_to(molecule, background) : molecule;
}

SceneFigure made_figure(const Scene& requested, const EglContext* context) {
  if (requested.frames.is_requested())
    throw RequestError("frames: this call draws one molecule; `meniscus render` draws the frames of a run");
  if (requested.image.extent)
    throw RequestError("image.extent: this call draws the complete surface; use `meniscus render`");
  if (requested.picture.fits)
    throw RequestError("image.size, image.height: auto is for pictures of `meniscus render`; give a size");
  Scene scene = prepared_scene(requested);
  freeze_selections(scene);
  scene.molecule.surface.cpu = context == nullptr;
  const GivenCameras given = given_cameras(scene.picture, scene.run_camera);
  Structure structure = read_molecule(scene.molecule);
  ViewAim aim(scene.picture, scene.molecule.show, structure);
  Figure figure = make_figure(MoleculeBuilder(scene.molecule, context).build(std::move(structure)), scene.figure);
  return {std::move(scene), given, std::move(aim), std::move(figure)};
}

Framebuffer scene_picture(const Scene& requested, StillRenderer& renderer, const EglContext* context) {
  check_picture(requested);
  auto [scene, given, aim, figure] = made_figure(requested, context);
  const PictureLayout layout(scene, key_of(figure.molecule, scene.figure, figure.extras));
  const Camera camera = aim.camera(layout.size, given.still, aim.viewed(figure));
  Annotations annotations = annotations_of(scene.annotations, figure.molecule.structure, figure.extras.lengths());
  const Survey survey = survey_of(scene, figure.molecule.structure, camera, layout.size.size(), annotations);
  Framebuffer drawn = draw(renderer, std::move(figure), scene.figure, camera, render_settings(scene, layout), survey);
  return finished_picture(std::move(drawn), annotations, layout, camera, scene.image.background);
}

}  // namespace meniscus
