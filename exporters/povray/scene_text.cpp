// SPDX-License-Identifier: BSD-3-Clause
// Writes numbers, vectors and comments in the notation of POV-Ray, gathers the distinct colours of a scene, and writes
// volume maps as density files.
#include "exporters/povray/scene_text.h"

#include <iterator>

namespace meniscus::povray {
namespace {

constexpr int kLengthDecimals = 6;
constexpr int kRatioDecimals = 7;

void require_finite(double value) {
  if (!std::isfinite(value)) throw Error("POV-Ray export: a number of the surface is not finite");
}

}  // namespace

SceneText& SceneText::literal(std::string_view text) {
  text_ += text;
  return *this;
}

SceneText& SceneText::fixed(double value, int decimals) {
  require_finite(value);
  const std::size_t begin = text_.size();
  fmt::format_to(std::back_inserter(text_), "{:.{}f}", value, decimals);
  text_.erase(text_.find_last_not_of('0') + 1);
  if (text_.back() == '.') text_.pop_back();
  if (std::string_view(text_).substr(begin) == "-0") text_.erase(begin, 1);
  return *this;
}

SceneText& SceneText::length(double value) { return fixed(value, kLengthDecimals); }

SceneText& SceneText::ratio(double value) { return fixed(value, kRatioDecimals); }

SceneText& SceneText::full(double value) {
  require_finite(value);
  fmt::format_to(std::back_inserter(text_), "{:.17g}", value);
  return *this;
}

SceneText& SceneText::count(std::size_t value) {
  fmt::format_to(std::back_inserter(text_), "{}", value);
  return *this;
}

SceneText& SceneText::point(const glm::dvec3& p) {
  return literal("<").length(p.x).literal(",").length(p.y).literal(",").length(p.z).literal(">");
}

SceneText& SceneText::direction(const glm::dvec3& d) {
  return literal("<").ratio(d.x).literal(",").ratio(d.y).literal(",").ratio(d.z).literal(">");
}

SceneText& SceneText::full_vector(const glm::dvec3& v) {
  return literal("<").full(v.x).literal(",").full(v.y).literal(",").full(v.z).literal(">");
}

SceneText& SceneText::plane(const Plane& p, const glm::dvec3& anchor) {
  // POV-Ray normalizes the normal that it reads, so the rounded normal is normalized here, too.
  const double scale = std::pow(10.0, kRatioDecimals);
  glm::dvec3 rounded(std::round(p.normal.x * scale), std::round(p.normal.y * scale), std::round(p.normal.z * scale));
  rounded = glm::normalize(rounded);
  const double offset = p.offset + glm::dot(rounded - p.normal, anchor);
  return literal("plane{").direction(p.normal).literal(",").length(offset).literal("}");
}

namespace {

// Calls visit(kind, patch index, touched atoms) for every patch that has a face.
void for_each_patch(const Surface& surface, const auto& visit) {
  for (std::uint32_t n = 0; n < surface.convex.size(); ++n)
    if (surface.convex[n].face_count > 0) visit(PatchKind::convex, n, std::span(&surface.convex[n].atom, 1));
  if (surface.probe_radius == 0.0) return;
  for (std::uint32_t n = 0; n < surface.toroidal.size(); ++n)
    if (surface.toroidal[n].face_count > 0) visit(PatchKind::toroidal, n, std::span(surface.toroidal[n].atom));
  for (std::uint32_t n = 0; n < surface.concave.size(); ++n) {
    const ConcavePatch& c = surface.concave[n];
    const std::span contacts(surface.contacts.data() + c.first_contact, c.contact_count);
    if (c.face_count > 0) visit(PatchKind::concave, n, contacts);
  }
}

}  // namespace

std::uint32_t ColorTable::number(SceneColor color) {
  color.film = color.film && color.opacity < 1.0f;
  const auto [known, is_new] = number_.try_emplace(
      {color.color.x, color.color.y, color.color.z, color.opacity, color.by_map, color.film, color.finish},
      static_cast<std::uint32_t>(colors_.size()));
  if (is_new) colors_.push_back(color);
  return known->second;
}

bool ColorTable::is_translucent() const {
  return std::ranges::any_of(colors_, [](const SceneColor& color) { return color.opacity < 1.0f; });
}

SceneColor scene_color(const Coloring& coloring, std::uint32_t atom, const ObjectStyle& style,
                       const std::optional<glm::vec3>& color) {
  const float opacity = coloring.shows(atom) ? coloring.opacity_of(atom) : 1.0f;
  return {color.value_or(coloring.atom[atom]), opacity, !color && coloring.by_volume(atom), style.film, style.finish};
}

Palette make_palette(const Surface& surface, const Coloring& coloring, ColorTable& table, const ObjectStyle& style) {
  if (coloring.atom.size() != surface.atoms.size())
    throw Error("POV-Ray export: the coloring does not have one colour for each atom");
  Palette palette;
  // If patches are coloured by kind, they are split only where opacities differ.
  std::vector<float> opacities;
  const auto opacity_number = [&](float opacity) {
    const auto known = std::ranges::find(opacities, opacity);
    const auto place = static_cast<std::uint32_t>(known - opacities.begin());
    if (known == opacities.end()) opacities.push_back(opacity);
    return place;
  };
  for (std::uint32_t a = 0; a < surface.atoms.size(); ++a) {
    const SceneColor color = scene_color(coloring, a, style);
    const std::uint32_t shown = coloring.kind ? opacity_number(color.opacity) : table.number(color);
    palette.atom_part.push_back(coloring.shows(a) ? shown : kNone);
  }
  for_each_patch(surface, [&](PatchKind kind, std::uint32_t patch, std::span<const std::uint32_t> atoms) {
    std::vector<std::uint32_t> parts;
    for (const std::uint32_t a : atoms)
      if (coloring.shows(a)) parts.push_back(palette.atom_part[a]);
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    for (const std::uint32_t part : parts) {
      const std::uint32_t color = coloring.kind ? table.number({(*coloring.kind)[static_cast<std::size_t>(kind)],
                                                                opacities[part], false, style.film, style.finish})
                                                : part;
      palette.pieces.push_back({kind, color, part, patch, table.colors()[color].by_map});
    }
  });
  std::stable_sort(palette.pieces.begin(), palette.pieces.end(), [](const ColoredPiece& a, const ColoredPiece& b) {
    return std::tie(a.kind, a.color) < std::tie(b.kind, b.color);
  });
  return palette;
}

namespace {

constexpr std::size_t kLongestName = 40, kMostNames = 5;

bool is_letter_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

bool is_allowed(char c) {
  return is_letter_or_digit(c) || std::string_view(" _'*+-.,()").find(c) != std::string_view::npos;
}

std::string_view kind_name(PatchKind kind) {
  switch (kind) {
    case PatchKind::convex:
      return "convex";
    case PatchKind::toroidal:
      return "toroidal";
    case PatchKind::concave:
      break;
  }
  return "concave";
}

/// Returns the name if it is harmless, and an empty text otherwise. A harmless name has at most 40 bytes and consists
/// of ASCII letters and digits, blanks between them, and the characters _ ' * + - . , ( ), which occur in names of
/// atoms and classes. No other name is ever written into a scene.
std::string_view harmless_name(std::string_view name) {
  const bool harmless = !name.empty() && name.size() <= kLongestName && name.front() != ' ' && name.back() != ' ' &&
                        std::ranges::all_of(name, is_allowed) && std::ranges::any_of(name, is_letter_or_digit);
  return harmless ? name : std::string_view{};
}

}  // namespace

std::string color_comment(const ColorKey& key, const SceneColor& color) {
  if (color.by_map) return {};
  std::string names;
  std::size_t count = 0;
  for (const ColorClass& entry : key.classes) {
    if (entry.color != color.color || harmless_name(entry.name).empty()) continue;
    if (++count > kMostNames) break;
    names.append(count == 1 ? "" : ", ").append(entry.name);
  }
  for (const ColorKey& other : key.others)
    if (count == 0 && !color_comment(other, color).empty()) return color_comment(other, color);
  if (count == 0) return {};
  std::string comment = "  // ";
  if (!harmless_name(key.title).empty()) comment.append(key.title).append(" ");
  return comment + names + (count > kMostNames ? ", ..." : "");
}

std::string piece_comment(PatchKind kind, std::span<const std::uint32_t> atoms, std::span<const std::string> names) {
  std::string comment("// ");
  comment += kind_name(kind);
  for (std::size_t n = 0; n < atoms.size(); ++n) {
    const std::string_view name = atoms[n] < names.size() ? harmless_name(names[atoms[n]]) : std::string_view{};
    comment.append(n == 0 ? " " : "; ").append(name.empty() ? "?" : name);
  }
  return comment + "\n";
}

namespace {

constexpr std::size_t kFlushValues = std::size_t{1} << 18;
constexpr std::size_t kMostDensityPoints = 65'535;  // per axis
/// The number of steps of a colour map; POV-Ray's have at most 256 entries, and interpolate linear light.
constexpr std::size_t kMapSteps = 200;

/// Appends the lowest `count` bytes of a value in big-endian order.
void push_bytes(std::string& bytes, std::uint32_t value, int count) {
  for (int n = count - 1; n >= 0; --n) bytes.push_back(static_cast<char>(value >> 8 * n & 0xff));
}

}  // namespace

void write_density(const VolumeGrid& grid, const std::function<void(std::string_view)>& write) {
  const auto& size = grid.frame().size;
  if (std::ranges::any_of(size, [](std::size_t points) { return points > kMostDensityPoints; }))
    throw RequestError("--color-map-file: POV-Ray's density files have at most {} points along an axis",
                       with_thousands(kMostDensityPoints));
  const auto [low, high] = std::ranges::minmax(grid.values());
  const double width = static_cast<double>(high) - low;
  std::string bytes;
  for (const std::size_t points : size) push_bytes(bytes, static_cast<std::uint32_t>(points), 2);
  // The first axis of a density file runs fastest.
  for (std::size_t z = 0; z < size[2]; ++z)
    for (std::size_t y = 0; y < size[1]; ++y)
      for (std::size_t x = 0; x < size[0]; ++x) {
        const double value = grid.values()[(x * size[1] + y) * size[2] + z];
        const double share = width > 0.0 ? (value - low) / width : 0.0;
        push_bytes(bytes, static_cast<std::uint32_t>(std::llround(share * std::numeric_limits<std::uint32_t>::max())),
                   4);
        if (bytes.size() < 4 * kFlushValues) continue;
        write(bytes);
        bytes.clear();
      }
  write(bytes);
}

void append_map(SceneText& out, const VolumePaint& paint, std::string_view file, const glm::dvec3& origin) {
  const VolumeFrame& frame = paint.grid.frame();
  const std::array<double, 2>& range = paint.scale.range;
  const auto [low, high] = std::ranges::minmax(paint.grid.values());
  // A density file fills the unit cube with its n-th value of N at n/N. After the last value, the first is repeated.
  SceneText matrix;
  glm::dvec3 valid_extent(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto points = static_cast<double>(frame.size[axis]);
    valid_extent[axis] = (points - 1.0) / points;
    const glm::dvec3 edge = points * frame.step[axis];
    for (int k = 0; k < 3; ++k) matrix.full(edge[k]).literal(",");
  }
  const glm::dvec3 corner = frame.origin - origin;
  matrix.full(corner.x).literal(",").full(corner.y).literal(",").full(corner.z);
  SceneText colors;
  for (std::size_t n = 0; n <= kMapSteps; ++n) {
    const double share = static_cast<double>(n) / kMapSteps;
    colors.literal(n == 0 ? "" : ",\n").literal("    srgb ");
    colors.direction(glm::dvec3(paint.scale.color((1.0 - share) * range[0] + share * range[1])));
  }
  const auto text_of = [](const auto& append) {
    SceneText text;
    append(text);
    return text.text();
  };
  const auto number = [&](double value) { return text_of([&](SceneText& text) { text.full(value); }); };
  out.literal(
      filled(template_text(povray_templates(), "map.inc"),
             {{"LOW", number(low)},
              {"HIGH", number(high)},
              {"FROM", number(range[0])},
              {"TO", number(range[1])},
              {"MATRIX", matrix.text()},
              {"REACH", text_of([&](SceneText& text) { text.full_vector(valid_extent); })},
              {"MISSING", text_of([&](SceneText& text) { text.direction(glm::dvec3(paint.scale.missing_color)); })},
              {"COUNT", std::to_string(kMapSteps + 1)},
              {"COLORS", colors.text()},
              {"FILE", std::string(file)}}));
}

}  // namespace meniscus::povray
