// SPDX-License-Identifier: BSD-3-Clause
// Puts records, shaders and the page's own files into one text.
#include "exporters/page/page_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/gpu/shader_source.h"
#include "core/image/color_space.h"
#include "core/math/ball.h"
#include "core/render/linear_colors.h"
#include "core/render/picture_block.h"
#include "core/render/picture_object.h"
#include "core/render/ray_cast_scene.h"
#include "core/render/shape_packing.h"
#include "exporters/page/page_data.h"
#include "exporters/page/page_templates.h"

namespace meniscus::page {
namespace {

using nlohmann::json;

constexpr int kMostSamples = 16;
constexpr std::size_t kMostTexels = std::size_t{2048} * 8192;  // of a table

json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// The words of a block of parameters, as the kernels have it.
template <typename Block>
json words_of(const Block& block) {
  std::array<std::uint32_t, sizeof(Block) / sizeof(std::uint32_t)> words{};
  std::memcpy(words.data(), &block, sizeof block);
  return words;
}

/// What is rounded to this is stored in less room: Å, or a part of a unit vector.
constexpr float kRounding = 1.0f / (1 << 17);
/// What colours alone depend on: the borders between atoms, and how much fades at a depth.
constexpr float kColorRounding = 1.0f / (1 << 13);
/// What rounding may part neighbours by, who overlap by so much more.
constexpr float kRoundingSlack = 2.0f * kRounding;

float rounded(float value, float step = kRounding) { return std::round(value / step) * step; }

glm::vec3 rounded(const glm::vec3& v, float step) {
  return {rounded(v.x, step), rounded(v.y, step), rounded(v.z, step)};
}

/// of_atom: a direction, and the bits of an atom's number.
void round_row(glm::vec4& row, bool of_atom) {
  row = of_atom ? glm::vec4(rounded(glm::vec3(row), kColorRounding), row.w)
                : glm::vec4(rounded(glm::vec3(row), kRounding), rounded(row.w));
}

/// Coarser, and larger by as much.
glm::vec4 rounded_bound(const glm::vec4& bound) {
  constexpr float kSteps = 256.0f;  // an Å
  const glm::vec3 center = glm::round(glm::vec3(bound) * kSteps) / kSteps;
  return glm::vec4(center,
                   std::ceil((bound.w + glm::length(center - glm::vec3(bound)) + kRoundingSlack) * kSteps) / kSteps);
}

/// For tables that belong to no camera: all that is in them is in front.
PictureFrame frame_around(std::span<const Ball> balls) {
  glm::dvec3 low(0.0), high(0.0);
  for (std::size_t n = 0; n < balls.size(); ++n) {
    low = n == 0 ? balls[n].center : glm::min(low, balls[n].center);
    high = n == 0 ? balls[n].center : glm::max(high, balls[n].center);
  }
  constexpr double kFarAway = 1e7;  // Å
  PictureFrame frame;
  frame.pivot = 0.5 * (low + high);
  frame.eye_distance = kFarAway;
  frame.camera.projection = Projection::orthographic;
  frame.camera.target = frame.pivot;
  frame.camera.position = frame.pivot + glm::dvec3(0.0, 0.0, kFarAway);
  frame.basis = view_basis(frame.camera);
  return frame;
}

/// Whether planes cut the surface in any view.
bool has_cuts(const PageFigure& figure) {
  return !figure.clip.empty() || std::ranges::any_of(figure.views, [](const auto& view) { return !view.clip.empty(); });
}

/// "A THR 12", and the name of the atom alone.
std::string residue_of(const Atom& atom) {
  if (atom.residue_name.empty()) return fmt::format("atom {}", atom.index + 1);
  const std::string code = atom.insertion_code == ' ' ? std::string() : std::string(1, atom.insertion_code);
  return fmt::format("{}{}{} {}{}", atom.chain, atom.chain.empty() ? "" : " ", atom.residue_name, atom.residue_number,
                     code);
}

/// Everything that counts atoms does so here: those of the surface, then those of shapes.
class Tables {
 public:
  explicit Tables(const PageFigure& figure) : figure_(figure) {
    std::vector<PictureObject> objects;
    if (figure.surface) {
      objects.emplace_back().surface = &figure.surface->surface;
      objects.back().coloring = &figure.surface->coloring;
    }
    if (figure.shapes) {
      objects.emplace_back().shapes = &figure.shapes->shapes;
      objects.back().coloring = &figure.shapes->coloring;
    }
    const std::vector<Ball> balls = enclosing_balls(objects);
    frame_ = frame_around(balls);
    placement_ = place_atoms(balls, figure.surface ? figure.surface->surface.probe_radius : 0.0, frame_);
    placement_.slack += kRoundingSlack;
    for (const Ball& ball : balls)
      balls_.emplace_back(rounded(glm::vec3(ball.center - frame_.pivot), kColorRounding),
                          static_cast<float>(ball.radius));
    if (figure.surface) add_surface(*figure.surface);
    if (figure.shapes) add_shapes(*figure.shapes);
    round_tables();
    check_size(3 * scene_.primitives.size(), "primitives");
    check_size(scene_.rows.size(), "rows of numbers");
  }

  const PictureFrame& frame() const { return frame_; }
  const ScenePlacement& placement() const { return placement_; }
  std::uint32_t atom_count() const { return static_cast<std::uint32_t>(shown_.size()); }
  bool color_by_kind() const { return figure_.surface && figure_.surface->coloring.kind; }
  bool some_hidden() const { return some_hidden_; }
  bool has_marks() const {
    return std::ranges::any_of(marks_, [](std::uint32_t mark) { return mark != 0; });
  }

  void add_to(PageData& data) {
    std::vector<glm::vec4> colors = colors_;
    if (color_by_kind())
      for (const glm::vec3& color : *figure_.surface->coloring.kind) colors.emplace_back(linear_from_srgb(color), 1.0f);
    std::vector<ray_cast::Primitive> primitives = scene_.primitives;
    for (std::size_t n = primitives.size(); n-- > 1;) primitives[n].first_row -= primitives[n - 1].first_row;
    data.add<ray_cast::Primitive>("primitives", primitives);
    data.add<glm::vec4>("rows", scene_.rows);
    data.add<glm::vec4>("colors", colors);
    for (std::size_t n = 0; n < figure_.more_schemes.size(); ++n)
      data.add<std::uint32_t>(fmt::format("scheme_{}", n + 1), color_words(figure_.more_schemes[n]));
    data.add<std::uint32_t>("marks", marks_);
    data.add<std::uint32_t>("shown", shown_);
    data.add<glm::vec4>("balls", balls_);
  }

 private:
  /// sRGB, red lowest: of atoms, then of kinds.
  static std::vector<std::uint32_t> color_words(const PageScheme& scheme) {
    std::vector<std::uint32_t> words;
    words.reserve(scheme.colors.size() + 3);
    const auto add = [&](const glm::vec3& color) {
      words.push_back(
          static_cast<std::uint32_t>(display_byte(color.x) | display_byte(color.y) << 8 | display_byte(color.z) << 16));
    };
    for (const glm::vec3& color : scheme.colors) add(color);
    if (scheme.kind)
      for (const glm::vec3& color : *scheme.kind) add(color);
    return words;
  }

  void check_size(std::size_t texels, const char* what) const {
    if (texels > kMostTexels)
      throw CapacityError(fmt::format("a page holds at most {} texels of {}; this figure has {}. Show fewer atoms",
                                      with_thousands(kMostTexels), what, with_thousands(texels)));
  }

  void add_surface(const SurfaceObject& object) {
    // What planes cut is packed whole: the points of hidden atoms, too, tell what is solid.
    pack_scene(object.surface, has_cuts(figure_) ? Coloring() : object.coloring, frame_, scene_);
    add_atoms(object.coloring, object.atom);
  }

  void add_shapes(const ColoredShapes& shapes) {
    RayCastScene beside;
    beside.slack = placement_.slack;
    pack_shapes(shapes.shapes, shapes.coloring, frame_, beside.slack, beside);
    const auto first_row = static_cast<std::uint32_t>(scene_.rows.size());
    const std::uint32_t first_atom = atom_count();
    for (ray_cast::Primitive primitive : beside.primitives) {
      primitive.first_row += first_row;
      primitive.atom += first_atom;
      if (primitive.kind == ray_cast::kCylinder) primitive.second_atom += first_atom;
      // A sphere of its own is told from the patch of an atom by its index.
      primitive.patch_index = kShapeIndex;
      if (primitive.kind == ray_cast::kTriangle)
        for (std::uint32_t corner = 3; corner < 6; ++corner) {
          float& atom = beside.rows[primitive.first_row - first_row + corner].w;
          atom = std::bit_cast<float>(std::bit_cast<std::uint32_t>(atom) + first_atom);
        }
      scene_.primitives.push_back(primitive);
    }
    scene_.rows.insert(scene_.rows.end(), beside.rows.begin(), beside.rows.end());
    std::vector<std::uint32_t> all(shapes.coloring.atom.size());
    for (std::uint32_t n = 0; n < all.size(); ++n) all[n] = n;
    add_atoms(shapes.coloring, all);
  }

  void add_atoms(const Coloring& coloring, std::span<const std::uint32_t> shown) {
    Coloring atoms = coloring;
    atoms.kind.reset();
    const std::vector<glm::vec4> colors = linear_colors(atoms);
    colors_.insert(colors_.end(), colors.begin(), colors.end());
    std::vector<std::uint32_t> marks = coloring.line_marks();
    marks.resize(shown.size(), 0);
    marks_.insert(marks_.end(), marks.begin(), marks.end());
    shown_.insert(shown_.end(), shown.begin(), shown.end());
    some_hidden_ = some_hidden_ || coloring.hides_some();
  }

  /// What no page asks for is 0: it depends on a camera, or decides between points at one depth.
  void round_tables() {
    for (ray_cast::Primitive& primitive : scene_.primitives) {
      const bool is_concave = primitive.kind == ray_cast::kConcave, is_triangle = primitive.kind == ray_cast::kTriangle;
      const std::uint32_t rows = is_triangle ? 6 : primitive.kind == ray_cast::kCylinder ? 2 : row_count(primitive);
      for (std::uint32_t n = 0; n < rows; ++n)
        round_row(scene_.rows[primitive.first_row + n],
                  (is_concave && n > primitive.plane_count) || (is_triangle && n > 2));
      primitive.bound = rounded_bound(primitive.bound);
      primitive.nearest = 0.0f;
      primitive.tie_key = 0;
      if (primitive.patch_index != kShapeIndex) primitive.patch_index = 0;
    }
  }

  static constexpr std::uint32_t kShapeIndex = 0xffffffffu;

  const PageFigure& figure_;
  PictureFrame frame_;
  ScenePlacement placement_;
  RayCastScene scene_;
  std::vector<glm::vec4> colors_, balls_;
  std::vector<std::uint32_t> marks_, shown_;
  bool some_hidden_ = false;
};

/// Without lines that are comments alone.
std::string without_comments(std::string_view text) {
  std::string code;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    if (!line.substr(std::min(line.find_first_not_of(' '), line.size() - 1)).starts_with("//")) code += line;
    text.remove_prefix(end);
  }
  return code;
}

/// The shaders in GLSL ES 3.00 and what they include, by their paths; the page's script puts them together.
json shaders() {
  const auto find = [](std::string_view wanted) -> std::optional<std::string_view> {
    for (const EmbeddedShader& shader : embedded_shaders())
      if (shader.path == wanted) return shader.text;
    return std::nullopt;
  };
  json sources = json::object();
  for (const char* const name : {"footprint.vert", "whole.vert", "cast.frag", "points.frag", "occlusion.frag",
                                 "finish.frag", "present.frag", "layer_start.frag", "layer_event.frag",
                                 "layer_keep.frag", "layer_blend.frag", "layer_sum.frag", "cap_atom.frag"})
    for (const std::string& file : expand_shader(fmt::format("gpu_shaders/webgl/{}", name), find, {}).files)
      sources[file] = without_comments(find(file).value());
  return sources;
}

json names_of(std::span<const Atom> atoms) {
  json residues = json::array(), starts = json::array(), names = json::array(), chains = json::array();
  std::string last;
  for (std::size_t n = 0; n < atoms.size(); ++n) {
    names.push_back(atoms[n].name);
    std::string residue = residue_of(atoms[n]);
    if (n > 0 && residue == last) continue;
    residues.push_back(residue);
    chains.push_back(atoms[n].chain);
    starts.push_back(n);
    last = std::move(residue);
  }
  return {{"residues", residues}, {"chains", chains}, {"starts", starts}, {"atoms", names}};
}

json camera_of(const Camera& camera, const glm::dvec3& origin) {
  const ViewBasis basis = view_basis(camera);
  return {{"position", numbers(camera.position - origin)},
          {"target", numbers(camera.target - origin)},
          {"up", numbers(basis.up)},
          {"orthographic", camera.projection == Projection::orthographic},
          {"fov", camera.vertical_fov},
          {"height", camera.height}};
}

std::string hex_color(const glm::vec3& color) {
  const auto byte = [](float channel) { return std::lround(255.0f * std::clamp(channel, 0.0f, 1.0f)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(color.x), byte(color.y), byte(color.z));
}

/// Swatches are drawings: a style of their own the page's policy would refuse.
std::string swatch(const glm::vec3& color) {
  return fmt::format(
      R"(<svg class="swatch" viewBox="0 0 1 1" aria-hidden="true"><rect width="1" height="1" fill="{}"/></svg>)",
      hex_color(color));
}

std::string bar(const ColorScale& scale) {
  constexpr int kSteps = 64;
  std::string text =
      fmt::format(R"(<svg class="bar" viewBox="0 0 {} 4" preserveAspectRatio="none" aria-hidden="true">)", kSteps);
  for (int n = 0; n < kSteps; ++n) {
    const double number = scale.range[0] + (scale.range[1] - scale.range[0]) * (n + 0.5) / kSteps;
    text += fmt::format(R"(<rect x="{}" width="1.1" height="4" fill="{}"/>)", n, hex_color(scale.color(number)));
  }
  return text + "</svg>";
}

std::string legend_of(const ColorKey& key) {
  std::string text;
  if (key.scale && key.scale->classes.empty()) {
    const ColorScale& scale = *key.scale;
    const auto end = [&](int n) {
      return scale.ends[n].empty() ? fmt::format("{:.4g}", scale.range[n])
                                   : fmt::format("{:.4g} {}", scale.range[n], markup_text(scale.ends[n]));
    };
    text += fmt::format("<p>{}{}</p><p class=\"scale\"><span>{}</span>{}<span>{}</span></p>", markup_text(scale.title),
                        scale.unit.empty() ? "" : ", " + markup_text(scale.unit), end(0), bar(scale), end(1));
  } else if (!key.classes.empty()) {
    text += fmt::format("<p>{}</p>", markup_text(key.scale ? key.scale->title : key.title));
  }
  if (key.classes.empty()) return text;
  text += "<ul>";
  for (const ColorClass& entry : key.classes)
    text += fmt::format("<li>{}{}</li>", swatch(entry.color), markup_text(entry.name));
  return text + "</ul>";
}

json schemes_of(const PageFigure& figure, bool by_kind) {
  json schemes = json::array();
  schemes.push_back({{"name", figure.scheme}, {"legend", legend_of(figure.key)}, {"by_kind", by_kind}});
  for (const PageScheme& scheme : figure.more_schemes)
    schemes.push_back({{"name", scheme.name}, {"legend", legend_of(scheme.key)}, {"by_kind", scheme.kind.has_value()}});
  return schemes;
}

/// The first view, and those that readers choose. origin: from where the records count.
json views_of(const PageFigure& figure, const glm::dvec3& origin) {
  json views = json::array();
  const auto add = [&](const PageView& view) {
    json planes = json::array(), hatching = json::array();
    for (const ClipPlane& plane : view.clip) {
      const glm::dvec3& n = plane.normal;
      planes.push_back({n.x, n.y, n.z, plane.offset - glm::dot(n, origin)});
      const double distance = std::sqrt(2.0) * figure.cap.hatching;
      const glm::dvec3 across = figure.cap.hatching > 0.0 ? hatching_direction(n) / distance : glm::dvec3(0.0);
      const double phase = glm::dot(origin, across);
      hatching.push_back({across.x, across.y, across.z, phase - std::floor(phase)});
    }
    views.push_back({{"name", view.name},
                     {"camera", camera_of(view.camera, origin)},
                     {"planes", planes},
                     {"hatching", hatching},
                     {"opacity", view.opacity},
                     {"looks_inside", view.looks_inside}});
  };
  add({"First view", figure.camera, figure.clip});
  for (const PageView& view : figure.views) add(view);
  return views;
}

/// What layers.js asks for; null without a surface.
json layers_of(const PageFigure& figure) {
  if (!figure.surface) return nullptr;
  const SurfaceObject& object = *figure.surface;
  const glm::vec3 cap = linear_from_srgb(figure.cap.color.value_or(glm::vec3(0.0f)));
  double largest = 0.0;
  for (const Ball& ball : object.surface.atoms) largest = std::max(largest, ball.radius);
  return {{"hatched_look", {kHatchedShare, kHatchedLight}},
          {"cap_color", {cap.x, cap.y, cap.z, figure.cap.color ? 1 : 0}},
          {"thickens", figure.thickens ? 1 : 0},
          {"seen_through", object.coloring.is_translucent() ? 1 : 0},
          {"whole", has_cuts(figure) || !object.coloring.hides_some()},
          {"specular", figure.look.material.specular},
          {"surface_atoms", object.surface.atoms.size()},
          {"largest_ball", largest},
          {"probe", object.surface.probe_radius}};
}

json description_of(const PageFigure& figure, const Tables& tables) {
  const Look& look = figure.look;
  json samples = json::array();
  for (int n = 0; n < kMostSamples; ++n) samples.push_back({sample_offset(n).x, sample_offset(n).y});
  json labels = json::array();
  for (const PlaceLabel& label : figure.labels)
    labels.push_back({{"text", label.text}, {"point", numbers(label.position - tables.frame().pivot)}});
  const glm::vec3 background = look.background;
  return {{"title", figure.title},
          {"size", {figure.size.x, figure.size.y}},
          {"views", views_of(figure, tables.frame().pivot)},
          {"origin", numbers(tables.frame().pivot)},
          {"background", {background.x, background.y, background.z}},
          {"cast", words_of(cast_parameters(tables.placement(), look, tables.atom_count(), tables.color_by_kind()))},
          {"occlusion", words_of(occlusion_parameters(look, figure.size, 0))},
          {"finish", words_of(finish_parameters(look, tables.placement(), figure.size, 0, tables.has_marks()))},
          {"has_shade", look.ambient_occlusion > 0.0f},
          {"has_lines", look.widest_line() > 0.0f},
          {"line_step", look.line_step},
          {"fades_always", figure.fades_always},
          {"some_hidden", tables.some_hidden()},
          {"layers", layers_of(figure)},
          {"samples", samples},
          {"samples_of_shade", kSamplesOfShade},
          {"labels", labels},
          {"schemes", schemes_of(figure, tables.color_by_kind())},
          {"names", names_of(figure.atoms)},
          {"shaders", shaders()}};
}

std::string facts_of(const PageFigure& figure) {
  std::string text;
  for (const auto& [name, value] : figure.facts)
    text += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>", markup_text(name), markup_text(value));
  return text;
}

}  // namespace

std::string page_text(const PageFigure& figure) {
  Tables tables(figure);
  PageData data;
  tables.add_to(data);
  const std::string packed = data.deflated(description_of(figure, tables));
  const auto file = [](std::string_view path) { return template_text(page_templates(), path); };
  const StillPicture& drawn = figure.still;
  const std::string_view picture(reinterpret_cast<const char*>(drawn.bytes.data()), drawn.bytes.size());
  const std::string still = picture.empty() ? std::string()
                                            : fmt::format("<img id=\"still\" src=\"data:{};base64,{}\" alt=\"{}\">",
                                                          drawn.type, base64(picture), markup_text(figure.description));
  return filled(file("page.html"), {{"TITLE", markup_text(figure.title)},
                                    {"VERSION", MENISCUS_VERSION},
                                    {"STYLE", std::string(file("page.css"))},
                                    {"SCRIPT", std::string(file("page.js"))},
                                    {"DESCRIPTION", markup_text(figure.description)},
                                    {"FACTS", facts_of(figure)},
                                    {"LEGEND", legend_of(figure.key)},
                                    {"STILL", still},
                                    {"BYTES", std::to_string(packed.size())},
                                    {"DATA", text_of_bytes(packed)}});
}

}  // namespace meniscus::page
