// SPDX-License-Identifier: BSD-3-Clause
// Casts opaque layers first, which limit the visible distance in the others. Then sorts and composites all layers.
#include "core/render/cpu/layer_stack.h"

#include <tuple>

#include "core/base/progress.h"
#include "core/color/color_maps.h"
#include "core/image/color_space.h"

namespace meniscus {
namespace {

using ray_cast::kOnPlane;

constexpr float kFar = 3.0e38f;    // beyond every hit
constexpr double kCapRoom = 1e-6;  // Å, tolerance for the rounding of distances
/// The transmittance below which a ray ends in transparent parts.
constexpr float kLeastLeft = 1.0f / 1024.0f;

glm::ivec2 pixel_of(const LaneTile& task, std::uint32_t ray) {
  const int in_tile = static_cast<int>(ray % (kTileEdge * kTileEdge));
  return task.origin + glm::ivec2(in_tile % kTileEdge, in_tile / kTileEdge);
}

std::uint32_t ray_count(const LaneTile& task) {
  return static_cast<std::uint32_t>(task.sample_count * kTileEdge * kTileEdge);
}

std::uint32_t sample_of(std::uint32_t ray) { return ray / (kTileEdge * kTileEdge); }

/// The formulas of the shared sources, for single rays.
struct SingleRays {
  static float abs(float number) { return std::abs(number); }
  static float max(float a, float b) { return std::max(a, b); }
#include "gpu_shaders/ray_cast/repeated_hit.glsl"
};

/// A ray through a point of the picture, in pixels from its corner.
struct PictureRay {
  glm::dvec3 on_pivot_plane;  // Å from the pivot
  glm::dvec3 direction;       // unit vector
};

PictureRay picture_ray(const PictureFrame& frame, const glm::dvec2& place) {
  const glm::dvec2 offset = (place - 0.5 * glm::dvec2(frame.size)) * frame.pixel_size;
  const glm::dvec3 on_pivot_plane = frame.basis.right * offset.x - frame.basis.up * offset.y;
  return {on_pivot_plane, frame.camera.projection == Projection::orthographic
                              ? frame.basis.forward
                              : glm::normalize(frame.basis.forward * frame.eye_distance + on_pivot_plane)};
}

bool is_repeated(const LayerHit& hit, const LayerHit& before, float slack) {
  if (hit.primitive == kOnPlane || before.primitive == kOnPlane || hit.layer != before.layer) return false;
  return SingleRays().is_repeated(hit.t, hit.facing, before.t, before.facing, slack);
}

/// True if the layer needs all points of a ray to find the inside of solids: a plane cuts it, hidden atoms are
/// transparent, or shapes lie within each other.
bool is_translucent(const PictureObject& object) {
  return object.coloring->is_translucent() ||
         (!object.clip.empty() && (object.shapes || object.coloring->hides_some()));
}

/// Returns those planes of an object through which every ray of the block enters, moved outwards by more than all
/// rounding errors: no ray hits what lies completely beyond one of them.
std::vector<glm::vec4> entered_planes(std::span<const glm::vec4> planes, float slack, const PictureFrame& frame,
                                      const PictureBlock& block) {
  constexpr float kSteep = 1e-2f;  // smallest cosine between a plane's normal and a ray
  const float room = 0.01f + 100.0f * slack;
  std::vector<glm::vec4> entered;
  for (const glm::vec4& plane : planes) {
    // The value is linear in directions that are not normalised, so the corners have the extremes.
    bool by_all = true;
    for (const glm::ivec2 corner : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
      const PictureRay ray = picture_ray(frame, glm::dvec2(block.origin + corner * block.size));
      by_all = by_all && glm::dot(glm::dvec3(plane), ray.direction) < -kSteep;
    }
    if (by_all) entered.emplace_back(glm::vec3(plane), plane.w + room);
  }
  return entered;
}

/// Returns a factor of brightness, which is lower on stripes across a plane.
float hatched(const glm::dvec3& point, const glm::dvec3& normal, double distance) {
  const double stripe = glm::dot(point, hatching_direction(normal)) / (std::sqrt(2.0) * distance);
  return stripe - std::floor(stripe) < kHatchedShare ? kHatchedLight : 1.0f;
}

}  // namespace

LayerStack::LayerStack(std::span<const PictureObject> objects, const PictureFrame& frame,
                       const PackPlacement& placement, const Look& look)
    : frame_(frame) {
  layers_.reserve(objects.size());
  content_.several_objects = objects.size() > 1;
  // The finish of samples knows a single material only.
  content_.highlights = std::ranges::any_of(objects, [](const PictureObject& o) { return !o.material.empty(); });
  for (const bool translucent : {false, true})
    for (const PictureObject& object : objects)
      if (is_translucent(object) == translucent) {
        Layer& layer = layers_.emplace_back();
        layer.object = &object;
        layer.surface = object.surface;
        layer.number = static_cast<std::uint32_t>(&object - objects.data());
        layer.translucent = translucent;
        pack(layer, placement, look);
        content_.marks = content_.marks || !layer.scene.marks.empty();
        content_.shows_through = translucent;
      }
}

void LayerStack::pack(Layer& layer, const PackPlacement& placement, const Look& look) const {
  const PictureObject& object = *layer.object;
  Look own = look;
  own.material = object.material.over(look.material);
  layer.scene.placement = placement;
  layer.scene.pack(object, frame_, own);
  // Transparent parts are not finished.
  if (layer.translucent || content_.highlights) layer.scene.lanes.params.specular = own.material.specular;
  layer.planes = planes_around(frame_.pivot, object.clip);
  if (!object.surface || object.clip.empty()) return;
  // A point of the solid lies in the ball of some atom, enlarged by the probe.
  double largest = 0.0;
  for (const Ball& ball : object.surface->atoms) largest = std::max(largest, ball.radius);
  layer.farthest_atom = largest + object.surface->probe_radius;
  layer.atoms.emplace(object.surface->atoms, layer.farthest_atom);
}

HitSource LayerStack::source_of(const ray_cast::Hit& hit) const {
  const auto layer = std::ranges::find(layers_, hit.object, &Layer::number);
  return {layer->surface, layer->scene.packed.primitives};
}

HitNames LayerStack::names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const {
  return meniscus::names_of(source_of(hit), hit, point);
}

PickedPoint LayerStack::picked(const ray_cast::Hit& hit) const {
  PickedPoint point;
  point.atom = hit.atom;
  point.object = hit.object;
  const HitSource source = source_of(hit);
  if (hit.primitive != kOnPlane && source.surface)
    point.kind = static_cast<PatchKind>(source.primitives[hit.primitive].kind);
  return point;
}

void LayerStack::begin_block(const SceneBlock& block, Interruption&, StageClock& clock) {
  const auto stage = clock.stage("tile lists");
  frame_ = block.frame;
  block_ = block.block;
  for (Layer& layer : layers_) {
    layer.lists.build(layer.scene.packed.primitives, frame_, block_,
                      entered_planes(layer.planes, layer.scene.placement.slack, frame_, block_));
    layer.scene.lanes.view = block_view(frame_, block_, glm::vec2(0.0f));
    layer.scene.lanes.light = block.light;
  }
}

void LayerStack::cast_tile(std::size_t tile, LaneTile task, const LaneKernels& kernels) {
  // Nothing has changed there since the block began, except for lines of transparent parts.
  const bool is_empty = std::ranges::all_of(layers_, [&](Layer& layer) { return layer.lists.entries(tile).empty(); });
  if (is_empty && !task.front.color) return;
  Workplace& place = workplaces_.local();
  place.hits.clear();
  task.counts = nullptr;  // the layers of all rays of a tile are put together at once
  place.farthest.assign(ray_count(task), kFar);
  place.clipped.resize(ray_count(task));
  const TileWork work{task, kernels, place};
  for (std::uint32_t n = 0; n < layers_.size(); ++n) cast_layer(n, tile, work);
  order_hits(0, work);
  put_together(work);
}

void LayerStack::cast_layer(std::uint32_t number, std::size_t tile, const TileWork& work) {
  Layer& layer = layers_[number];
  Workplace& place = work.place;
  const std::span<std::uint32_t> entries = layer.lists.entries(tile);
  if (entries.empty()) return;
  LaneTile task = work.task;
  task.list = place.sorted.sort(entries, layer.scene.packed.primitives);
  const bool cut_by_planes = !layer.planes.empty();
  const LayerTask wanted{.planes = layer.planes.data(),
                         .plane_count = static_cast<int>(layer.planes.size()),
                         .all = layer.translucent,
                         .has_caps = layer.object->surface != nullptr && !layer.translucent,
                         .thickens = layer.object->thickens,
                         // The points behind a plane, at any distance, determine whether there is a cap.
                         .farthest = cut_by_planes ? nullptr : place.farthest.data(),
                         .clipped = place.clipped.data()};
  const std::size_t first = place.hits.size();
  place.hits.resize(first + ray_count(task));
  struct Room : LayerHits {
    std::vector<LayerHit>* all;
  } room;
  room.all = &place.hits;
  room.hits = place.hits.data();
  room.count = static_cast<std::uint32_t>(first);
  room.capacity = static_cast<std::uint32_t>(place.hits.size());
  room.grow = [](LayerHits& full) {
    auto& hits = *static_cast<Room&>(full).all;
    hits.resize(2 * hits.size());
    full.hits = hits.data();
    full.capacity = static_cast<std::uint32_t>(hits.size());
  };
  work.kernels.cast_layer(layer.scene.lanes, task, wanted, room);
  place.hits.resize(room.count);
  for (std::size_t n = first; n < place.hits.size(); ++n) place.hits[n].layer = number;
  if (cut_by_planes) cut(number, first, work);
  if (layer.translucent) return;
  for (std::size_t n = first; n < place.hits.size(); ++n) {
    float& farthest = place.farthest[place.hits[n].ray];
    farthest = std::min(farthest, place.hits[n].t);
  }
}

void LayerStack::cut(std::uint32_t number, std::size_t first_hit, const TileWork& work) const {
  const Layer& layer = layers_[number];
  std::vector<LayerHit>& hits = work.place.hits;
  order_hits(first_hit, work);
  std::vector<Cap>& caps = work.place.caps;
  caps.clear();
  const auto add_cap = [&](std::uint32_t ray, float t, std::uint32_t plane, float facing) {
    Cap cap;
    cap.t = t;
    cap.ray = ray;
    cap.layer = number;
    cap.primitive = kOnPlane;
    cap.facing = facing;
    cap.plane = plane;
    cap.point = cap_point(work.task, cap);
    caps.push_back(cap);
  };
  for (std::uint32_t ray = 0; ray < ray_count(work.task); ++ray) {
    const std::span<const std::uint32_t> order = work.place.order_of(ray);
    if (order.empty()) continue;
    const ClippedRay& clipped = work.place.clipped[ray];
    bool hidden = false;  // true: behind a cap
    if (clipped.in_plane != ClippedRay::kNoPlane && begins_inside(layer, hits, order)) {
      add_cap(ray, clipped.in, clipped.in_plane, -1.0f);
      caps.back().atom = leaving_hit(hits, order).atom;
      hidden = !layer.translucent;
    }
    std::size_t n = 0;
    while (!hidden && n < order.size() && hits[order[n]].t < clipped.out) ++n;
    if (n < order.size() && layer.object->surface && layer.translucent && hits[order[n]].facing > 0.0f)
      add_cap(ray, clipped.out, clipped.out_plane, 1.0f);
    for (; n < order.size(); ++n) hits[order[n]].t = kFar;  // cut away
  }
  std::erase_if(hits, [](const LayerHit& hit) { return hit.t == kFar; });
  color_caps(layer, caps);
  const std::size_t first_cap = hits.size();
  hits.insert(hits.end(), caps.begin(), caps.end());
  work.kernels.light_points(layer.scene.lanes, work.task, hits.data() + first_cap,
                            static_cast<std::uint32_t>(caps.size()));
}

const LayerHit& LayerStack::leaving_hit(std::span<const LayerHit> hits, std::span<const std::uint32_t> order) {
  return hits[*std::ranges::find_if(order, [&](std::uint32_t n) { return hits[n].facing > 0.0f; })];
}

/// True if the ray is inside a solid at the plane. order: all points of the ray beyond the plane. In a surface the
/// first point decides. Shapes lie within each other, so exits without an entry count; but cylinders are open at their
/// ends inside spheres.
bool LayerStack::begins_inside(const Layer& layer, std::span<const LayerHit> hits,
                               std::span<const std::uint32_t> order) {
  if (hits[order.front()].facing > 0.0f || layer.object->surface) return hits[order.front()].facing > 0.0f;
  int left = 0;
  const LayerHit* before = nullptr;
  for (const std::uint32_t n : order) {
    const bool again = before && is_repeated(hits[n], *before, layer.scene.placement.slack);
    before = &hits[n];
    if (again || layer.scene.packed.primitives[hits[n].primitive].kind == ray_cast::kCylinder) continue;
    left += hits[n].facing > 0.0f ? 1 : -1;
  }
  return left > 0;
}

glm::dvec3 LayerStack::cap_point(const LaneTile& task, const LayerHit& cap) const {
  const PictureRay ray = picture_ray(
      frame_, glm::dvec2(block_.origin + pixel_of(task, cap.ray)) + 0.5 + glm::dvec2(task.offset[sample_of(cap.ray)]));
  return frame_.pivot + ray.on_pivot_plane + ray.direction * static_cast<double>(cap.t);
}

/// Colours all caps of a tile, row by row: the atoms near the tile are searched once, and a cap is compared only with
/// the atoms that are near enough to the middle of its row.
void LayerStack::color_caps(const Layer& layer, std::span<Cap> caps) const {
  if (caps.empty()) return;
  if (layer.object->shapes) {
    for (Cap& cap : caps) paint_cap(layer, cap);
    return;
  }
  const std::vector<Ball>& balls = layer.object->surface->atoms;
  const auto [middle, reach] = middle_of(caps);
  std::vector<std::uint32_t> around;
  layer.atoms->for_each_near(middle, layer.farthest_atom + reach + 1e-3, [&](std::uint32_t a) { around.push_back(a); });
  std::vector<NearAtom> near;
  for (std::size_t n = 0, end = 0; n < caps.size(); n = end) {
    while (end < caps.size() && caps[end].ray / kTileEdge == caps[n].ray / kTileEdge) ++end;
    const std::span<Cap> row = caps.subspan(n, end - n);
    const Middle of_row = middle_of(row);
    near.clear();
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t a : around) {
      near.emplace_back(glm::length(of_row.point - balls[a].center) - balls[a].radius, a);
      nearest = std::min(nearest, near.back().first);
    }
    std::erase_if(near, [&](const NearAtom& atom) { return atom.first > nearest + 2.0 * of_row.reach + kCapRoom; });
    std::ranges::sort(near);
    color_caps(layer, row, of_row.reach, near);
  }
}

LayerStack::Middle LayerStack::middle_of(std::span<const Cap> caps) {
  Middle result{0.5 * (caps.front().point + caps.back().point)};
  for (const Cap& cap : caps) {
    const glm::dvec3 off = cap.point - result.point;
    result.reach = std::max(result.reach, glm::dot(off, off));
  }
  result.reach = std::sqrt(result.reach);
  return result;
}

void LayerStack::color_caps(const Layer& layer, std::span<Cap> caps, double reach,
                            std::span<const NearAtom> near) const {
  const std::vector<Ball>& balls = layer.object->surface->atoms;
  for (Cap& cap : caps) {
    NearAtom first{std::numeric_limits<double>::infinity(), 0};
    for (const auto& [distance, a] : near) {
      if (distance - reach > first.first + kCapRoom) break;  // this atom and all after it are too far away
      first = std::min(first, {glm::length(cap.point - balls[a].center) - balls[a].radius, a});
    }
    cap.atom = first.second;
    paint_cap(layer, cap);
  }
}

void LayerStack::paint_cap(const Layer& layer, Cap& cap) {
  const Coloring& coloring = *layer.object->coloring;
  cap.color = layer.scene.colors[cap.atom];
  cap.normal = glm::vec3(layer.object->clip[cap.plane].normal);
  if (coloring.by_volume(cap.atom)) {
    const VolumePaint& paint = *coloring.volume;
    cap.color = glm::vec4(linear_from_srgb(paint.scale.color(paint.grid.sample(cap.point))), cap.color.w);
  }
  const CapStyle& style = layer.object->cap;
  if (style.color) cap.color = glm::vec4(linear_from_srgb(*style.color), cap.color.w);
  if (style.hatching > 0.0)
    cap.color = glm::vec4(
        glm::vec3(cap.color) * hatched(cap.point, layer.object->clip[cap.plane].normal, style.hatching), cap.color.w);
}

void LayerStack::order_hits(std::size_t first_hit, const TileWork& work) const {
  Workplace& place = work.place;
  const std::uint32_t rays = ray_count(work.task);
  const auto count = static_cast<std::uint32_t>(place.hits.size());
  place.starts.assign(rays + 1, 0);
  for (std::size_t n = first_hit; n < count; ++n) ++place.starts[place.hits[n].ray + 1];
  std::partial_sum(place.starts.begin(), place.starts.end(), place.starts.begin());
  place.next.assign(place.starts.begin(), place.starts.end() - 1);
  place.order.resize(count - first_hit);
  for (auto n = static_cast<std::uint32_t>(first_hit); n < count; ++n) place.order[place.next[place.hits[n].ray]++] = n;
  for (std::uint32_t ray = 0; ray < rays; ++ray) {
    const std::span<std::uint32_t> order = place.order_of(ray);
    if (order.size() < 2) continue;
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      const LayerHit &left = place.hits[a], &right = place.hits[b];
      return std::tie(left.t, left.layer, left.primitive) < std::tie(right.t, right.layer, right.primitive);
    });
  }
}

void LayerStack::put_together(const TileWork& work) const {
  Workplace& place = work.place;
  const LaneTile& task = work.task;
  const auto width = static_cast<std::size_t>(block_.size.x);
  for (std::uint32_t ray = 0; ray < ray_count(task); ++ray) {
    const std::span<const std::uint32_t> order = place.order_of(ray);
    const glm::ivec2 pixel = pixel_of(task, ray);
    if (pixel.x >= block_.size.x || pixel.y >= block_.size.y) continue;
    const std::size_t at = static_cast<std::size_t>(pixel.y) * width + static_cast<std::size_t>(pixel.x);
    glm::vec4 over(0.0f);
    const LayerHit *opaque = nullptr, *before = nullptr, *first = nullptr;
    for (const std::uint32_t n : order) {
      const LayerHit& hit = place.hits[n];
      const bool again = before && is_repeated(hit, *before, layers_[hit.layer].scene.placement.slack);
      before = &hit;
      if (again || hit.color.w <= 0.0f) continue;
      if (!first) first = &hit;
      if (hit.color.w >= 1.0f) {
        opaque = &hit;
        break;
      }
      const float share = (1.0f - over.w) * hit.color.w;
      over += share * glm::vec4(glm::vec3(hit.color), 1.0f);
      if (1.0f - over.w < kLeastLeft) break;
    }
    const glm::vec4 behind = opaque ? glm::vec4(glm::vec3(opaque->color), 1.0f) : glm::vec4(0.0f);
    if (task.sums) task.sums[at] += over + (1.0f - over.w) * behind;
    if (task.hits && first && sample_of(ray) == 0)
      task.hits[at] = {first->normal, first->t, first->primitive, first->atom, layers_[first->layer].number, 0u};
    const LaneSamples& samples = task.samples;
    if (!samples.color) continue;
    samples.over[at] = over;
    samples.color[at] = behind;
    write(samples, at, opaque);
    if (!task.front.color) continue;
    task.front.color[at] = first && first != opaque ? first->color : glm::vec4(0.0f);
    write(task.front, at, first);
  }
}

void LayerStack::write(const LaneSamples& samples, std::size_t at, const LayerHit* hit) const {
  samples.depth[at] = hit ? hit->depth : kernel::kNothing;
  if (samples.visibility) samples.visibility[at] = hit ? hit->visibility : 1.0f;
  for (int axis = 0; axis < 3; ++axis) samples.normal[axis][at] = hit ? hit->normal[axis] : 0.0f;
  if (!samples.mark) return;
  const std::vector<float>* const marks = hit ? &layers_[hit->layer].scene.marks : nullptr;
  float mark = marks && !marks->empty() ? (*marks)[hit->atom] : 0.0f;
  if (hit && hit->primitive == ray_cast::kOnPlane) {  // caps have no patches, and lines only between colours
    const auto number = static_cast<std::uint32_t>(mark);
    const std::uint32_t one_color = layers_[hit->layer].object->cap.color ? 1 : 0;
    mark = static_cast<float>(number - number % Coloring::kMarksOfPart + one_color);
  }
  samples.mark[at] = mark;
}

}  // namespace meniscus
