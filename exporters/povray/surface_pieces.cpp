// SPDX-License-Identifier: BSD-3-Clause
// Writes surfaces as unions of pieces, and places their copies in the scene.
#include "exporters/povray/surface_pieces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_key_json.h"
#include "core/color/color_maps.h"
#include "exporters/povray/patch_objects.h"
#include "exporters/povray/scene_colors.h"

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

// POV-Ray multiplies row vectors by matrices: the first three rows are the images of the axes. Scene coordinates are
// relative to the origin.
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

}  // namespace meniscus::povray
