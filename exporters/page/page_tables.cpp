// SPDX-License-Identifier: BSD-3-Clause
// Packs the records of a figure around one point, without a camera, rounds them, and predicts the rows of patches from
// atoms and from earlier rows.
#include "exporters/page/page_tables.h"

#include <bit>
#include <tuple>

#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "core/render/ray_geometry.h"

namespace meniscus::page {
namespace {

constexpr std::size_t kMostTexels = std::size_t{2048} * 8192;  // limit of a table
/// Flags of a primitive, stored in its index: next to the surface, and with its own colours. Shapes have both.
constexpr std::uint32_t kIsBeside = 1, kHasOwnColors = 2, kShapeIndex = 0xffffffffu;
constexpr std::size_t kMapColors = 1024;  // colours in the scale of a volume map
constexpr double kMapSteps = 1 << 14;     // steps over the range, to which values are rounded

/// Neighbours overlap by so much more, because rounding may separate them.
constexpr float kRoundingSlack = 2.0f * kRounding;

float rounded(float value, float step = kRounding) { return std::round(value / step) * step; }

glm::vec3 rounded(const glm::vec3& v, float step) {
  return {rounded(v.x, step), rounded(v.y, step), rounded(v.z, step)};
}

/// Rounds a row. of_atom: true if the row is a direction and the bits of an atom's number.
void round_row(glm::vec4& row, bool of_atom) {
  row = of_atom ? glm::vec4(rounded(glm::vec3(row), kColorRounding), row.w)
                : glm::vec4(rounded(glm::vec3(row), kRounding), rounded(row.w));
}

/// Returns a bound that is rounded to coarser steps, and larger by the rounding error.
glm::vec4 rounded_bound(const glm::vec4& bound) {
  constexpr float kSteps = 256.0f;  // steps per Å
  const glm::vec3 center = glm::round(glm::vec3(bound) * kSteps) / kSteps;
  return glm::vec4(center,
                   std::ceil((bound.w + glm::length(center - glm::vec3(bound)) + kRoundingSlack) * kSteps) / kSteps);
}

glm::dvec3 middle_of(std::span<const Ball> balls) {
  glm::dvec3 low(0.0), high(0.0);
  for (std::size_t n = 0; n < balls.size(); ++n) {
    low = n == 0 ? balls[n].center : glm::min(low, balls[n].center);
    high = n == 0 ? balls[n].center : glm::max(high, balls[n].center);
  }
  return 0.5 * (low + high);
}

/// Returns a frame for tables without a camera, in which everything is in front.
PictureFrame frame_around(const glm::dvec3& pivot) {
  constexpr double kFarAway = 1e7;  // Å
  PictureFrame frame;
  frame.pivot = pivot;
  frame.eye_distance = kFarAway;
  frame.camera.projection = Projection::orthographic;
  frame.camera.target = frame.pivot;
  frame.camera.position = frame.pivot + glm::dvec3(0.0, 0.0, kFarAway);
  frame.basis = view_basis(frame.camera);
  return frame;
}

/// Returns the radius of all probes that are not 0.
double probe_of(const PageFigure& figure) {
  double probe = figure.surface ? figure.surface->surface.probe_radius : 0.0;
  for (const PageObject& object : figure.extras)
    if (object.surface) probe = std::max(probe, object.surface->surface.probe_radius);
  return probe;
}

/// Returns colours as sRGB words, red lowest: of atoms, then of kinds of patch.
std::vector<std::uint32_t> color_words(const PageScheme& scheme) {
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

}  // namespace

bool has_cuts(const PageFigure& figure) {
  return !figure.clip.empty() || std::ranges::any_of(figure.views, [](const auto& view) { return !view.clip.empty(); });
}

Tables::Tables(const PageFigure& figure) : figure_(figure), probe_(probe_of(figure)) {
  std::vector<PictureObject> objects;
  if (figure.surface) {
    objects.emplace_back().surface = &figure.surface->surface;
    objects.back().coloring = &figure.surface->coloring;
  }
  for (const PageObject& object : figure.extras) {
    PictureObject& made = objects.emplace_back();
    if (object.surface) made.surface = &object.surface->surface;
    if (object.shapes) made.shapes = &object.shapes->shapes;
    made.coloring = object.surface ? &object.surface->coloring : &object.shapes->coloring;
  }
  const std::vector<Ball> balls = enclosing_balls(objects);
  frame_ = frame_around(figure.origin.value_or(middle_of(balls)));
  placement_ = place_atoms(balls, probe_, frame_);
  placement_.slack += kRoundingSlack;
  for (const Ball& ball : balls)
    balls_.emplace_back(rounded(glm::vec3(ball.center - frame_.pivot), kColorRounding),
                        static_cast<float>(ball.radius));
  find_surfaces(objects);
  // A surface that planes cut is packed completely, because points of hidden atoms determine what is solid.
  if (figure.surface) add_surface(*figure.surface, has_cuts(figure), figure.has_own_colors ? kHasOwnColors : 0);
  for (const PageObject& object : figure.extras) {
    if (object.surface)
      add_surface(*object.surface, false, kIsBeside | (object.has_own_colors ? kHasOwnColors : 0));
    else
      add_shapes(*object.shapes);
  }
  add_map();
  round_tables();
  check_size(map_.size(), "a volume map");
  check_size(3 * scene_.primitives.size(), "primitives");
  check_size(scene_.rows.size(), "rows of numbers");
}

bool Tables::has_marks() const {
  return std::ranges::any_of(marks_, [](std::uint32_t mark) { return mark != 0; });
}

std::vector<PageTable> Tables::packed(Packing packing) const {
  std::vector<glm::vec4> colors = colors_;
  if (kind_)
    for (const glm::vec3& color : *kind_) colors.emplace_back(linear_from_srgb(color), 1.0f);
  std::vector<ray_cast::Primitive> primitives = scene_.primitives;
  for (std::size_t n = primitives.size(); n-- > 1;) primitives[n].first_row -= primitives[n - 1].first_row;
  std::vector<PageTable> tables;
  const auto add = [&](std::string_view name, const auto& records) {
    tables.push_back(page_table(name, records, packing));
  };
  add("primitives", primitives);
  if (packing == Packing::plain)
    add("rows", scene_.rows);
  else
    add("rows", row_differences(scene_, balls_of_atoms(), probe_));
  add("colors", colors);
  for (std::size_t n = 0; n < figure_.more_schemes.size(); ++n)
    add(fmt::format("scheme_{}", n + 1), color_words(figure_.more_schemes[n]));
  add("marks", marks_);
  add("shown", shown_);
  add("balls", balls_);
  if (!map_.empty()) add("map", map_);
  return tables;
}

std::vector<glm::vec4> Tables::balls_of_atoms() const {
  std::vector<glm::vec4> balls(shown_.size(), glm::vec4(0.0f));
  for (const auto& [first_ball, first_atom, count] : surfaces_)
    std::copy_n(balls_.begin() + first_ball, count, balls.begin() + first_atom);
  return balls;
}

void Tables::add_map() {
  if (!paint_) return;
  const ColorScale& scale = paint_->scale;
  const auto add = [&](float number) { map_.push_back(std::bit_cast<std::uint32_t>(number)); };
  const auto add_color = [&](double number) {
    const glm::vec3 color = linear_from_srgb(scale.color(number));
    for (int n = 0; n < 3; ++n) add(color[n]);
  };
  for (std::size_t n = 0; n < kMapColors; ++n)
    add_color(scale.range[0] + (scale.range[1] - scale.range[0]) * static_cast<double>(n) / (kMapColors - 1));
  add_color(std::numeric_limits<double>::quiet_NaN());
  map_atoms_ = map_.size();
  map_.insert(map_.end(), has_color_.begin(), has_color_.end());
  map_values_ = map_.size();
  // These steps are finer than visible differences of colours.
  const auto step = static_cast<float>(std::max((scale.range[1] - scale.range[0]) / kMapSteps, 1e-30));
  map_.reserve(map_.size() + paint_->grid.values().size());
  for (const float value : paint_->grid.values()) add(rounded(value, step));
}

nlohmann::json Tables::map() const {
  if (map_.empty()) return nullptr;
  const VolumePaint& paint = *paint_;
  const VolumeFrame& grid = paint.grid.frame();
  const glm::dmat3 to_index = glm::inverse(grid.step);
  const glm::dvec3 first = to_index * (origin() - grid.origin);
  nlohmann::json axes = nlohmann::json::array();
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) axes.push_back(to_index[k][axis]);
    axes.push_back(first[axis]);
  }
  const auto& [low, high] = paint.scale.range;
  // If all numbers are equal, they have the colour in the middle.
  const double share = high > low ? 1.0 / (high - low) : 0.0;
  return {{"axes", axes},
          {"size", grid.size},
          {"scale", {low, share, paint.offset}},
          {"parts", {3 * kMapColors, map_atoms_, map_values_}}};
}

/// Adds a surface. whole: true to include patches that touch hidden atoms only. place: the flags of its primitives.
void Tables::add_surface(const SurfaceObject& object, bool whole, std::uint32_t place) {
  add_records(pack_scene(object.surface, whole ? Coloring() : object.coloring, frame_), place);
  if (object.coloring.volume) paint_ = object.coloring.volume;
  if (object.coloring.kind && !(place & kHasOwnColors)) kind_ = object.coloring.kind;
  const std::uint32_t first_atom = atom_count();
  add_atoms(object.coloring, object.atom);
  for (std::uint32_t a = 0; a < object.atom.size(); ++a)
    if (object.coloring.by_volume(a)) has_color_[first_atom + a] = 0;
}

void Tables::add_shapes(const ColoredShapes& shapes) {
  RayCastPack extras;
  pack_shapes(shapes.shapes, shapes.coloring, frame_, placement_.slack, extras);
  // The index distinguishes a separate sphere from the patch of an atom.
  add_records(std::move(extras), kShapeIndex);
  std::vector<std::uint32_t> all(shapes.coloring.atom.size());
  for (std::uint32_t n = 0; n < all.size(); ++n) all[n] = n;
  add_atoms(shapes.coloring, all);
}

/// Appends records after those that exist.
void Tables::add_records(RayCastPack more, std::uint32_t place) {
  const auto first_row = static_cast<std::uint32_t>(scene_.rows.size());
  const std::uint32_t first_atom = atom_count();
  const auto rename = [&](std::uint32_t row) {
    float& atom = more.rows[row].w;
    atom = std::bit_cast<float>(std::bit_cast<std::uint32_t>(atom) + first_atom);
  };
  for (ray_cast::Primitive primitive : more.primitives) {
    const std::uint32_t first = primitive.first_row, kind = primitive.kind;
    if (kind == ray_cast::kTriangle)
      for (std::uint32_t corner = 3; corner < 6; ++corner) rename(first + corner);
    if (kind == ray_cast::kConcave)  // its `atom` is the number of contacts
      for (std::uint32_t n = 1 + primitive.plane_count; n < row_count(primitive); ++n) rename(first + n);
    else
      primitive.atom += first_atom;
    if (kind == ray_cast::kToroidal || kind == ray_cast::kCylinder) primitive.second_atom += first_atom;
    primitive.first_row += first_row;
    primitive.patch_index = place;
    scene_.primitives.push_back(primitive);
  }
  scene_.rows.insert(scene_.rows.end(), more.rows.begin(), more.rows.end());
}

void Tables::add_atoms(const Coloring& coloring, std::span<const std::uint32_t> shown) {
  Coloring atoms = coloring;
  atoms.kind.reset();
  const std::vector<glm::vec4> colors = linear_colors(atoms);
  colors_.insert(colors_.end(), colors.begin(), colors.end());
  std::vector<std::uint32_t> marks = coloring.line_marks();
  marks.resize(shown.size(), 0);
  marks_.insert(marks_.end(), marks.begin(), marks.end());
  shown_.insert(shown_.end(), shown.begin(), shown.end());
  has_color_.resize(shown_.size(), 1);
  some_hidden_ = some_hidden_ || coloring.hides_some();
}

/// Rounds the tables, and clears numbers that depend on a camera or decide between points at one depth.
void Tables::round_tables() {
  for (ray_cast::Primitive& primitive : scene_.primitives) {
    const bool is_concave = primitive.kind == ray_cast::kConcave, is_triangle = primitive.kind == ray_cast::kTriangle;
    const std::uint32_t rows = is_triangle ? 6 : primitive.kind == ray_cast::kCylinder ? 2 : row_count(primitive);
    for (std::uint32_t n = 0; n < rows; ++n)
      round_row(scene_.rows[primitive.first_row + n],
                (is_concave && n > primitive.plane_count) || (is_triangle && n > 2));
    primitive.bound = rounded_bound(primitive.bound);
    primitive.nearest = 0.0f;
    primitive.tie_key = 0;
  }
}

void Tables::find_surfaces(std::span<const PictureObject> objects) {
  std::size_t first_ball = 0, first_atom = 0;
  for (const PictureObject& object : objects) {
    const std::size_t balls = enclosing_balls({&object, 1}).size();
    if (object.surface) surfaces_.push_back({first_ball, first_atom, balls});
    first_ball += balls;
    first_atom += object.surface ? balls : object.coloring->atom.size();
  }
}

void Tables::check_size(std::size_t texels, const char* what) const {
  if (texels > kMostTexels)
    throw CapacityError("a page holds at most {} texels of {}; this figure has {}. Show fewer atoms",
                        with_thousands(kMostTexels), what, with_thousands(texels));
}

namespace {

constexpr double kTurnSteps = 1 << 18;  // steps of angles per radian

class RowPredictor {
 public:
  RowPredictor(const RayCastPack& scene, std::vector<glm::vec4> balls, double probe)
      : scene_(scene), balls_(std::move(balls)), probe_(probe), words_(scene.rows.size()) {
    for (std::size_t n = 0; n < words_.size(); ++n) words_[n] = std::bit_cast<RowWords>(scene.rows[n]);
  }

  std::vector<RowWords> run() {
    for (const bool convex : {true, false})  // rows of convex patches have the exact centres of their atoms
      for (const ray_cast::Primitive& primitive : scene_.primitives)
        if ((primitive.kind == ray_cast::kConvex) == convex) predict(primitive);
    for (RowWords& row : words_)
      for (std::uint32_t& word : row) word = word << 1 ^ (word >> 31 ? ~0u : 0u);
    return sorted();
  }

 private:
  glm::dvec3 vector(std::uint32_t row) const { return glm::dvec3(glm::vec3(scene_.rows[row])); }

  void predict(std::uint32_t row, std::initializer_list<double> values, double step = kRounding) {
    std::size_t n = 0;
    for (const double value : values) {
      const double known = std::isfinite(value) ? value : 0.0;
      words_[row][n++] -= std::bit_cast<std::uint32_t>(static_cast<float>(std::floor(known / step + 0.5) * step));
    }
  }

  void predict(const ray_cast::Primitive& primitive) {
    const std::uint32_t first = primitive.first_row;
    if (primitive.kind == ray_cast::kConvex) {
      glm::vec4& ball = balls_[primitive.atom];
      predict(first, {ball.x, ball.y, ball.z, ball.w});
      ball = scene_.rows[first];
    }
    if (primitive.kind == ray_cast::kToroidal)
      predict_toroidal(first, balls_[primitive.atom], balls_[primitive.second_atom]);
    if (primitive.kind == ray_cast::kConcave) predict_concave(first, primitive.plane_count, primitive.atom);
  }

  void predict_toroidal(std::uint32_t first, const glm::dvec4& a, const glm::dvec4& b) {
    const glm::dvec3 between = glm::dvec3(b) - glm::dvec3(a);
    const double distance = std::sqrt(glm::dot(between, between)), a_out = a.w + probe_, b_out = b.w + probe_;
    const double a_z = -0.5 * (distance + (a_out - b_out) * (a_out + b_out) / distance), b_z = a_z + distance;
    const glm::dvec3 center = glm::dvec3(a) - between / distance * a_z;
    predict(first, {center.x, center.y, center.z, std::sqrt(std::max((a_out - a_z) * (a_out + a_z), 0.0))});
    predict(first + 2, {between.x / distance, between.y / distance, between.z / distance});
    const auto shape = geometry::saddle_shape(a_z, b_z, a.w, b.w, double{scene_.rows[first].w}, probe_);
    predict(first + 3, {shape.contact_z[0], shape.contact_z[1], shape.clip_z, shape.clip_radius});
    predict(first + 4, {a_z, a_out, b_z, b_out});
    // The start is perpendicular to the axis, so that one angle gives it; another is that from start to end.
    const glm::dvec3 axis = vector(first + 2), start = vector(first + 1), x = perpendicular_to(axis);
    const auto steps = [](double sine, double cosine) {
      const double angle = std::atan2(sine, cosine);
      return static_cast<std::uint32_t>(std::lround((angle < 0 ? angle + 2 * std::numbers::pi : angle) * kTurnSteps));
    };
    words_[first + 1] = {steps(glm::dot(glm::cross(axis, x), start), glm::dot(x, start)),
                         steps(scene_.rows[first + 2].w, scene_.rows[first + 1].w), 0, 0};
    words_[first + 2][3] = 0;
  }

  /// Returns a vector at a right angle to the axis and to the coordinate axis that is farthest from it.
  static glm::dvec3 perpendicular_to(const glm::dvec3& axis) {
    const glm::dvec3 size = glm::abs(axis);
    glm::dvec3 far(0.0);
    far[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1.0;
    return unit(glm::cross(axis, far));
  }
  static glm::dvec3 unit(const glm::dvec3& v) { return v * (1.0 / std::sqrt(glm::dot(v, v))); }

  void predict_concave(std::uint32_t first, std::uint32_t planes, std::uint32_t contacts) {
    predict(first, {0.0, 0.0, 0.0, probe_});
    std::vector<glm::dvec3> directions;
    for (std::uint32_t row = first + 1 + planes; row < first + 1 + planes + contacts; ++row) {
      const auto atom = std::bit_cast<std::uint32_t>(scene_.rows[row].w);
      const glm::dvec3 d = directions.emplace_back(unit(glm::dvec3(balls_[atom]) - vector(first)));
      predict(row, {d.x, d.y, d.z}, kColorRounding);
    }
    for (std::uint32_t n = 0; n < contacts; ++n) {
      const glm::dvec3 side = unit(glm::cross(directions[n], directions[n + 1 < contacts ? n + 1 : 0]));
      predict(first + 1 + n, {side.x, side.y, side.z});
    }
  }

  std::vector<RowWords> sorted() const {
    std::array<std::vector<RowWords>, 25> groups;
    const auto& primitives = scene_.primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const auto& [kind, planes, contacts] =
          std::tie(primitives[p].kind, primitives[p].plane_count, primitives[p].atom);
      const std::size_t end = p + 1 < primitives.size() ? primitives[p + 1].first_row : words_.size();
      for (std::size_t row = primitives[p].first_row, n = 0; row < end; ++row, ++n) {
        const std::size_t part = kind == ray_cast::kConcave && n > 1 ? (n > planes     ? 4
                                                                        : n > contacts ? 3
                                                                                       : 1)
                                 : kind == ray_cast::kConvex         ? std::min<std::size_t>(n, 1)
                                                                     : std::min<std::size_t>(n, 4);
        groups[5 * kind + part].push_back(words_[row]);
      }
    }
    std::vector<RowWords> all;
    all.reserve(words_.size());
    for (const std::vector<RowWords>& group : groups) all.insert(all.end(), group.begin(), group.end());
    return all;
  }

  const RayCastPack& scene_;
  std::vector<glm::vec4> balls_;
  double probe_;
  std::vector<RowWords> words_;
};

}  // namespace

std::vector<RowWords> row_differences(const RayCastPack& scene, std::vector<glm::vec4> balls, double probe) {
  return RowPredictor(scene, std::move(balls), probe).run();
}

}  // namespace meniscus::page
