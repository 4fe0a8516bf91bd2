// SPDX-License-Identifier: BSD-3-Clause
// Checks the atoms that callers pass, looks up van der Waals radii by element, and reads a surface: its numbers,
// tables, distances and gradients.
#include "exporters/bindings/c/c_surface.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/structure/element_tables.h"
#include "core/surface/compute_surface.h"
#include "exporters/bindings/c/c_calls.h"

namespace meniscus::c_api {
namespace {

/// The largest number of atoms. An atom has up to a dozen borders, which have indices of 31 bits.
constexpr std::size_t kMostAtoms = std::size_t{1} << 27;

/// The largest atomic number.
constexpr std::int32_t kHeaviest = 118;

/// An array of a caller: rows of `width` floats or doubles.
class Numbers {
 public:
  Numbers(const void* data, std::size_t count, std::size_t width, std::size_t stride, std::int32_t type,
          const char* name)
      : data_(static_cast<const unsigned char*>(data)), single_(type == MENISCUS_FLOAT) {
    if (type != MENISCUS_FLOAT && type != MENISCUS_DOUBLE)
      refuse(MENISCUS_USAGE, "{}_type is {}, neither MENISCUS_DOUBLE nor MENISCUS_FLOAT", name, type);
    stride_ = require_rows(data, {count, width, single_ ? sizeof(float) : sizeof(double), stride}, name);
  }

  double at(std::size_t row, std::size_t column) const {
    const unsigned char* const place = data_ + row * stride_;
    return single_ ? static_cast<double>(reinterpret_cast<const float*>(place)[column])
                   : reinterpret_cast<const double*>(place)[column];
  }

 private:
  const unsigned char* data_;
  std::size_t stride_ = 0;
  bool single_;
};

void check_position(std::size_t atom, std::size_t axis, double value) {
  const char letter = "xyz"[axis];
  if (!std::isfinite(value)) refuse(MENISCUS_INPUT, "{} of atom {} is {}, not a finite number", letter, atom, value);
  if (std::abs(value) > kLargestCoordinate)
    refuse(MENISCUS_INPUT, "{} of atom {} is {} Å, beyond the {} Å that make sense; are these Å?", letter, atom, value,
           kLargestCoordinate);
}

void check_radius(std::size_t atom, double value) {
  if (!std::isfinite(value)) refuse(MENISCUS_INPUT, "the radius of atom {} is {}, not a finite number", atom, value);
  if (value <= 0.0)
    refuse(MENISCUS_INPUT, "the radius of atom {} is {} Å; it has to be above 0, or leave the atom out", atom, value);
  if (value > kLargestRadius)
    refuse(MENISCUS_INPUT, "the radius of atom {} is {} Å, beyond the {} Å that make sense", atom, value,
           kLargestRadius);
}

}  // namespace

std::vector<Ball> read_atoms(const meniscus_atoms* given) {
  const meniscus_atoms atoms = read_struct(given, meniscus_atoms{}, "meniscus_atoms");
  if (atoms.count == 0) refuse(MENISCUS_INPUT, "there are no atoms: meniscus_atoms.count is 0");
  if (atoms.count > kMostAtoms)
    refuse(MENISCUS_CAPACITY, "{} atoms are more than the {} that indices can count", atoms.count, kMostAtoms);
  require_zero(atoms.reserved, "meniscus_atoms.reserved");
  const Numbers positions(atoms.positions, atoms.count, 3, atoms.positions_stride, atoms.positions_type,
                          "meniscus_atoms.positions");
  const Numbers radii(atoms.radii, atoms.equal_radii ? 1 : atoms.count, 1, atoms.radii_stride, atoms.radii_type,
                      "meniscus_atoms.radii");
  std::vector<Ball> balls(atoms.count);
  for (std::size_t n = 0; n < balls.size(); ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = positions.at(n, axis);
      check_position(n, axis, value);
      balls[n].center[static_cast<int>(axis)] = value;
    }
    balls[n].radius = radii.at(atoms.equal_radii ? 0 : n, 0);
    check_radius(n, balls[n].radius);
  }
  return balls;
}

Coloring coloring_of(const glm::vec3& color, const float* of_atoms, std::size_t atoms) {
  for (int n = 0; n < 3; ++n) check_range("color", color[n], 0, 1);
  Coloring coloring;
  coloring.atom.assign(atoms, color);
  if (!of_atoms) return coloring;
  require_numbers(of_atoms, atoms, 3, "atom_colors");
  for (std::size_t n = 0; n < 3 * atoms; ++n) {
    const float channel = of_atoms[n];
    if (!(channel >= 0.0f && channel <= 1.0f))
      refuse(MENISCUS_INPUT, "channel {} of the colour of atom {} is {}; it has to be 0 to 1", n % 3, n / 3, channel);
    coloring.atom[n / 3][static_cast<int>(n % 3)] = channel;
  }
  return coloring;
}

const Surface& FinishedSurface::whole() const {
  const std::lock_guard lock(mutex_);
  if (surface.reduced) run_on_threads(threads, [&] { list_convex_planes(surface); });
  return surface;
}

const AtomAreas& FinishedSurface::areas() const {
  const std::lock_guard lock(mutex_);
  if (!areas_) run_on_threads(threads, [&] { areas_ = atom_areas(surface); });
  return *areas_;
}

const SurfaceDistance& FinishedSurface::distance() const {
  const Surface& drawn = whole();
  const std::lock_guard lock(mutex_);
  if (!distance_) distance_.emplace(drawn);
  return *distance_;
}

namespace {

// The rows of meniscus.h are those of core/surface/primitives.h. These assertions fail if their layout differs.
#define MENISCUS_SAME(ours, our_field, theirs, their_field)                   \
  static_assert(offsetof(ours, our_field) == offsetof(theirs, their_field) && \
                    sizeof(ours::our_field) == sizeof(theirs::their_field),   \
                #ours "::" #our_field " is not " #theirs "::" #their_field)
MENISCUS_SAME(Component, kind, meniscus_component, kind);
MENISCUS_SAME(Component, area, meniscus_component, area);
MENISCUS_SAME(Component, volume, meniscus_component, volume);
MENISCUS_SAME(Component, euler, meniscus_component, euler);
MENISCUS_SAME(Ball, center, meniscus_ball, center);
MENISCUS_SAME(Ball, radius, meniscus_ball, radius);
MENISCUS_SAME(Plane, normal, meniscus_plane, normal);
MENISCUS_SAME(Plane, offset, meniscus_plane, offset);
MENISCUS_SAME(ConvexPatch, atom, meniscus_convex, atom);
MENISCUS_SAME(ConvexPatch, first_plane, meniscus_convex, first_plane);
MENISCUS_SAME(ConvexPatch, plane_count, meniscus_convex, plane_count);
MENISCUS_SAME(ConvexPatch, first_face, meniscus_convex, first_face);
MENISCUS_SAME(ConvexPatch, face_count, meniscus_convex, face_count);
MENISCUS_SAME(ToroidalPatch, atom, meniscus_toroidal, atom);
MENISCUS_SAME(ToroidalPatch, probe, meniscus_toroidal, probe);
MENISCUS_SAME(ToroidalPatch, center, meniscus_toroidal, center);
MENISCUS_SAME(ToroidalPatch, axis, meniscus_toroidal, axis);
MENISCUS_SAME(ToroidalPatch, radius, meniscus_toroidal, radius);
MENISCUS_SAME(ToroidalPatch, start, meniscus_toroidal, start);
MENISCUS_SAME(ToroidalPatch, sweep, meniscus_toroidal, sweep);
MENISCUS_SAME(ToroidalPatch, first_face, meniscus_toroidal, first_face);
MENISCUS_SAME(ToroidalPatch, face_count, meniscus_toroidal, face_count);
MENISCUS_SAME(ToroidalPatch, has_piece, meniscus_toroidal, has_piece);
MENISCUS_SAME(ConcavePatch, center, meniscus_concave, center);
MENISCUS_SAME(ConcavePatch, first_contact, meniscus_concave, first_contact);
MENISCUS_SAME(ConcavePatch, contact_count, meniscus_concave, contact_count);
MENISCUS_SAME(ConcavePatch, first_plane, meniscus_concave, first_plane);
MENISCUS_SAME(ConcavePatch, side_count, meniscus_concave, side_count);
MENISCUS_SAME(ConcavePatch, cut_count, meniscus_concave, cut_count);
MENISCUS_SAME(ConcavePatch, parting_count, meniscus_concave, other_count);
MENISCUS_SAME(ConcavePatch, first_cut, meniscus_concave, first_cut);
MENISCUS_SAME(ConcavePatch, first_face, meniscus_concave, first_face);
MENISCUS_SAME(ConcavePatch, face_count, meniscus_concave, face_count);
MENISCUS_SAME(Border, kind, meniscus_border, kind);
MENISCUS_SAME(Border, center, meniscus_border, center);
MENISCUS_SAME(Border, axis, meniscus_border, axis);
MENISCUS_SAME(Border, radius, meniscus_border, radius);
MENISCUS_SAME(Border, start, meniscus_border, start);
MENISCUS_SAME(Border, sweep, meniscus_border, sweep);
MENISCUS_SAME(Border, vertex, meniscus_border, vertex);
MENISCUS_SAME(Border, face, meniscus_border, face);
MENISCUS_SAME(Loop, first_half_border, meniscus_loop, first_half_border);
MENISCUS_SAME(Loop, half_border_count, meniscus_loop, half_border_count);
MENISCUS_SAME(Face, kind, meniscus_face, kind);
MENISCUS_SAME(Face, patch, meniscus_face, patch);
MENISCUS_SAME(Face, first_loop, meniscus_face, first_loop);
MENISCUS_SAME(Face, loop_count, meniscus_face, loop_count);
MENISCUS_SAME(Face, component, meniscus_face, component);
MENISCUS_SAME(Face, tip, meniscus_face, tip);
MENISCUS_SAME(Face, area, meniscus_face, area);
#undef MENISCUS_SAME

meniscus_array find_table(const FinishedSurface& finished, std::int32_t table) {
  const Surface& s = finished.surface;
  switch (table) {
    case MENISCUS_COMPONENTS:
      return table_of(s.components);
    case MENISCUS_ATOM_AREAS:
      return table_of(finished.areas().surface);
    case MENISCUS_ATOM_SAS_AREAS:
      if (finished.kind != SurfaceKind::ses)
        refuse(MENISCUS_USAGE, "MENISCUS_ATOM_SAS_AREAS are of MENISCUS_SES surfaces; see MENISCUS_ATOM_AREAS");
      return table_of(finished.areas().accessible);
    case MENISCUS_ATOMS:
      return table_of(s.atoms);
    case MENISCUS_CONVEX:
      return table_of(finished.whole().convex);
    case MENISCUS_TOROIDAL:
      return table_of(s.toroidal);
    case MENISCUS_CONCAVE:
      return table_of(s.concave);
    case MENISCUS_PLANES:
      return table_of(finished.whole().planes);
    case MENISCUS_CONTACTS:
      return table_of(s.contacts);
    case MENISCUS_CUTS:
      return table_of(s.cuts);
    case MENISCUS_VERTICES:
      return table_of(s.vertices);
    case MENISCUS_BORDERS:
      return table_of(s.borders);
    case MENISCUS_HALF_BORDERS:
      return table_of(s.half_borders);
    case MENISCUS_LOOPS:
      return table_of(s.loops);
    case MENISCUS_FACES:
      return table_of(s.faces);
    default:
      refuse(MENISCUS_USAGE, "a surface has no table {}", table);
  }
}

meniscus_summary summary_of(const FinishedSurface& finished) {
  const Surface& s = finished.surface;
  const SurfaceCounts counts = s.counts();
  meniscus_summary summary{};
  summary.area = s.area;
  summary.volume = s.volume;
  summary.probe_radius = finished.probe_radius;
  summary.grown_by = s.certificate.grown_by;
  summary.exact_within = s.certificate.exact_within;
  summary.atoms = s.atoms.size();
  summary.convex = counts.convex;
  summary.toroidal = counts.toroidal;
  summary.concave = counts.concave;
  summary.free_edges = counts.free_edges;
  summary.spindle = counts.spindle;
  summary.fixed_probes = counts.fixed_probes;
  summary.arcs = counts.arcs;
  summary.faces = s.faces.size();
  summary.borders = s.borders.size();
  summary.vertices = s.vertices.size();
  summary.components = s.components.size();
  for (const Component& component : s.components) summary.cavities += component.kind == ComponentKind::cavity;
  summary.device = finished.device.c_str();
  return summary;
}

void check_points(std::size_t count, const double* points) {
  for (std::size_t n = 0; n < 3 * count; ++n) {
    if (!std::isfinite(points[n]))
      refuse(MENISCUS_INPUT, "{} of point {} is {}, not a finite number", "xyz"[n % 3], n / 3, points[n]);
    if (std::abs(points[n]) > SurfaceDistance::kFarthest)
      refuse(MENISCUS_INPUT, "{} of point {} is {} Å; distances are known up to coordinates of {} Å", "xyz"[n % 3],
             n / 3, points[n], SurfaceDistance::kFarthest);
  }
}

void find_distances(const FinishedSurface& finished, std::size_t count, const double* points, double* distances,
                    double* nearest) {
  const SurfaceDistance& distance = finished.distance();
  run_on_threads(finished.threads, [&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
      for (std::size_t n = range.begin(); n != range.end(); ++n) {
        const NearestPoint found = distance({points[3 * n], points[3 * n + 1], points[3 * n + 2]});
        distances[n] = found.distance;
        for (int axis = 0; nearest && axis < 3; ++axis) nearest[3 * n + axis] = found.point[axis];
      }
    });
  });
}

Gradient find_gradient(const FinishedSurface& finished, std::int32_t quantity, const double* given) {
  const Surface& s = finished.surface;
  const bool is_ses = finished.kind == SurfaceKind::ses;
  const bool by_atom = quantity == (is_ses ? MENISCUS_GRADIENT_SAS_AREA : MENISCUS_GRADIENT_AREA);
  if (quantity < MENISCUS_GRADIENT_AREA || quantity > MENISCUS_GRADIENT_SAS_VOLUME)
    refuse(MENISCUS_USAGE, "a surface has no gradient {}", quantity);
  if (!is_ses && quantity >= MENISCUS_GRADIENT_SAS_AREA)
    refuse(MENISCUS_USAGE,
           "gradients of MENISCUS_GRADIENT_SAS_... are of MENISCUS_SES surfaces; see MENISCUS_GRADIENT_AREA");
  if (given && !by_atom) refuse(MENISCUS_USAGE, "only gradients of areas, which are sums over atoms, take weights");
  const std::span<const double> weights(given, given ? s.atoms.size() : 0);
  for (std::size_t n = 0; n < weights.size(); ++n)
    if (!std::isfinite(weights[n]))
      refuse(MENISCUS_INPUT, "the weight of atom {} is {}, not a finite number", n, weights[n]);
  if (by_atom) return accessible_area_gradient(s, weights);
  if (quantity == MENISCUS_GRADIENT_SAS_VOLUME) return accessible_volume_gradient(s);
  try {
    return quantity == MENISCUS_GRADIENT_AREA ? area_gradient(s) : volume_gradient(s);
  } catch (const RequestError& tied) {
    refuse(MENISCUS_INPUT, "{}", tied.what());
  }
}

}  // namespace
}  // namespace meniscus::c_api

meniscus_surface* meniscus_surface_retain(meniscus_surface* surface) { return meniscus::c_api::retain(surface); }
void meniscus_surface_release(meniscus_surface* surface) { meniscus::c_api::release(surface); }

meniscus_status meniscus_surface_summary(const meniscus_surface* surface, meniscus_summary* summary) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(surface, "surface");
    require(summary, "summary");
    write_struct(summary, summary_of(*surface->finished), "meniscus_summary");
  });
}

meniscus_status meniscus_surface_table(const meniscus_surface* surface, meniscus_surface_table_id table,
                                       meniscus_array* array) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(surface, "surface");
    require(array, "array");
    *array = find_table(*surface->finished, table);
  });
}

meniscus_status meniscus_surface_distance(const meniscus_surface* surface, std::size_t count, const double* points,
                                          double* distances, double* nearest) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(surface, "surface");
    if (count == 0) return;
    require_numbers(points, count, 3, "points");
    require_numbers(distances, count, 1, "distances");
    const std::size_t of_numbers = count * sizeof(double), of_points = 3 * of_numbers;
    require_apart(distances, of_numbers, "distances", points, of_points, "points");
    if (nearest) {
      require_numbers(nearest, count, 3, "nearest");
      require_apart(nearest, of_points, "nearest", distances, of_numbers, "distances");
      if (nearest != points) require_apart(nearest, of_points, "nearest", points, of_points, "points");
    }
    check_points(count, points);
    find_distances(*surface->finished, count, points, distances, nearest);
  });
}

meniscus_status meniscus_surface_gradient(const meniscus_surface* surface, meniscus_quantity quantity,
                                          const double* weights, double* gradient) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(surface, "surface");
    const std::size_t atoms = surface->finished->surface.atoms.size();
    require(gradient, "gradient");
    if (weights) require_numbers(weights, atoms, 1, "weights");
    const meniscus::Gradient found = find_gradient(*surface->finished, quantity, weights);
    for (std::size_t a = 0; a < found.size(); ++a)
      for (int axis = 0; axis < 3; ++axis) gradient[3 * a + static_cast<std::size_t>(axis)] = found[a][axis];
  });
}

meniscus_status meniscus_element_of_symbol(const char* symbol, std::int32_t* element) {
  using namespace meniscus;
  return c_api::guarded([&] {
    c_api::require(symbol, "symbol");
    c_api::require(element, "element");
    *element = element_of_symbol(symbol);
  });
}

meniscus_status meniscus_element_radius(std::int32_t element, double* radius, const char** source) {
  using namespace meniscus;
  return c_api::guarded([&] {
    c_api::require(radius, "radius");
    if (source) c_api::require(source, "source");
    if (element < 0 || element > c_api::kHeaviest)
      c_api::refuse(MENISCUS_INPUT, "there is no element {}; atomic numbers go to {}", element, c_api::kHeaviest);
    const ElementRadius found = bondi_radius(static_cast<std::uint8_t>(element));
    *radius = found.radius;
    if (source) *source = source_name(found.source);
  });
}
