// SPDX-License-Identifier: BSD-3-Clause
// Packs patches and shapes with their bounds; every number is computed in double and rounded once.
#include "core/render/ray_cast_pack.h"

#include <bit>
#include <numbers>
#include <numeric>

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "core/color/coloring.h"
#include "core/image/color_space.h"
#include "core/queries/copies.h"
#include "core/render/ray_geometry.h"
#include "core/shapes/shapes.h"

namespace meniscus {
namespace {

using ray_cast::Primitive;

using geometry::PatchBound;

/// A range of patches of one kind that are packed together.
struct PatchRange {
  PatchKind kind;
  std::uint32_t first, end;
};

/// Returns ranges of all patches, by kind and index.
std::vector<PatchRange> ranges_of(const Surface& surface) {
  constexpr std::size_t kTogether = 2048;
  std::vector<PatchRange> ranges;
  const auto add = [&](PatchKind kind, std::size_t count) {
    for (std::size_t first = 0; first < count; first += kTogether)
      ranges.push_back(
          {kind, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(std::min(first + kTogether, count))});
  };
  add(PatchKind::convex, surface.convex.size());
  if (surface.probe_radius > 0.0) {  // with a probe of radius 0 these patches have no area
    add(PatchKind::toroidal, surface.toroidal.size());
    add(PatchKind::concave, surface.concave.size());
  }
  return ranges;
}

class Packer {
 public:
  /// Prepares packing. scene: receives the primitives; its slack must be set. motion: the placement of the surface;
  /// nullptr: as it is.
  Packer(const Surface& surface, const Coloring& coloring, const PictureFrame& frame, RayCastPack& scene,
         const RigidMotion* motion = nullptr, std::uint32_t first_atom = 0)
      : surface_(surface),
        coloring_(coloring),
        frame_(frame),
        motion_(motion),
        first_atom_(first_atom),
        scene_(scene) {}

  void pack(const PatchRange& range) {
    for (std::uint32_t i = range.first; i < range.end; ++i) pack(range.kind, i);
  }

  void pack(PatchKind kind, std::uint32_t i) {
    if (!may_show(kind, i)) return;
    if (kind == PatchKind::convex) pack(surface_.convex[i], i);
    if (kind == PatchKind::toroidal) pack(placed(surface_.toroidal[i]), i);
    if (kind == PatchKind::concave) pack(placed(surface_.concave[i]), i);
  }

  bool may_show(PatchKind kind, std::uint32_t i) const {
    if (kind == PatchKind::convex) return coloring_.shows(surface_.convex[i].atom);
    if (kind == PatchKind::toroidal) return shows_some(surface_.toroidal[i].atom);
    const ConcavePatch& patch = surface_.concave[i];
    return patch.face_count > 0 && shows_some({&surface_.contacts[patch.first_contact], patch.contact_count});
  }

  PatchBound bound(PatchKind kind, std::uint32_t i) {
    if (kind == PatchKind::convex) return bound(surface_.convex[i]);
    if (kind == PatchKind::concave) return bound(placed(surface_.concave[i]));
    const ToroidalPatch patch = placed(surface_.toroidal[i]);
    return bound(patch, shape(patch));
  }

 private:
  void add_row(const glm::dvec3& v, double w) { scene_.rows.emplace_back(glm::vec3(v), static_cast<float>(w)); }

  void add_planes(std::uint32_t first, std::uint32_t count, const glm::dvec3& center) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Plane plane = placed(surface_.planes[i]);
      add_row(plane.normal, plane.offset - glm::dot(plane.normal, center));
    }
  }

  /// Begins a primitive. Returns false if the whole bound is behind the camera.
  bool begin(const PatchBound& bound, PatchKind kind, std::uint32_t index, Primitive& primitive) {
    const geometry::SeenBound seen =
        geometry::see_bound(bound, scene_.slack, frame_.pivot, frame_.camera.position, frame_.basis.forward,
                            frame_.eye_distance, frame_.camera.projection == Projection::orthographic);
    if (!seen.in_front) return false;
    primitive.bound = glm::vec4(glm::vec3(seen.center), static_cast<float>(seen.radius));
    primitive.nearest = static_cast<float>(seen.nearest);
    primitive.first_row = static_cast<std::uint32_t>(scene_.rows.size());
    primitive.kind = static_cast<std::uint32_t>(kind);
    primitive.patch_index = index;
    return true;
  }

  template <typename Row>
  Row placed(const Row& row) const {
    return motion_ ? moved(row, *motion_) : row;
  }

  bool shows_some(std::span<const std::uint32_t> atoms) const {
    return std::ranges::any_of(atoms, [&](std::uint32_t a) { return coloring_.shows(a); });
  }

  std::uint32_t tie_key(const ConcavePatch& patch) const {
    const std::span contacts(&surface_.contacts[patch.first_contact], patch.contact_count);
    const auto least = std::ranges::min_element(contacts);  // begins the key; the others follow around
    const auto add = [this](std::uint32_t key, std::uint32_t atom) {
      return geometry::add_to_key(key, first_atom_ + atom);
    };
    return std::accumulate(contacts.begin(), least, std::accumulate(least, contacts.end(), 0u, add), add);
  }

  std::uint32_t tie_key(const ToroidalPatch& patch) const {
    std::uint32_t key =
        geometry::add_to_key(geometry::add_to_key(0, first_atom_ + patch.atom[0]), first_atom_ + patch.atom[1]);
    if (!patch.free())
      for (const std::uint32_t probe : patch.probe) key = geometry::add_to_key(key, tie_key(surface_.concave[probe]));
    return key;
  }

  PatchBound bound(const ConvexPatch& patch) const {
    const Ball ball = placed(surface_.atoms[patch.atom]);
    PatchBound bound{ball.center, ball.radius};
    for (std::uint32_t i = patch.first_plane; i < patch.first_plane + patch.plane_count; ++i) {
      const Plane plane = placed(surface_.planes[i]);
      const double cosine = (glm::dot(plane.normal, ball.center) - plane.offset) / ball.radius;
      const PatchBound cap = geometry::cap_bound(ball.center, ball.radius, -plane.normal, std::min(cosine, 1.0));
      if (cap.radius < bound.radius) bound = cap;
    }
    return bound;
  }

  void pack(const ConvexPatch& patch, std::uint32_t index) {
    Primitive primitive{};
    if (!begin(bound(patch), PatchKind::convex, index, primitive)) return;
    const Ball ball = placed(surface_.atoms[patch.atom]);
    primitive.plane_count = patch.plane_count;
    primitive.atom = patch.atom;
    primitive.tie_key = first_atom_ + patch.atom;
    add_row(ball.center - frame_.pivot, ball.radius);
    add_planes(patch.first_plane, patch.plane_count, ball.center);
    scene_.primitives.push_back(primitive);
  }

  /// Returns the shape of the patch where it is placed.
  geometry::SaddleShape shape(const ToroidalPatch& patch) const {
    const auto height = [&](int i) {
      return glm::dot(placed(surface_.atoms[patch.atom[i]]).center - patch.center, patch.axis);
    };
    return geometry::saddle_shape(height(0), height(1), surface_.atoms[patch.atom[0]].radius,
                                  surface_.atoms[patch.atom[1]].radius, patch.radius, surface_.probe_radius);
  }

  PatchBound bound(const ToroidalPatch& patch, const geometry::SaddleShape& shape) const {
    return geometry::saddle_bound(shape, patch.center, patch.axis, patch.start, patch.radius,
                                  {std::cos(0.5 * patch.sweep), std::sin(0.5 * patch.sweep)}, surface_.probe_radius);
  }

  void pack(const ToroidalPatch& patch, std::uint32_t index) {
    const double p = surface_.probe_radius;
    const geometry::SaddleShape shape = this->shape(patch);
    const double cosine = std::cos(patch.sweep), sine = std::sin(patch.sweep);
    Primitive primitive{};
    if (!begin(bound(patch, shape), PatchKind::toroidal, index, primitive)) return;
    primitive.plane_count = patch.free()                      ? geometry::kWholeTurn
                            : patch.sweep <= std::numbers::pi ? geometry::kUpToHalfTurn
                                                              : geometry::kOverHalfTurn;
    primitive.atom = patch.atom[0];
    primitive.second_atom = patch.atom[1];
    primitive.tie_key = tie_key(patch);
    add_row(patch.center - frame_.pivot, patch.radius);
    add_row(patch.start, cosine);
    add_row(patch.axis, sine);
    double z_low = shape.contact_z[0], z_high = shape.contact_z[1];
    if (!patch.has_piece[0]) z_low = geometry::spindle_tip_height(patch.radius, p);
    if (!patch.has_piece[1]) z_high = -geometry::spindle_tip_height(patch.radius, p);
    add_row({z_low, z_high, shape.clip_z}, shape.clip_radius);
    add_row({shape.height[0], shape.extended[0], shape.height[1]}, shape.extended[1]);
    scene_.primitives.push_back(primitive);
  }

  /// Returns a bound of the patch. Leaves the directions of its contacts in directions_.
  PatchBound bound(const ConcavePatch& patch) {
    const double p = surface_.probe_radius;
    glm::dvec3 sum(0.0);
    directions_.clear();
    for (std::uint32_t i = 0; i < patch.contact_count; ++i) {
      directions_.push_back(
          glm::normalize(placed(surface_.atoms[surface_.contacts[patch.first_contact + i]]).center - patch.center));
      sum += directions_.back();
    }
    // A cap of at most half a sphere is convex on the sphere, so it contains the patch if it contains the contacts.
    PatchBound bound{patch.center, p};
    if (glm::length(sum) > 1e-6) {
      const glm::dvec3 axis = glm::normalize(sum);
      double cosine = 1.0;
      for (const glm::dvec3& direction : directions_) cosine = std::min(cosine, glm::dot(direction, axis));
      bound = geometry::cap_bound(patch.center, p, axis, cosine);
    }
    return bound;
  }

  void pack(const ConcavePatch& patch, std::uint32_t index) {
    const double p = surface_.probe_radius;
    Primitive primitive{};
    if (!begin(bound(patch), PatchKind::concave, index, primitive)) return;
    primitive.plane_count = patch.plane_count();
    primitive.atom = patch.contact_count;
    primitive.tie_key = tie_key(patch);
    add_row(patch.center - frame_.pivot, p);
    add_planes(patch.first_plane, primitive.plane_count, patch.center);
    for (std::uint32_t i = 0; i < patch.contact_count; ++i)
      scene_.rows.emplace_back(glm::vec3(directions_[i]),
                               std::bit_cast<float>(surface_.contacts[patch.first_contact + i]));
    scene_.primitives.push_back(primitive);
  }

  const Surface& surface_;
  const Coloring& coloring_;
  const PictureFrame& frame_;
  const RigidMotion* const motion_;
  const std::uint32_t first_atom_;
  RayCastPack& scene_;
  std::vector<glm::dvec3> directions_;  // directions of a probe's contacts; a member, so that its memory is reused
};

/// The place of a part of a scene in the whole scene.
struct PartPlace {
  std::size_t primitive = 0, row = 0;
};

void copy_part(const RayCastPack& part, const PartPlace& place, RayCastPack& scene) {
  std::ranges::copy(part.rows, scene.rows.begin() + static_cast<std::ptrdiff_t>(place.row));
  std::ranges::transform(part.primitives, scene.primitives.begin() + static_cast<std::ptrdiff_t>(place.primitive),
                         [&](Primitive primitive) {
                           primitive.first_row += static_cast<std::uint32_t>(place.row);
                           return primitive;
                         });
}

constexpr double kBoundRoom = 1e-6;  // Å, rounding error of bounds and of values that are compared with them

template <typename Visit>
void for_each_ball(const BallGroup& group, std::size_t first, std::size_t past, const Visit& visit) {
  const std::span<const Ball> balls = group.balls.subspan(first, past - first);
  if (!group.motion)
    for (const Ball& ball : balls) visit(ball);
  else
    for (const Ball& ball : balls) visit(moved(ball, *group.motion));
}

/// The smallest and the largest of some numbers.
struct Range {
  double least = std::numeric_limits<double>::max(), largest = 0.0;
};

/// Calls note(ball, range) for each ball of a group on several threads, and merges the ranges into noted_so_far. The
/// order of balls must not matter.
template <typename Note>
void note_balls(const BallGroup& group, Range& noted_so_far, const Note& note) {
  noted_so_far = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, group.balls.size(), 8192), noted_so_far,
      [&](const auto& range, Range noted) {
        for_each_ball(group, range.begin(), range.end(), [&](const Ball& ball) { note(ball, noted); });
        return noted;
      },
      [](const Range& a, const Range& b) {
        return Range{std::min(a.least, b.least), std::max(a.largest, b.largest)};
      });
}

float slack_of(std::span<const BallGroup> groups, double probe_radius, const PictureFrame& frame) {
  Range extent;
  for (const BallGroup& group : groups) {
    if (glm::length(group.center - frame.pivot) + group.radius + probe_radius + kBoundRoom < extent.largest) continue;
    note_balls(group, extent, [&](const Ball& ball, Range& noted) {
      noted.largest = std::max(noted.largest, glm::length(ball.center - frame.pivot) + ball.radius + probe_radius);
    });
  }
  // Centres are rounded to 2^-24 of the extent, rays have a slightly larger error. Local coordinates are a few Å.
  return static_cast<float>(1e-5 + 2.5e-7 * extent.largest);
}

}  // namespace

PictureFrame make_picture_frame(std::span<const Ball> atoms, const Camera& camera, glm::ivec2 size) {
  const BallGroup all{.balls = atoms};
  return make_picture_frame({&all, 1}, camera, size);
}

PictureFrame make_picture_frame(std::span<const BallGroup> groups, const Camera& camera, glm::ivec2 size) {
  PictureFrame frame;
  frame.camera = camera;
  frame.basis = view_basis(camera);
  frame.size = size;
  // The pivot is the first ball on the view axis, or else a point at the mean depth of the balls.
  Range depths;
  for (const BallGroup& group : groups) {
    const glm::dvec3 from = group.center - camera.position;
    const double depth = glm::dot(from, frame.basis.forward);
    if (glm::length(from - frame.basis.forward * depth) > group.radius + kBoundRoom) continue;
    if (depth - group.radius - kBoundRoom > depths.least) continue;
    note_balls(group, depths, [&](const Ball& ball, Range& noted) {
      const glm::dvec3 v = ball.center - camera.position;
      const double along = glm::dot(v, frame.basis.forward);
      const glm::dvec3 across = v - frame.basis.forward * along;
      const double room = ball.radius * ball.radius - glm::dot(across, across);
      if (room > 0.0 && along + std::sqrt(room) > 0.0) noted.least = std::min(noted.least, along - std::sqrt(room));
    });
  }
  double first = depths.least;
  if (first == std::numeric_limits<double>::max()) {
    first = 0.0;
    std::size_t count = 0;
    for (const BallGroup& group : groups) count += group.balls.size();
    for (const BallGroup& group : groups)
      for_each_ball(group, 0, group.balls.size(), [&](const Ball& ball) {
        first += glm::dot(ball.center - camera.position, frame.basis.forward) / static_cast<double>(count);
      });
  }
  // A perspective camera needs some distance; 1 Å is sufficient inside an atom, too.
  frame.eye_distance = std::max(first, 1.0);
  frame.pivot = camera.position + frame.basis.forward * frame.eye_distance;
  const double half_height = half_extent(camera, 1.0).y;
  frame.pixel_size = 2.0 * half_height / size.y;
  if (camera.projection == Projection::perspective) frame.pixel_size *= frame.eye_distance;
  return frame;
}

float patch_slack(std::span<const Ball> atoms, double probe_radius, const PictureFrame& frame) {
  const BallGroup all{.balls = atoms};
  return slack_of({&all, 1}, probe_radius, frame);
}

PackPlacement place_atoms(std::span<const Ball> atoms, double probe_radius, const PictureFrame& frame) {
  const BallGroup all{.balls = atoms};
  return place_atoms({&all, 1}, probe_radius, frame);
}

PackPlacement place_atoms(std::span<const BallGroup> groups, double probe_radius, const PictureFrame& frame) {
  PackPlacement scene;
  scene.probe_radius = probe_radius;
  scene.slack = slack_of(groups, probe_radius, frame);
  Range depths;
  for (const BallGroup& group : groups) {
    const double middle = glm::dot(group.center - frame.camera.position, frame.basis.forward);
    const double reach = group.radius + kBoundRoom;
    if (middle - reach > depths.least && middle + reach < depths.largest) continue;
    note_balls(group, depths, [&](const Ball& ball, Range& noted) {
      const double depth = glm::dot(ball.center - frame.camera.position, frame.basis.forward);
      noted.least = std::min(noted.least, depth - ball.radius);
      noted.largest = std::max(noted.largest, depth + ball.radius);
    });
  }
  scene.first_depth = static_cast<float>(std::max(std::min(depths.least, depths.largest), 0.0));
  scene.last_depth = static_cast<float>(depths.largest);
  return scene;
}

void pack_scene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame, RayCastPack& scene) {
  scene.slack = patch_slack(surface.atoms, surface.probe_radius, frame);
  const std::vector<PatchRange> ranges = ranges_of(surface);
  std::vector<RayCastPack> parts(ranges.size());
  tbb::parallel_for(std::size_t{0}, ranges.size(), [&](std::size_t n) {
    parts[n].slack = scene.slack;
    Packer(surface, coloring, frame, parts[n]).pack(ranges[n]);
  });
  std::vector<PartPlace> places(parts.size() + 1);
  for (std::size_t n = 0; n < parts.size(); ++n)
    places[n + 1] = {places[n].primitive + parts[n].primitives.size(), places[n].row + parts[n].rows.size()};
  scene.primitives.resize(places.back().primitive);
  scene.rows.resize(places.back().row);
  tbb::parallel_for(std::size_t{0}, parts.size(),
                    [&](std::size_t n) { copy_part(std::exchange(parts[n], {}), places[n], scene); });
}

RayCastPack pack_scene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame) {
  RayCastPack scene;
  pack_scene(surface, coloring, frame, scene);
  return scene;
}

std::vector<BoundedPatch> bounded_patches(const Surface& surface, const Coloring& coloring) {
  const std::vector<PatchRange> ranges = ranges_of(surface);
  std::vector<std::vector<BoundedPatch>> parts(ranges.size());
  tbb::parallel_for(std::size_t{0}, ranges.size(), [&](std::size_t n) {
    const PictureFrame frame{};  // no picture: bounds do not depend on the frame
    RayCastPack scene;
    Packer packer(surface, coloring, frame, scene);
    const PatchKind kind = ranges[n].kind;
    for (std::uint32_t i = ranges[n].first; i < ranges[n].end; ++i) {
      if (!packer.may_show(kind, i)) continue;
      const PatchBound bound = packer.bound(kind, i);
      parts[n].push_back({kind, i, bound.center, bound.radius});
    }
  });
  std::vector<BoundedPatch> patches;
  for (const std::vector<BoundedPatch>& part : parts) patches.insert(patches.end(), part.begin(), part.end());
  return patches;
}

RayCastPack pack_patches(const PackedCopy& copy, std::span<const BoundedPatch> patches, const PictureFrame& frame) {
  RayCastPack scene;
  scene.slack = copy.slack;
  Packer packer(copy.surface, copy.coloring, frame, scene, &copy.motion, copy.first_atom);
  for (const BoundedPatch& patch : patches) packer.pack(patch.kind, patch.index);
  return scene;
}

std::vector<glm::vec4> linear_colors(const Coloring& coloring) {
  const auto atom_count = static_cast<std::uint32_t>(coloring.atom.size());
  std::vector<glm::vec4> colors;
  colors.reserve(atom_count + 3);
  for (std::uint32_t a = 0; a < atom_count; ++a)
    colors.emplace_back(linear_from_srgb(coloring.atom[a]), coloring.shows(a) ? coloring.opacity_of(a) : 0.0f);
  if (coloring.kind)
    for (const glm::vec3& color : *coloring.kind) colors.emplace_back(linear_from_srgb(color), 1.0f);
  return colors;
}

std::uint32_t row_count(const Primitive& primitive) {
  constexpr std::uint32_t kToroidalRows = 5;
  if (primitive.kind == ray_cast::kToroidal) return kToroidalRows;
  return 1 + primitive.plane_count + (primitive.kind == ray_cast::kConcave ? primitive.atom : 0);
}

namespace {

class ShapePacker {
 public:
  ShapePacker(const Coloring& coloring, const PictureFrame& frame, RayCastPack& scene)
      : coloring_(coloring), frame_(frame), scene_(scene) {}

  void pack(const SphereShape& sphere) {
    Primitive* const primitive = begin({sphere.center, sphere.radius}, ray_cast::kConvex);
    if (!primitive || !coloring_.shows(sphere.atom)) return drop(primitive);
    primitive->atom = sphere.atom;
    add_row(sphere.center - frame_.pivot, sphere.radius);
  }

  void pack(const CylinderShape& cylinder) {
    const glm::dvec3 middle = 0.5 * (cylinder.from + cylinder.to);
    const double half = 0.5 * glm::length(cylinder.to - cylinder.from);
    Primitive* const primitive = begin({middle, std::hypot(half, cylinder.radius)}, ray_cast::kCylinder);
    if (!primitive || (!coloring_.shows(cylinder.from_atom) && !coloring_.shows(cylinder.to_atom)))
      return drop(primitive);
    primitive->atom = cylinder.from_atom;
    primitive->second_atom = cylinder.to_atom;
    add_row(middle - frame_.pivot, cylinder.radius);
    add_row(glm::normalize(cylinder.to - cylinder.from), half);
  }

  void pack(const MeshShape& mesh, const std::array<std::uint32_t, 3>& corners) {
    const glm::dvec3 a = mesh.positions[corners[0]], b = mesh.positions[corners[1]], c = mesh.positions[corners[2]];
    const glm::dvec3 middle = (a + b + c) / 3.0;
    const double reach = std::max({glm::length(a - middle), glm::length(b - middle), glm::length(c - middle)});
    Primitive* const primitive = begin({middle, reach}, ray_cast::kTriangle);
    if (!primitive || std::ranges::none_of(corners, [&](std::uint32_t v) { return coloring_.shows(mesh.atoms[v]); }))
      return drop(primitive);
    primitive->atom = mesh.atoms[corners[0]];
    add_row(a - frame_.pivot, 0.0);
    add_row(b - a, 0.0);
    add_row(c - a, 0.0);
    for (const std::uint32_t v : corners)
      scene_.rows.emplace_back(mesh.normals[v], std::bit_cast<float>(mesh.atoms[v]));
  }

 private:
  void add_row(const glm::dvec3& v, double w) { scene_.rows.emplace_back(glm::vec3(v), static_cast<float>(w)); }

  /// Begins a primitive. Returns nullptr if the whole bound is behind the camera.
  Primitive* begin(const geometry::PatchBound& bound, std::uint32_t kind) {
    const geometry::SeenBound seen =
        geometry::see_bound(bound, scene_.slack, frame_.pivot, frame_.camera.position, frame_.basis.forward,
                            frame_.eye_distance, frame_.camera.projection == Projection::orthographic);
    if (!seen.in_front) return nullptr;
    Primitive& primitive = scene_.primitives.emplace_back();
    primitive.bound = glm::vec4(glm::vec3(seen.center), static_cast<float>(seen.radius));
    primitive.nearest = static_cast<float>(seen.nearest);
    primitive.first_row = static_cast<std::uint32_t>(scene_.rows.size());
    primitive.kind = kind;
    primitive.patch_index = primitive.tie_key = static_cast<std::uint32_t>(scene_.primitives.size() - 1);
    return &primitive;
  }

  void drop(const Primitive* primitive) {
    if (primitive) scene_.primitives.pop_back();
  }

  const Coloring& coloring_;
  const PictureFrame& frame_;
  RayCastPack& scene_;
};

}  // namespace

void pack_shapes(const Shapes& shapes, const Coloring& coloring, const PictureFrame& frame, float slack,
                 RayCastPack& scene) {
  scene.slack = slack;
  scene.primitives.clear();
  scene.rows.clear();
  ShapePacker packer(coloring, frame, scene);
  for (const SphereShape& sphere : shapes.spheres) packer.pack(sphere);
  for (const CylinderShape& cylinder : shapes.cylinders) packer.pack(cylinder);
  for (const std::array<std::uint32_t, 3>& corners : shapes.mesh.triangles) packer.pack(shapes.mesh, corners);
}

}  // namespace meniscus
