// SPDX-License-Identifier: BSD-3-Clause
// Writes patches as spheres and tori cut out by planes with their exact boxes, surfaces as unions of pieces, places
// their copies, and composes notes for the report of a scene.
#include "exporters/povray/surface_pieces.h"

#include <nlohmann/json.hpp>

#include "core/color/color_key_json.h"
#include "core/surface/walks.h"

namespace meniscus::povray {
namespace {

constexpr std::size_t kFlushBytes = std::size_t{1} << 20;
constexpr double kLeastShare = 1e-6;  // the least scale towards the centre of a sphere, as a share of its radius

bool is_identity(const RigidMotion& motion) {
  return motion.rotation == glm::dmat3(1.0) && motion.translation == glm::dvec3(0.0);
}

/// Returns the index after the last piece that has the kind and the colour of piece `begin`.
std::size_t group_end(const std::vector<ColoredPiece>& pieces, std::size_t begin) {
  std::size_t end = begin;
  while (end < pieces.size() && pieces[end].kind == pieces[begin].kind && pieces[end].color == pieces[begin].color)
    ++end;
  return end;
}

void flush(OutputFile& file, SceneText& out, std::size_t limit) {
  if (out.text().size() < limit) return;
  file.write(out.text());
  out.clear();
}

/// Appends the textures of both sides of a piece. The outside of the sphere of a convex patch is solvent; the outside
/// of a torus or a probe is solid. moved: the transformation of the textures as scene text.
void append_textures(SceneText& out, const ColoredPiece& piece, std::string_view moved) {
  const bool convex = piece.kind == PatchKind::convex;
  const auto side = [&](std::string_view property, std::string_view name) {
    out.literal(property).literal("{Meniscus_").literal(name).literal("_Side[");
    out.count(static_cast<std::size_t>(piece.kind)).literal("][").count(piece.color).literal("]");
    out.literal(moved).literal("}");
  };
  out.literal("#if (Meniscus_Own_Textures) ");
  side("texture", convex ? "Solvent" : "Solid");
  side(" interior_texture", convex ? "Solid" : "Solvent");
  out.literal(" #end\n");
}

}  // namespace

Geometry::Geometry(std::span<const SurfaceObject> objects, const glm::dvec3& origin, ColorTable& table,
                   ObjectStyle style, std::span<const ClipPlane> clip, std::span<const std::string> names)
    : objects_(objects), origin_(origin), style_(style), clip_(clip), names_(names) {
  if (!clip_.empty() && declares_objects()) throw Error("POV-Ray export: planes cut a single object in its place");
  for (const SurfaceObject& object : objects)
    palettes_.push_back(make_palette(object.surface, object.coloring, table, style_));
  for (std::size_t n = 0; !clip_.empty() && n < palettes_.size(); ++n) {
    const PatchObjects primitives(objects_[n].surface, palettes_[n], origin_, clip_);
    std::erase_if(palettes_[n].pieces, [&](const ColoredPiece& piece) { return primitives.is_cut_away(piece); });
  }
}

std::size_t Geometry::primitive_count() const {
  std::size_t count = 0;
  for (const Palette& palette : palettes_) count += palette.pieces.size();
  return count;
}

std::size_t Geometry::primitives_in_memory() const {
  if (!declares_objects()) return primitive_count();
  std::size_t count = 0;
  for (std::size_t n = 0; n < objects_.size(); ++n)
    count += palettes_[n].pieces.size() * (1 + objects_[n].copies.size());
  return count;
}

bool Geometry::declares_objects() const {
  if (objects_.empty()) return false;
  return objects_.size() > 1 || objects_[0].copies.size() != 1 || !is_identity(objects_[0].copies[0]);
}

bool Geometry::is_one_item() const {
  if (!declares_objects()) return !objects_.empty() && item_count(0) == 1;
  std::size_t copies = 0;
  for (std::size_t n = 0; n < objects_.size(); ++n)
    copies += palettes_[n].pieces.empty() ? 0 : objects_[n].copies.size();
  return copies == 1;
}

std::size_t Geometry::item_count(std::size_t object) const {
  const std::vector<ColoredPiece>& pieces = palettes_[object].pieces;
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < pieces.size();) {
    const std::size_t end = group_end(pieces, begin);
    count += has_offset_textures(object, pieces[begin]) ? end - begin : 1;
    begin = end;
  }
  return count;
}

void Geometry::write_pieces(OutputFile& file, SceneText& out, std::size_t object) const {
  const std::vector<ColoredPiece>& pieces = palettes_[object].pieces;
  const PatchObjects primitives(objects_[object].surface, palettes_[object], origin_, clip_);
  for (std::size_t begin = 0; begin < pieces.size();) {
    const std::size_t end = group_end(pieces, begin);
    if (has_offset_textures(object, pieces[begin])) {
      for (; begin < end; ++begin) {
        out.literal("object{\n");
        append_comment(out, object, pieces[begin]);
        primitives.append(out, pieces[begin]);
        append_offset_textures(out, object, pieces[begin]);
        flush(file, out, kFlushBytes);
      }
      continue;
    }
    out.literal(end - begin > 1 ? "union{\n" : "object{\n");
    for (std::size_t n = begin; n < end; ++n) {
      append_comment(out, object, pieces[n]);
      primitives.append(out, pieces[n]);
      flush(file, out, kFlushBytes);
    }
    append_textures(out, pieces[begin], "");
    out.literal("}\n");
    begin = end;
  }
}

void Geometry::append_comment(SceneText& out, std::size_t object, const ColoredPiece& piece) const {
  if (names_.empty()) return;
  const Surface& surface = objects_[object].surface;
  std::span<const std::uint32_t> touched;
  if (piece.kind == PatchKind::convex) touched = std::span(&surface.convex[piece.patch].atom, 1);
  if (piece.kind == PatchKind::toroidal) touched = surface.toroidal[piece.patch].atom;
  if (piece.kind == PatchKind::concave) {
    const ConcavePatch& patch = surface.concave[piece.patch];
    touched = std::span(surface.contacts).subspan(patch.first_contact, patch.contact_count);
  }
  std::vector<std::uint32_t> atoms;
  for (const std::uint32_t a : touched) atoms.push_back(objects_[object].atom[a]);
  out.literal(piece_comment(piece.kind, atoms, names_));
}

bool Geometry::has_offset_textures(std::size_t object, const ColoredPiece& piece) const {
  const Coloring& coloring = objects_[object].coloring;
  return coloring.volume && coloring.volume->offset != 0.0 && piece.by_map;
}

// Moving all points of a sphere along their normals scales the sphere about its centre. Moving a point of a torus along
// its normal moves it towards the centre line of the tube or away from it.
void Geometry::append_offset_textures(SceneText& out, std::size_t object, const ColoredPiece& piece) const {
  const Surface& surface = objects_[object].surface;
  const double offset = objects_[object].coloring.volume->offset;
  const double probe = surface.probe_radius;
  if (piece.kind == PatchKind::toroidal) {
    const ToroidalPatch& patch = surface.toroidal[piece.patch];
    SceneText place;
    place.literal("pigment{function{Meniscus_Map_On_Torus(x,y,z");
    const glm::dvec3 center = patch.center - origin_;
    for (int k = 0; k < 3; ++k) place.literal(",").length(center[k]);
    for (int k = 0; k < 3; ++k) place.literal(",").ratio(patch.axis[k]);
    place.literal(",").length(patch.radius).literal(",").ratio(offset / probe).literal(")} ");
    const auto side = [&](std::string_view property, std::string_view number) {
      out.literal(property).literal("{").literal(place.text()).literal("color_map{Meniscus_Map_Colors[");
      out.literal(number).literal("][").count(piece.color).literal("]}} finish{Meniscus_Map_Finish[").literal(number);
      out.literal("][").count(piece.color).literal("]}}");
    };
    out.literal("#if (Meniscus_Buffer = 0) ");
    side("texture", "1");
    side(" interior_texture", "0");
    out.literal("\n#else ");
    append_textures(out, piece, "");
    out.literal("#end\n}\n");
    return;
  }
  const bool convex = piece.kind == PatchKind::convex;
  const Ball& atom = surface.atoms[convex ? surface.convex[piece.patch].atom : 0];
  const glm::dvec3 center = (convex ? atom.center : surface.concave[piece.patch].center) - origin_;
  const double share = convex ? (atom.radius + offset) / atom.radius : (probe - offset) / probe;
  SceneText motion;
  motion.literal(" translate ").point(-center).literal(" scale ");
  motion.full(1.0 / (std::abs(share) < kLeastShare ? kLeastShare : share)).literal(" translate ").point(center);
  append_textures(out, piece, motion.text());
  out.literal("}\n");
}

// POV-Ray multiplies row vectors by matrices, whose first rows are the images of the axes, relative to the origin.
void Geometry::append_copy(SceneText& out, std::size_t object, const RigidMotion& motion) const {
  out.literal("object{object_").count(object + 1);
  if (!is_identity(motion)) {
    out.literal(" matrix<");
    const glm::dvec3 shift = motion(origin_) - origin_;
    for (int row = 0; row < 4; ++row) {
      const glm::dvec3 values = row < 3 ? motion.rotation[row] : shift;
      for (int k = 0; k < 3; ++k) out.full(values[k]).literal(row == 3 && k == 2 ? ">" : ",");
    }
  }
  out.literal("}\n");
}

void Geometry::write(OutputFile& file, std::string_view head) const {
  SceneText out;
  out.literal("// The patches of molecular surfaces, one primitive each; nothing here but geometry.\n");
  out.literal("// Position in the molecule's file = position here + ").full_vector(origin_).literal(" (Å).\n");
  if (!objects_.empty()) out.literal("// Probe radius ").length(objects_[0].surface.probe_radius).literal(" Å.\n");
  out.literal("// ").count(primitive_count()).literal(" primitives.\n").literal(head);
  for (std::size_t n = 0; n < objects_.size(); ++n) {
    if (palettes_[n].pieces.empty()) continue;
    const bool several = item_count(n) > 1;
    if (declares_objects()) out.literal("#local object_").count(n + 1).literal(several ? " =\nunion{\n" : " =\n");
    write_pieces(file, out, n);
    if (declares_objects() && several) out.literal("}\n");
  }
  for (std::size_t n = 0; declares_objects() && n < objects_.size(); ++n) {
    if (palettes_[n].pieces.empty()) continue;
    for (const RigidMotion& copy : objects_[n].copies) append_copy(out, n, copy);
  }
  flush(file, out, 0);
}

void Geometry::add_caps(CapMesh mesh, std::span<const SurfaceObject> objects, const SurfaceCut& cut,
                        ColorTable& table) {
  caps_ = colored_caps(std::move(mesh), objects, cut.style, style_, table);
}

void Geometry::write_caps(OutputFile& file, const SurfaceCut& cut) const {
  povray::write_caps(file, caps_, cut, origin_);
}

std::string Geometry::names_json(const std::optional<ColorKey>& colors) const {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (std::size_t n = 0; n < objects_.size(); ++n) {
    list.push_back({{"object", fmt::format("object_{}", n + 1)},
                    {"name", escaped(objects_[n].name)},
                    {"primitives", palettes_[n].pieces.size()},
                    {"copies", objects_[n].copies.size()}});
  }
  Json result{{"objects", list}};
  if (colors) result["colors"] = color_key_json(*colors);
  return result.dump(1, ' ', true, Json::error_handler_t::replace) + "\n";
}

namespace {

// The margin of boxes in Å, which is more than the rounding of any written number.
constexpr double kBoxMargin = 1e-5;

// Returns the half-space of points whose direction from `probe` is nearer to the contact direction `near` than to
// `far`. The directions have unit length.
Plane nearer_to(const glm::dvec3& near, const glm::dvec3& far, const glm::dvec3& probe) {
  const glm::dvec3 normal = glm::normalize(far - near);
  return {normal, glm::dot(normal, probe)};
}

/// Returns the least and the greatest height of a box along the unit vector `normal`.
std::pair<double, double> heights(const Box& box, const glm::dvec3& normal) {
  const double middle = glm::dot(normal, 0.5 * (box.low + box.high));
  const double half = glm::dot(glm::abs(normal), 0.5 * (box.high - box.low));
  return {middle - half, middle + half};
}

}  // namespace

Box PatchObjects::extent(const ColoredPiece& piece) const {
  if (piece.kind == PatchKind::toroidal) return toroidal_extent(surface_, surface_.toroidal[piece.patch]);
  if (piece.kind == PatchKind::concave) return concave_extent(surface_, surface_.concave[piece.patch]);
  const Ball& atom = surface_.atoms[surface_.convex[piece.patch].atom];
  return {atom.center - atom.radius, atom.center + atom.radius};
}

bool PatchObjects::is_cut_away(const ColoredPiece& piece) const {
  if (clip_.empty()) return false;
  const Box box = extent(piece);
  return std::ranges::any_of(
      clip_, [&](const ClipPlane& cut) { return heights(box, cut.normal).first > cut.offset + kBoxMargin; });
}

void PatchObjects::cuts(SceneText& out, const ColoredPiece& piece) const {
  if (clip_.empty()) return;
  const Box box = extent(piece);
  for (const ClipPlane& cut : clip_)
    if (heights(box, cut.normal).second > cut.offset - kBoxMargin)
      plane(out, {cut.normal, cut.offset}, 0.5 * (box.low + box.high));
}

void PatchObjects::append(SceneText& out, const ColoredPiece& piece) const {
  SceneText cut_by;
  cuts(cut_by, piece);
  switch (piece.kind) {
    case PatchKind::convex:
      convex(out, surface_.convex[piece.patch], cut_by.text());
      break;
    case PatchKind::toroidal:
      toroidal(out, surface_.toroidal[piece.patch], piece.part, cut_by.text());
      break;
    case PatchKind::concave:
      concave(out, surface_.concave[piece.patch], piece.part, cut_by.text());
      break;
  }
  out.literal("\n");
}

void PatchObjects::plane(SceneText& out, const Plane& p, const glm::dvec3& anchor) const {
  out.plane({p.normal, p.offset - glm::dot(p.normal, origin_)}, anchor - origin_);
}

void PatchObjects::box(SceneText& out, const glm::dvec3& low, const glm::dvec3& high) const {
  out.literal("box{").point(low - origin_ - kBoxMargin).literal(",").point(high - origin_ + kBoxMargin).literal("}");
}

void PatchObjects::convex(SceneText& out, const ConvexPatch& patch, std::string_view cuts) const {
  const Ball& atom = surface_.atoms[patch.atom];
  out.literal("sphere{").point(atom.center - origin_).literal(",").length(atom.radius);
  if (patch.plane_count > 0 || !cuts.empty()) {
    out.literal(" clipped_by{");
    for (std::uint32_t n = 0; n < patch.plane_count; ++n)
      plane(out, surface_.planes[patch.first_plane + n], atom.center);
    out.literal(cuts).literal("}");
  }
  out.literal("}");
}

void PatchObjects::toroidal(SceneText& out, const ToroidalPatch& patch, std::uint32_t part,
                            std::string_view cuts) const {
  const double p = surface_.probe_radius;
  out.literal("torus{").length(patch.radius).literal(",").length(p).literal(" matrix<");
  // The local y axis is the axis of the torus. The matrix precedes clipped_by, so the clips stay in scene coordinates.
  for (const glm::dvec3& row : {patch.start, patch.axis, glm::cross(patch.start, patch.axis)})
    out.ratio(row.x).literal(",").ratio(row.y).literal(",").ratio(row.z).literal(",");
  const glm::dvec3 center = patch.center - origin_;
  out.length(center.x).literal(",").length(center.y).literal(",").length(center.z).literal("> clipped_by{");
  visibility_sphere(out, patch);
  wedge(out, patch);
  if (surface_.spindle(patch)) {
    const double lemon = std::sqrt((p - patch.radius) * (p + patch.radius));
    out.literal("sphere{").point(center).literal(",").length(lemon).literal(" inverse}");
    // The two pieces of a spindle lie on opposite sides of the plane of the circle.
    const double height = glm::dot(patch.axis, patch.center);
    if (!patch.has_piece[0]) plane(out, {-patch.axis, -height}, patch.center);
    if (!patch.has_piece[1]) plane(out, {patch.axis, height}, patch.center);
  }
  part_half(out, patch, part);
  out.literal(cuts);
  const Box extent = toroidal_extent(surface_, patch);
  box(out, extent.low, extent.high);
  out.literal("}}");
}

// The centre of the visibility sphere is where the bisector of the angle at the probe meets the line through the atoms,
// so both contact points are equally far from it. The sphere meets the torus in the two contact circles only.
void PatchObjects::visibility_sphere(SceneText& out, const ToroidalPatch& patch) const {
  const double p = surface_.probe_radius;
  const Ball &a = surface_.atoms[patch.atom[0]], &b = surface_.atoms[patch.atom[1]];
  const double share = (a.radius + p) / (a.radius + b.radius + 2.0 * p);
  const glm::dvec3 center = a.center + share * (b.center - a.center);
  const glm::dvec3 probe = patch.center + patch.radius * patch.start;
  const glm::dvec3 contact = probe + (a.center - probe) * (p / (a.radius + p));
  out.literal("sphere{").point(center - origin_).literal(",").length(glm::distance(center, contact)).literal("}");
}

void PatchObjects::wedge(SceneText& out, const ToroidalPatch& patch) const {
  if (patch.free()) return;
  const glm::dvec3 side = glm::cross(patch.axis, patch.start);
  const glm::dvec3 end_side = std::cos(patch.sweep) * side - std::sin(patch.sweep) * patch.start;
  const bool reflex = patch.sweep > std::numbers::pi;
  if (reflex) out.literal("union{");
  plane(out, {-side, glm::dot(-side, patch.center)}, patch.center);
  plane(out, {end_side, glm::dot(end_side, patch.center)}, patch.center);
  if (reflex) out.literal("}");
}

// The points of a saddle that are equally near to both contact directions form a circle about the axis.
void PatchObjects::part_half(SceneText& out, const ToroidalPatch& patch, std::uint32_t part) const {
  const bool of_first = palette_.atom_part[patch.atom[0]] == part;
  if (of_first == (palette_.atom_part[patch.atom[1]] == part)) return;
  const glm::dvec3 probe = patch.center + patch.radius * patch.start;
  const glm::dvec3 middle = glm::normalize(glm::normalize(surface_.atoms[patch.atom[0]].center - probe) +
                                           glm::normalize(surface_.atoms[patch.atom[1]].center - probe));
  const glm::dvec3 border = probe + surface_.probe_radius * middle;
  const glm::dvec3 normal = of_first ? patch.axis : -patch.axis;
  plane(out, {normal, glm::dot(normal, border)}, patch.center);
}

void PatchObjects::concave(SceneText& out, const ConcavePatch& patch, std::uint32_t part, std::string_view cuts) const {
  out.literal("sphere{").point(patch.center - origin_).literal(",").length(surface_.probe_radius);
  out.literal(" clipped_by{");
  for (std::uint32_t n = 0; n < patch.plane_count(); ++n)
    plane(out, surface_.planes[patch.first_plane + n], patch.center);
  part_cells(out, patch, part);
  out.literal(cuts);
  const Box extent = concave_extent(surface_, patch);
  box(out, extent.low, extent.high);
  out.literal("}}");
}

// A point belongs to the part if one contact of that part is nearer than all contacts of other parts.
void PatchObjects::part_cells(SceneText& out, const ConcavePatch& patch, std::uint32_t part) const {
  std::vector<glm::dvec3> own, other;
  for (std::uint32_t n = 0; n < patch.contact_count; ++n) {
    const std::uint32_t atom = surface_.contacts[patch.first_contact + n];
    const glm::dvec3 direction = glm::normalize(surface_.atoms[atom].center - patch.center);
    (palette_.atom_part[atom] == part ? own : other).push_back(direction);
  }
  if (other.empty()) return;
  if (own.size() > 1) out.literal("union{");
  for (const glm::dvec3& near : own) {
    if (own.size() > 1 && other.size() > 1) out.literal("intersection{");
    for (const glm::dvec3& far : other) plane(out, nearer_to(near, far, patch.center), patch.center);
    if (own.size() > 1 && other.size() > 1) out.literal("}");
  }
  if (own.size() > 1) out.literal("}");
}

namespace {

// Extreme points this far outside of an arc or a plane are included: a box may be too large, never too small.
constexpr double kGenerous = 1e-9;

void include_face(Box& box, const Surface& surface, const Face& face) {
  for_each_border(surface, face, [&](const Border& border) {
    const Box arc = arc_extent(border);
    box.include(arc.low);
    box.include(arc.high);
  });
  if (face.tip != kNone) box.include(surface.vertices[face.tip]);
}

}  // namespace

Box arc_extent(const Border& b) {
  const glm::dvec3 side = glm::cross(b.axis, b.start);
  Box box;
  box.include(arc_point(b, 0.0));
  box.include(arc_point(b, b.sweep));
  for (int k = 0; k < 3; ++k) {
    const double turn = std::atan2(side[k], b.start[k]);  // the greatest coordinate; the least is half a turn later
    for (const double t : {turn, turn + std::numbers::pi}) {
      const double from_start = t < -kGenerous ? t + 2.0 * std::numbers::pi : t;
      if (from_start <= b.sweep + kGenerous) box.include(arc_point(b, from_start));
    }
  }
  return box;
}

Box toroidal_extent(const Surface& surface, const ToroidalPatch& patch) {
  Box box;
  for (const Face& face : faces_of(surface, patch)) include_face(box, surface, face);
  return box;
}

Box concave_extent(const Surface& surface, const ConcavePatch& patch) {
  Box box;
  for (const Face& face : faces_of(surface, patch)) include_face(box, surface, face);
  for (int k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) {
      glm::dvec3 pole = patch.center;
      pole[k] += sign * surface.probe_radius;
      bool inside = true;
      for (std::uint32_t n = 0; n < patch.plane_count(); ++n) {
        const Plane& plane = surface.planes[patch.first_plane + n];
        inside = inside && glm::dot(plane.normal, pole) <= plane.offset + kGenerous;
      }
      if (inside) box.include(pole);
    }
  return box;
}

namespace {

constexpr std::size_t kMemoryWarningObjects = 2'000'000;  // about 3.5 GB in POV-Ray 3.7

}  // namespace

Box atom_extent(std::span<const SurfaceObject> objects) {
  Box box;
  for (const SurfaceObject& object : objects)
    for (const RigidMotion& copy : object.copies)
      for (const Ball& b : object.surface.atoms) {
        box.include(copy(b.center) - b.radius);
        box.include(copy(b.center) + b.radius);
      }
  return box;
}

void check(std::span<const SurfaceObject> objects, const SceneOptions& options) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  bool name_is_plain = !options.name.empty();
  for (const char c : options.name) name_is_plain = name_is_plain && allowed(c);
  if (!name_is_plain) throw Error("POV-Ray export: a scene's name has only letters, digits, '-' and '_'");
  if (options.width < 1 || options.height < 1) throw Error("POV-Ray export: a picture has at least one pixel");
  for (const SurfaceObject& object : objects)
    if (object.surface.atoms.empty()) throw Error("POV-Ray export: there is no atom");
}

glm::dvec3 middle(const Box& extent) { return glm::round((extent.low + extent.high) * 0.5e3) / 1e3; }

std::vector<std::string> notes(std::span<const SurfaceObject> objects, const Geometry& geometry, const Camera& camera) {
  std::vector<std::string> sentences;
  // Rays of an orthographic camera begin on the plane through it, in POV-Ray as in the ray caster.
  const glm::dvec3 forward = view_basis(camera).forward;
  std::size_t behind = 0, cut_away = 0;
  for (const SurfaceObject& object : objects) {
    for (const RigidMotion& copy : object.copies)
      behind += static_cast<std::size_t>(std::ranges::count_if(object.surface.atoms, [&](const Ball& b) {
        return glm::dot(copy(b.center) - camera.position, forward) < b.radius;
      }));
    for (const ConcavePatch& c : object.surface.concave) cut_away += c.face_count == 0;
  }
  if (camera.projection == Projection::orthographic && behind > 0)
    sentences.push_back(fmt::format("{} atoms reach behind the orthographic camera and are cut off there", behind));
  if (cut_away > 0)
    sentences.push_back(
        fmt::format("{} fixed probes have no object: other probes cut all of their patch away", cut_away));
  const std::size_t primitives = geometry.primitives_in_memory();
  if (primitives > kMemoryWarningObjects)
    sentences.push_back(fmt::format("{} primitives, copies included, need about {} GB of memory in POV-Ray", primitives,
                                    primitives * 18 / 10'000'000));
  return sentences;
}

}  // namespace meniscus::povray
