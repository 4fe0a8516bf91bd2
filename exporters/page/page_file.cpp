// SPDX-License-Identifier: BSD-3-Clause
// Combines descriptions, records, shaders and the page's own files into one text.
#include "exporters/page/page_file.h"

#include <cstring>

#include "core/base/version.h"
#include "core/gpu/shader_source.h"
#include "core/render/light_maps.h"
#include "core/render/picture_block.h"
#include "exporters/page/page_tables.h"
#include "exporters/page/page_templates.h"

namespace meniscus::page {
namespace {

using nlohmann::json;

constexpr int kMostSamples = 16;

json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Returns the words of a block of parameters of the kernels.
template <typename Block>
json words_of(const Block& block) {
  std::array<std::uint32_t, sizeof(Block) / sizeof(std::uint32_t)> words{};
  std::memcpy(words.data(), &block, sizeof block);
  return words;
}

/// Returns the name of a residue, such as "A THR 12", or of an atom without a residue.
std::string residue_of(const Atom& atom) {
  if (atom.residue_name.empty()) return fmt::format("atom {}", atom.index + 1);
  const std::string code = atom.insertion_code == ' ' ? std::string() : std::string(1, atom.insertion_code);
  return fmt::format("{}{}{} {}{}", atom.chain, atom.chain.empty() ? "" : " ", atom.residue_name, atom.residue_number,
                     code);
}

/// Returns a source without indentation and without lines that are comments alone.
std::string compact(std::string_view text) {
  std::string code;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    const std::size_t first = std::min(line.find_first_not_of(" \n"), line.size());
    if (!line.substr(first).starts_with("//")) code += line.substr(first);
  }
  return code;
}

/// Returns the shaders in GLSL ES 3.00 and the files that they include, by path; the page's script combines them.
json shaders() {
  const auto find = [](std::string_view wanted) -> std::optional<std::string_view> {
    for (const EmbeddedShader& shader : embedded_shaders())
      if (shader.path == wanted) return shader.text;
    return std::nullopt;
  };
  json sources = json::object();
  for (const char* const name : {"footprint.vert", "whole.vert", "cast.frag", "points.frag", "light.frag",
                                 "finish.frag", "present.frag", "layer_start.frag", "layer_event.frag",
                                 "layer_keep.frag", "layer_blend.frag", "layer_sum.frag", "cap_atom.frag"})
    for (const std::string& file : expand_shader(fmt::format("gpu_shaders/webgl/{}", name), find, {}).files)
      sources[file] = compact(find(file).value());
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

/// Returns a swatch as a drawing, because the page's policy forbids styles of its own.
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
  if (!key.classes.empty()) text += "<ul>";
  for (const ColorClass& entry : key.classes)
    text += fmt::format("<li>{}{}</li>", swatch(entry.color), markup_text(entry.name));
  if (!key.classes.empty()) text += "</ul>";
  for (const ColorKey& other : key.others) text += legend_of(other);
  return text;
}

/// Returns what light.js needs in addition to the tables.
json light_maps_of(const Tables& tables) {
  const auto size = [](const LightMapSize& maps, int count) -> json {
    return {{"finest_texel", maps.finest_texel}, {"largest_edge", maps.largest_edge}, {"count", count}};
  };
  return {{"sky", size(kSkyMapSize, kernel::kMostSkyAxes)},
          {"lamp", size(kLampMapSize, kernel::kMostLampPlaces)},
          {"margin", kLightMapMargin},
          {"step", kLightMapStep},
          {"mesh_ball", kMeshBallRadius},
          {"surfaces", tables.surfaces()}};
}

/// Returns which maps a look needs, the direction to the lamp in the picture, and its radius at distance 1.
json light_of(const Look& look) {
  return {{"maps_sky", look.maps_sky()},
          {"maps_lamp", look.maps_lamp()},
          {"direction", numbers(glm::normalize(glm::dvec3(look.light_direction)))},
          {"disc", std::tan(static_cast<double>(look.shadow_softness) * std::numbers::pi / 180.0)}};
}

/// Returns the parameters of light and finish.
json look_words(const PageFigure& figure, const Look& look, const Tables& tables) {
  const kernel::FinishParameters finish =
      finish_parameters(look, tables.placement(), figure.size, 0, tables.has_marks());
  return {{"cast", words_of(cast_parameters(tables.placement(), look, tables.atom_count(), tables.color_by_kind()))},
          {"finish", words_of(finish)},
          {"line_widths",
           {{"patch_lines", finish.patch_lines},
            {"outer_lines", finish.outer_lines},
            {"inner_lines", finish.inner_lines},
            {"part_lines", finish.part_lines},
            {"widest_line", finish.widest_line}}},
          {"light", light_of(look)},
          {"specular", look.material.specular}};
}

/// Returns the colour schemes. A scheme has a look if it differs from the figure's.
json schemes_of(const PageFigure& figure, const Tables& tables) {
  json schemes = json::array();
  const auto add = [&](const std::string& name, const ColorKey& key, bool by_kind, const std::optional<Look>& look) {
    schemes.push_back({{"name", name}, {"legend", legend_of(key)}, {"by_kind", by_kind}});
    if (look) schemes.back()["look"] = look_words(figure, *look, tables);
  };
  add(figure.scheme, figure.key, tables.color_by_kind(), std::nullopt);
  for (const PageScheme& scheme : figure.more_schemes)
    add(scheme.name, scheme.key, scheme.kind.has_value(), scheme.look);
  return schemes;
}

/// Returns the first view and those that readers can choose. origin: the origin of the records.
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

/// Returns the data for layers.js; null without a surface.
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
    labels.push_back({{"text", label.text}, {"point", numbers(label.position - tables.origin())}});
  const glm::vec3 background = look.background;
  return {{"title", figure.title},
          {"size", {figure.size.x, figure.size.y}},
          {"views", views_of(figure, tables.origin())},
          {"origin", numbers(tables.origin())},
          {"background", {background.x, background.y, background.z}},
          {"probe", tables.probe()},
          {"look", look_words(figure, look, tables)},
          {"light_maps", light_maps_of(tables)},
          {"has_shade", look.has_shade()},
          {"has_lines", look.widest_line() > 0.0f},
          {"line_step", look.line_step},
          {"fades_always", figure.fades_always},
          {"some_hidden", tables.some_hidden()},
          {"layers", layers_of(figure)},
          {"map", tables.map()},
          {"samples", samples},
          {"labels", labels},
          {"schemes", schemes_of(figure, tables)},
          {"names", names_of(figure.atoms)}};
}

std::string facts_of(const PageFigure& figure) {
  std::string text;
  for (const auto& [name, value] : figure.facts)
    text += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>", markup_text(name), markup_text(value));
  return text;
}

std::string still_of(const PageFigure& figure) {
  const std::vector<std::uint8_t>& bytes = figure.still.bytes;
  if (bytes.empty()) return {};
  return fmt::format("<img id=\"still\" src=\"data:{};base64,{}\" alt=\"{}\">", figure.still.type,
                     base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()}),
                     markup_text(figure.description));
}

}  // namespace

PackedFrame pack_frame(const PageFigure& figure, Packing packing) {
  const Tables tables(figure);
  return {std::make_shared<json>(description_of(figure, tables)),
          tables.packed(packing),
          figure.moment,
          {{"TITLE", markup_text(figure.title)},
           {"DESCRIPTION", markup_text(figure.description)},
           {"FACTS", facts_of(figure)},
           {"LEGEND", legend_of(figure.key)},
           {"STILL", still_of(figure)}}};
}

std::string bytes_for_page(const PackedFrame& frame, const std::set<std::string>& known) {
  PageData data;
  json description = *frame.description;
  const auto put = [&](json& entry, std::size_t stride, const std::string& bytes) {
    const std::string digest = fmt::format("{:016x}", std::hash<std::string>()(bytes));
    entry = {nullptr, stride, digest};
    if (!known.contains(digest)) entry[0] = data.add(bytes);
  };
  for (const PageTable& table : frame.tables) put(description["tables"][table.name], table.stride, table.packed);
  put(description["names"], 1, text_of(description["names"]));
  if (known.empty()) description["shaders"] = shaders();
  return data.bytes(text_of(description));
}

void PageWriter::add(PackedFrame frame) {
  moments_.push_back(std::move(frame.moment));
  json tables = json::object();
  for (PageTable& table : frame.tables) tables[table.name] = {data_.add(std::move(table.packed)), table.stride};
  (*frame.description)["tables"] = std::move(tables);
  frame.tables.clear();
  if (frames_.empty()) {
    first_ = std::move(frame);
    described_ = deflated(*first_.description).size();
    frames_.push_back(0);
    return;
  }
  json own = json::object();
  for (const auto& [name, value] : frame.description->items())
    if ((*first_.description)[name] != value) own[name] = value;
  frames_.push_back(data_.add(deflated(own)));
}

std::size_t PageWriter::bytes() const {
  constexpr double kLettersPerByte = 16.0 / 13.0 * 1.0005;  // the density of text_of_bytes(), with ends of lines
  constexpr std::size_t kOthers = 98'000;                   // scripts, style, shaders
  std::size_t texts = kOthers;
  for (const Filling& filling : first_.texts) texts += filling.text.size();
  return texts + static_cast<std::size_t>(kLettersPerByte * static_cast<double>(data_.size() + described_));
}

std::string PageWriter::text(const std::string& scene) const {
  json description = *first_.description;
  description["frames"] = frames_;
  description["moments"] = moments_;
  description["shaders"] = shaders();
  const std::string packed = data_.bytes(deflated(description));
  std::vector<Filling> texts = first_.texts;
  const auto fill = [&](const char* mark, std::string text) { texts.push_back({mark, std::move(text)}); };
  fill("VERSION", MENISCUS_VERSION);
  fill("POLICY", std::string(template_text(page_templates(), "policy.html")));
  fill("STYLE", fmt::format("<style>{}</style>", template_text(page_templates(), "page.css")));
  std::string in_html;  // text in which no "<" of the JSON can begin a tag
  for (const char letter : scene) in_html += letter == '<' ? std::string("\\u003c") : std::string(1, letter);
  fill("SCRIPT",
       fmt::format("<script type=\"application/json\" id=\"scene\">{}</script>\n<script>{}{}</script>", in_html,
                   template_text(page_templates(), "first.js"), template_text(page_templates(), "second.js")));
  fill("BYTES", std::to_string(packed.size()));
  fill("DATA", text_of_bytes(packed));
  return filled(template_text(page_templates(), "page.html"), texts);
}

std::string page_text(const PageFigure& figure) {
  PageWriter writer;
  writer.add(pack_frame(figure));
  return writer.text();
}

}  // namespace meniscus::page
