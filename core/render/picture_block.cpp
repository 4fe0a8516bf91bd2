// SPDX-License-Identifier: BSD-3-Clause
// Computes the parameters of a block of pixels, finds the names of what its rays hit, collects cast blocks in a
// picture, and decides which objects of the picture need layers.
#include "core/render/picture_block.h"

#include <tbb/parallel_for.h>

#include "core/color/coloring.h"
#include "core/image/color_space.h"
#include "core/shapes/shapes.h"
#include "core/surface/walks.h"

namespace meniscus {

HitPoint hit_point(const PictureFrame& frame, glm::ivec2 pixel, float t) {
  const Ray ray = pixel_ray(frame.camera, frame.size, glm::dvec2(pixel) + 0.5);
  // The kernel counts distances from the plane through the pivot.
  const double z = t + frame.eye_distance / glm::dot(ray.direction, frame.basis.forward);
  return {z, ray.origin + ray.direction * z};
}

namespace {

double squared_length(const glm::dvec3& v) { return glm::dot(v, v); }

/// Returns the first face and the number of faces of a patch.
std::pair<std::uint32_t, std::uint32_t> faces_of(const Surface& surface, PatchKind kind, std::uint32_t patch) {
  switch (kind) {
    case PatchKind::convex:
      return {surface.convex[patch].first_face, surface.convex[patch].face_count};
    case PatchKind::toroidal:
      return {surface.toroidal[patch].first_face, surface.toroidal[patch].face_count};
    case PatchKind::concave:
      return {surface.concave[patch].first_face, surface.concave[patch].face_count};
  }
  return {0, 0};
}

}  // namespace

double squared_distance(const Border& border, const glm::dvec3& point) {
  const glm::dvec3 v = point - border.center, side = glm::cross(border.axis, border.start);
  const double x = glm::dot(v, border.start), y = glm::dot(v, side), z = glm::dot(v, border.axis);
  double angle = std::atan2(y, x);
  if (angle < 0.0) angle += 2.0 * std::numbers::pi;
  if (angle <= border.sweep) {
    const double across = std::hypot(x, y) - border.radius;
    return across * across + z * z;
  }
  return std::min(squared_length(v - border.radius * border.start),
                  squared_length(v - border.radius * arc_direction(border, border.sweep)));
}

std::uint32_t ComponentLookup::at(PatchKind kind, std::uint32_t patch, const glm::dvec3& point) const {
  const auto [first, count] = faces_of(surface_, kind, patch);
  if (count == 0) return kNone;
  const auto begin = surface_.faces.begin() + first, end = begin + count;
  if (std::all_of(begin, end, [&](const Face& face) { return face.component == begin->component; }))
    return begin->component;
  std::uint32_t component = kNone;
  double nearest = std::numeric_limits<double>::max();
  for (auto face = begin; face != end; ++face) {
    const double distance = squared_distance(*face, point);
    if (distance < nearest) {
      nearest = distance;
      component = face->component;
    }
  }
  return component;
}

double ComponentLookup::squared_distance(const Face& face, const glm::dvec3& point) const {
  double nearest = std::numeric_limits<double>::max();
  for_each_border(surface_, face, [&](const Border& border) {
    nearest = std::min(nearest, meniscus::squared_distance(border, point));
  });
  return nearest;
}

namespace {

/// The parameters of studio_light() for the lamps.
struct Light {
  glm::vec3 key_color;
  float key_share;
  glm::vec3 fill_color;
  float fill_share;
  glm::vec3 sky, ground;
};

constexpr Light kStudio{.key_color = {1.0f, 0.97f, 0.92f},
                        .key_share = 0.78f,
                        .fill_color = {0.75f, 0.85f, 1.0f},
                        .fill_share = 0.20f,
                        .sky = {0.24f, 0.26f, 0.29f},
                        .ground = {0.10f, 0.09f, 0.09f}};

glm::vec3 fill_direction() { return glm::normalize(glm::vec3(0.85f, -0.05f, 0.45f)); }

/// Returns the strengths of white lamps, whose sum is 1 on a surface that faces the key light.
Light white_light(const glm::vec3& key_direction) {
  constexpr float kKey = 0.62f, kFill = 0.14f, kSky = 0.26f, kGround = 0.16f;
  const float sky = 0.5f + 0.5f * key_direction.y, facing = std::max(key_direction.z, 0.0f);
  const float fill = std::max((glm::dot(key_direction, fill_direction()) + 0.3f) / 1.3f, 0.0f);
  const float there = kKey + kFill * fill + (kGround + (kSky - kGround) * sky) * (0.35f + 0.65f * facing);
  const glm::vec3 white(1.0f);
  return {white, kKey / there, white, kFill / there, white * (kSky / there), white * (kGround / there)};
}

Light light_of(const Look& look) {
  return look.lamps == Lamps::studio ? kStudio : white_light(glm::normalize(look.light_direction));
}

}  // namespace

glm::vec2 sample_offset(int index) {
  const double x = 0.5 + index * 0.7548776662466927, y = 0.5 + index * 0.5698402909980532;
  return {static_cast<float>(x - std::floor(x) - 0.5), static_cast<float>(y - std::floor(y) - 0.5)};
}

kernel::BlockView block_view(const PictureFrame& frame, const PictureBlock& block, const glm::vec2& sample_offset) {
  return {.right = glm::vec3(frame.basis.right),
          .eye_distance = static_cast<float>(frame.eye_distance),
          .up = glm::vec3(frame.basis.up),
          .pixel_size = static_cast<float>(frame.pixel_size),
          .forward = glm::vec3(frame.basis.forward),
          .orthographic = frame.camera.projection == Projection::orthographic,
          .first_offset = glm::vec2(glm::dvec2(block.origin) + 0.5 - 0.5 * glm::dvec2(frame.size)),
          .sample_offset = sample_offset,
          .size = block.size};
}

kernel::TileListParameters tile_list_parameters(const PictureFrame& frame, const PictureBlock& block,
                                                std::uint32_t primitive_count) {
  return {.right = glm::vec3(frame.basis.right),
          .eye_distance = static_cast<float>(frame.eye_distance),
          .up = glm::vec3(frame.basis.up),
          .pixels_per_angstrom = static_cast<float>(1.0 / frame.pixel_size),
          .forward = glm::vec3(frame.basis.forward),
          .orthographic = frame.camera.projection == Projection::orthographic,
          .block_center = glm::vec2(0.5 * glm::dvec2(frame.size) - glm::dvec2(block.origin)),
          .tiles = tile_counts(block),
          .first_tile = block.origin / kTileEdge,
          .picture_tile_columns = (frame.size.x + kTileEdge - 1) / kTileEdge,
          .bounded = false,
          .primitive_count = primitive_count,
          .entry_capacity = 0};  // there are no lists yet
}

kernel::RayCastParameters cast_parameters(const PackPlacement& scene, const Look& look, std::uint32_t atom_count,
                                          bool color_by_kind) {
  kernel::RayCastParameters own{};
  own.key_direction = glm::normalize(look.light_direction);
  own.key_strength = look.light_strength;
  const Light light = light_of(look);
  own.key_color = light.key_color;
  own.key_share = light.key_share;
  own.fill_direction = fill_direction();
  own.fill_color = light.fill_color;
  own.fill_share = light.fill_share;
  own.sky = light.sky;
  own.ground = light.ground;
  own.ambient = look.material.ambient;
  own.roughness = look.material.roughness;
  own.specular = look.finishes_highlights() ? 0.0f : look.material.specular;
  own.shininess = look.material.shininess;
  own.probe_radius = static_cast<float>(scene.probe_radius);
  own.slack = scene.slack;
  own.color_by_kind = color_by_kind;
  own.atom_count = atom_count;
  return own;
}

kernel::FinishParameters finish_parameters(const Look& look, const PackPlacement& scene, glm::ivec2 picture_size,
                                           int sample, bool has_marks) {
  constexpr float kLeastPixels = 2.0f;  // slopes and rounding cause smaller steps, which get no line
  const float step_pixels = look.line_step * static_cast<float>(std::min(picture_size.x, picture_size.y));
  const Light light = light_of(look);
  return {.key_direction = glm::normalize(look.light_direction),
          .key_strength = look.light_strength,
          .key_color = light.key_color,
          .key_share = light.key_share,
          .fill_direction = fill_direction(),
          .fill_share = light.fill_share,
          .fill_color = light.fill_color,
          .ambient = look.material.ambient,
          .sky = light.sky,
          .roughness = look.material.roughness,
          .ground = light.ground,
          .shadow = look.maps_lamp() ? look.shadows : 0.0f,
          .air = linear_from_srgb(look.background),
          .keeps_alpha = look.depth_cue_keeps_alpha,
          .patch_line_color = linear_from_srgb(look.patch_line_color),
          .patch_lines = look.patch_lines,
          .specular = look.finishes_highlights() ? look.material.specular : 0.0f,
          .shininess = look.material.shininess,
          .ambient_occlusion = look.ambient_occlusion,
          .outer_lines = look.outer_lines.value_or(look.silhouettes),
          .inner_lines = look.inner_lines.value_or(look.silhouettes),
          .part_lines = look.part_lines.value_or(look.silhouettes),
          .widest_line = look.widest_line(),
          .step_pixels = std::max(step_pixels, kLeastPixels),
          .fade_pixels = 2.0f * step_pixels,
          .depth_cue = look.depth_cue,
          .first_depth = scene.first_depth,
          .last_depth = scene.last_depth,
          .sample_index = static_cast<std::uint32_t>(sample),
          .has_marks = has_marks};
}

namespace {

/// Returns the height of a band: as many rows as fit into 256 MiB, in bands of whole tiles that are as equal as
/// possible.
int band_rows(const RenderSettings& settings, int edge) {
  constexpr std::int64_t kBandBytes = std::int64_t{1} << 28, kColorBytes = 16, kAovBytes = 56, kSeenBytes = 4;
  const PictureLayers layers = settings.layers();
  const std::int64_t row_bytes =
      (kColorBytes + (layers.aovs ? kAovBytes : 0) + kSeenBytes * layers.rays) * settings.size.x;
  const auto in_tiles = [](std::int64_t rows) { return (rows + kTileEdge - 1) / kTileEdge * kTileEdge; };
  const std::int64_t most =
      std::clamp<std::int64_t>(kBandBytes / row_bytes / kTileEdge * kTileEdge, std::int64_t{kTileEdge}, edge);
  const std::int64_t bands = (settings.size.y + most - 1) / most;
  return static_cast<int>(in_tiles((settings.size.y + bands - 1) / bands));
}

/// Calls work(index in the block, index in the rows from first_row on) for each pixel of `inner`, which is part of the
/// block.
template <typename Work>
void for_each_pixel(const PictureBlock& inner, const PictureBlock& block, int width, int first_row, const Work& work) {
  tbb::parallel_for(inner.origin.y, inner.origin.y + inner.size.y, [&](int y) {
    for (int x = inner.origin.x; x < inner.origin.x + inner.size.x; ++x)
      work(static_cast<std::size_t>(y - block.origin.y) * block.size.x + (x - block.origin.x),
           static_cast<std::size_t>(y - first_row) * width + x);
  });
}

}  // namespace

std::vector<PictureBlock> picture_blocks(glm::ivec2 size, glm::ivec2 edge) {
  std::vector<PictureBlock> blocks;
  for (int top = 0; top < size.y; top += edge.y)
    for (int left = 0; left < size.x; left += edge.x)
      blocks.push_back({{left, top}, glm::min(edge, size - glm::ivec2(left, top))});
  return blocks;
}

PictureBlock with_neighbors(const PictureBlock& inner, int reach, glm::ivec2 picture_size) {
  const glm::ivec2 low = glm::max(inner.origin - reach, glm::ivec2(0));
  return {low, glm::min(inner.origin + inner.size + reach, picture_size) - low};
}

HitNames names_of(const HitSource& source, const ray_cast::Hit& hit, const glm::dvec3& point) {
  if (hit.primitive == ray_cast::kOnPlane) return {hit.atom, kNone, Framebuffer::kCap};
  if (!source.surface) return {hit.atom, kNone, Framebuffer::kShape};
  const ray_cast::Primitive& primitive = source.primitives[hit.primitive];
  const std::uint32_t component =
      ComponentLookup(*source.surface).at(static_cast<PatchKind>(primitive.kind), primitive.patch_index, point);
  return {hit.atom, component, primitive.kind, primitive.patch_index};
}

PictureCollector::PictureCollector(const PictureFrame& frame, const RenderSettings& settings, NameHit names,
                                   bool several, NameAtom name_atom)
    : frame_(frame),
      settings_(settings),
      per_sample_(1.0f / static_cast<float>(settings.samples)),
      names_(std::move(names)),
      name_atom_(std::move(name_atom)),
      several_(several) {
  if (!settings.take_band) begin_rows(0, settings.size.y);
}

std::vector<PictureBlock> PictureCollector::blocks(int edge) {
  if (!settings_.take_band) return picture_blocks(settings_.size, glm::ivec2(edge));
  std::vector<PictureBlock> blocks = picture_blocks(settings_.size, {edge, band_rows(settings_, edge)});
  begin_rows(0, blocks.front().size.y);
  return blocks;
}

void PictureCollector::begin_rows(int first, int count_of_rows) {
  const std::size_t count = static_cast<std::size_t>(settings_.size.x) * count_of_rows;
  first_row_ = first;
  picture_.size = {settings_.size.x, count_of_rows};
  picture_.color.assign(count, glm::vec4(0.0f));
  if (settings_.mattes) picture_.seen.assign(count * static_cast<std::size_t>(settings_.samples), kNone);
  if (!settings_.aovs) return;
  picture_.z.assign(count, std::numeric_limits<float>::infinity());
  picture_.normal.assign(count, glm::vec3(0.0f));
  picture_.position.assign(count, glm::vec3(0.0f));
  picture_.atom.assign(count, kNone);
  picture_.kind.assign(count, kNone);
  picture_.component.assign(count, kNone);
  if (several_) picture_.object.assign(count, kNone);
  if (settings_.motion) picture_.motion.assign(count, glm::vec2(0.0f));
}

void PictureCollector::add_colors(const PictureBlock& inner, const PictureBlock& block,
                                  std::span<const glm::vec4> sums) {
  for_each_pixel(inner, block, picture_.size.x, first_row_,
                 [&](std::size_t from, std::size_t to) { picture_.color[to] = sums[from] * per_sample_; });
}

void PictureCollector::add_hits(const PictureBlock& inner, const PictureBlock& block,
                                std::span<const ray_cast::Hit> hits) {
  for_each_pixel(inner, block, picture_.size.x, first_row_,
                 [&](std::size_t from, std::size_t to) { copy_hit(hits[from], to); });
}

void PictureCollector::add_seen(const PictureBlock& inner, const PictureBlock& block,
                                std::span<const ray_cast::Hit> hits, int sample) {
  const auto rays = static_cast<std::size_t>(settings_.samples), ray = static_cast<std::size_t>(sample);
  for_each_pixel(inner, block, picture_.size.x, first_row_, [&](std::size_t from, std::size_t to) {
    const ray_cast::Hit& hit = hits[from];
    if (hit.primitive == ray_cast::kNoPrimitive) return;
    picture_.seen[to * rays + ray] = settings_.name_seen(hit.object, name_atom_ ? name_atom_(hit) : hit.atom);
  });
}

void PictureCollector::end_block(const PictureBlock& block) {
  if (!settings_.take_band || block.origin.x + block.size.x < settings_.size.x) return;
  settings_.take_band(std::exchange(picture_, {}), first_row_);
  const int next = block.origin.y + block.size.y;
  if (next < settings_.size.y)
    begin_rows(next, std::min(block.size.y, settings_.size.y - next));
  else
    picture_.size = settings_.size;
}

void PictureCollector::copy_hit(const ray_cast::Hit& hit, std::size_t at) {
  if (hit.primitive == ray_cast::kNoPrimitive) return;
  const auto width = static_cast<std::size_t>(frame_.size.x);
  const glm::ivec2 pixel(static_cast<int>(at % width), first_row_ + static_cast<int>(at / width));
  const HitPoint point = hit_point(frame_, pixel, hit.t);
  picture_.z[at] = static_cast<float>(point.z);
  picture_.normal[at] = hit.normal;
  picture_.position[at] = glm::vec3(point.position);
  if (!picture_.object.empty()) picture_.object[at] = hit.object;
  const HitNames names = names_(hit, point.position);
  picture_.atom[at] = names.atom;
  picture_.kind[at] = names.kind;
  picture_.component[at] = names.component;
  if (!picture_.motion.empty())
    picture_.motion[at] =
        settings_.move({hit.object, names.atom, names.kind, names.patch, point.position, glm::dvec3(hit.normal)});
}

glm::dvec3 hatching_direction(const glm::dvec3& normal) {
  const glm::dvec3 axis = std::abs(normal.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(normal, axis)), v = glm::cross(normal, u);
  return u + v;
}

bool needs_layers(const PictureObject& object) {
  return object.shapes || !object.clip.empty() ||
         std::ranges::any_of(object.coloring->opacity, [](float a) { return a > 0.0f && a < 1.0f; });
}

std::vector<Ball> enclosing_balls(std::span<const PictureObject> objects) {
  std::vector<Ball> balls;
  for (const PictureObject& object : objects) {
    if (object.surface) balls.insert(balls.end(), object.surface->atoms.begin(), object.surface->atoms.end());
    if (!object.shapes) continue;
    for (const SphereShape& sphere : object.shapes->spheres) balls.push_back({sphere.center, sphere.radius});
    for (const CylinderShape& cylinder : object.shapes->cylinders)
      for (const glm::dvec3& end : {cylinder.from, cylinder.to}) balls.push_back({end, cylinder.radius});
    for (const glm::dvec3& corner : object.shapes->mesh.positions) balls.push_back({corner, 0.0});
  }
  return balls;
}

std::vector<Ball> kept_balls(std::span<const PictureObject> objects) {
  std::vector<Ball> kept;
  for (const PictureObject& object : objects)
    for (const Ball& ball : enclosing_balls({&object, 1}))
      if (std::ranges::none_of(object.clip, [&](const ClipPlane& plane) {
            return glm::dot(plane.normal, ball.center) - ball.radius >= plane.offset;
          }))
        kept.push_back(ball);
  return kept;
}

}  // namespace meniscus
