// SPDX-License-Identifier: BSD-3-Clause
// Makes molecules from files, measures what volume maps cover, and computes areas that surroundings bury.
#include "core/scene/molecule.h"

#include "core/color/lipophilicity.h"
#include "core/color/ordered_classes.h"
#include "core/queries/copies.h"
#include "core/queries/surface_parts.h"
#include "core/structure/element_tables.h"
#include "core/trajectory/formats/trajectory_formats.h"

namespace meniscus {
namespace {

void refuse_trajectory(const std::string& path) {
  const std::string_view format = bare_trajectory_format(path);
  if (format.empty()) return;
  throw InputError(path, 0,
                   message("is a trajectory ({}) and holds no atoms; give their structure or topology as FILE, and "
                           "this one with @trajectory@",
                           format));
}

ReadOptions reading_of(const MoleculeRequest& request) {
  ReadOptions reading = request.reading;
  if (request.division.instances == InstanceMode::none) return reading;
  reading.copy_mode = CopyMode::instances;
  reading.companions = Companions::none;
  return reading;
}

/// Returns the map with the colours of its values. The user must give their range: potentials inside a molecule are
/// huge, so that the range of the whole map does not suit its surface.
std::shared_ptr<const VolumePaint> volume_paint(const MoleculeRequest& request, const ColorScheme& color) {
  if (!color.range)
    throw RequestError(
        message("@color-map-file@ needs @color-range LO:HI@, the values at the ends of the map, such as -5:5"));
  VolumeGrid grid = read_volume(request.volume_file);
  ColorScale scale;
  scale.title = !color.title.empty() ? color.title : !grid.title.empty() ? grid.title : "volume map";
  scale.unit = !color.unit.empty() ? color.unit : grid.unit;
  scale.map = color.map.value_or(ColorMap::red_white_blue);
  scale.own_map = color.own_map;
  scale.range = *color.range;
  scale.missing_color = color.missing.value_or(default_missing_color(scale.map));
  return std::make_shared<VolumePaint>(VolumePaint{std::move(grid), std::move(scale), request.volume_offset});
}

/// Warns of atoms that were left out: a potential has the charges of all atoms with which it was computed.
void warn_of_unseen_charges(Structure& structure) {
  std::size_t count = 0;
  for (const auto& [reason, atoms] : structure.report.charged) count += atoms;
  if (count == 0) return;
  const bool water = structure.report.charged.contains(kExcludedWater);
  structure.report.warnings.emplace_back(fmt::format(
      "{} {} with charges {} left out of the surface ({}); a map computed with them colours it by charges that it does "
      "not show. Compute the map without them{}, or keep them in the surface{}",
      with_thousands(count), count == 1 ? "atom" : "atoms", count == 1 ? "is" : "are",
      reasons_text(structure.report.charged), water ? " (pdb2pqr --drop-water)" : "",
      water ? message(" (@keep-water@)") : ""));
}

/// Returns the extent of a box as text: "x -27.1 to 26.4, y ..., z ...".
std::string extent_text(const Box& box) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    text += fmt::format("{}{} {:.1f} to {:.1f}", axis ? ", " : "", "xyz"[axis], box.low[axis], box.high[axis]);
  return text;
}

/// Returns share_beyond(). Throws InputError if the map covers no part of the surface.
double checked_share_beyond(const VolumePaint& map, const std::string& path, const Molecule& molecule) {
  const double share = share_beyond(map, molecule.objects);
  if (share < 1.0) return share;
  Box atoms;
  for (const Ball& ball : placed_balls(molecule.objects)) atoms.include(ball.center);
  throw InputError(path, 0,
                   "covers {} Å, where no part of the surface lies: {} has its atoms at {} Å; move the "
                   "molecule back or compute the map again",
                   extent_text(map.grid.frame().extent()), molecule.structure.file, extent_text(atoms));
}

/// Returns the numbers for By::accessibility, from the surface of all atoms together.
NumberFile measured_accessibility(const Structure& structure, const SurfaceRequest& surface,
                                  SurfaceComputer& computer) {
  if (surface.kind == SurfaceKind::vdw || surface.probe_radius != kAccessibilityProbe)
    throw RequestError(
        message("@color relative-accessibility@ is defined for a probe of {} Å; leave out @probe@ and @surface vdw@",
                kAccessibilityProbe));
  const auto areas = area_columns(structure, surface_objects(structure, {}, computer), surface.kind);
  return {.path = structure.file, .numbers = relative_accessibility(structure, areas.back().values)};
}

}  // namespace

Structure read_molecule(const MoleculeRequest& request) {
  refuse_trajectory(request.file);
  Structure structure = read_structure(request.file, reading_of(request));
  if (request.color.by == ColorScheme::By::volume) warn_of_unseen_charges(structure);
  if (request.color.uses(ColorScheme::By::plddt))
    if (std::optional<std::string> doubt = doubt_of_confidence(structure))
      structure.report.warnings.emplace_back(*std::move(doubt));
  return structure;
}

std::unique_ptr<StructureFile> open_molecule(const MoleculeRequest& request) {
  refuse_trajectory(request.file);
  return std::make_unique<StructureFile>(request.file, reading_of(request));
}

ColorScheme color_of(const MoleculeRequest& request) {
  ColorScheme color = request.color;
  if (color.uses_file()) color.set_numbers(read_number_file(request.number_file, request.number_column));
  if (!request.map_file.empty()) color.own_map = std::make_shared<ColorRamp>(read_color_ramp(request.map_file));
  color.share_scale();
  if (color.by == ColorScheme::By::volume) color.volume = volume_paint(request, color);
  return color;
}

void require_colors_shared(const Structure& structure, const ColorScheme& color) {
  if (structure.instances.empty()) return;
  const auto require_all_copies = [](const char* option, const Selection& atoms) {
    if (atoms.names_copies())
      throw RequestError(message("{}: copies of one surface look the same; leave @instances@ out",
                                 option_name(fmt::format("{} {}", option, in_quotes(atoms.text())))));
  };
  for (const ColorRule& rule : color.rules) require_all_copies("color", rule.atoms);
  for (const OpacityRule& rule : color.opacities)
    if (rule.atoms) require_all_copies("opacity", *rule.atoms);
  if (color.by == ColorScheme::By::copy)
    throw RequestError(message("@color copy@ needs copies with colours of their own; leave @instances@ out"));
  if (color.by == ColorScheme::By::lipophilicity)
    throw RequestError(
        message("@color lipophilicity@ sums over all atoms, so copies must be made of atoms; leave @instances@ out"));
}

std::vector<bool> patch_atoms(const Selection& patches, const Structure& structure) {
  const std::vector<Atom>& atoms = structure.atoms;
  std::vector<bool> selected = patches.evaluate(structure);
  if (std::ranges::find(selected, true) == selected.end())
    throw RequestError(message("@patches {}@: selects none of the {} atoms of the surface; {}",
                               in_quotes(patches.text()), with_thousands(atoms.size()), patches.why_none(atoms)));
  return selected;
}

Burial burial_of(const MoleculeRequest& request, const Structure& structure, SurfaceComputer& computer) {
  if (!structure.instances.empty())
    throw RequestError(message("areas buried between copies need copies made of atoms; leave @instances@ out"));
  Burial burial;
  burial.groups = request.interface ? interface_groups(structure, *request.interface)
                                    : group_atoms(structure, request.division.groups.value_or(Grouping::chain));
  burial.areas = buried_areas(structure, burial.groups, computer, request.surface.kind);
  return burial;
}

MoleculeBuilder::MoleculeBuilder(const MoleculeRequest& request, const EglContext* context)
    : request_(request), color_(color_of(request)), division_(request.division), computer_(request.surface, context) {
  if (color_.by == ColorScheme::By::component && !division_.groups) division_.components = true;
}

/// Measures the numbers for By::buried, and moves both sides of an interface to where they are visible.
void MoleculeBuilder::measure_burial(Molecule& molecule) {
  Structure& structure = molecule.structure;
  const Burial burial = burial_of(request_, structure, computer_);
  if (color_.by == ColorScheme::By::buried) molecule.color.file = {.path = structure.file, .numbers = burial.areas};
  if (request_.interface) open_book(structure, burial.groups, open_pages(structure, burial.groups, burial.areas));
}

Molecule MoleculeBuilder::build(Structure structure) {
  require_colors_shared(structure, color_);
  Molecule molecule;
  molecule.structure = std::move(structure);
  molecule.color = color_;
  if (color_.by == ColorScheme::By::lipophilicity && division_.groups == Grouping::model)
    throw RequestError(
        message("@color lipophilicity@ sums over the atoms of all models, but @by model@ gives each a surface of its "
                "own; select one model"));
  if (request_.interface || color_.by == ColorScheme::By::buried) measure_burial(molecule);
  if (color_.by == ColorScheme::By::accessibility)
    molecule.color.file = measured_accessibility(molecule.structure, request_.surface, computer_);
  if (color_.by == ColorScheme::By::lipophilicity)
    molecule.color.volume = lipophilicity_paint(molecule.structure, molecule.color);
  // Numbers that the colours need and the molecule lacks are reported before the surfaces are computed.
  if (color_.has_scale()) color_scale(molecule.structure, molecule.color);
  for (const ColorRule& rule : color_.rules)
    if (rule.paint.has_scale()) color_scale(molecule.structure, rule.paint);
  std::vector<bool> hidden;
  if (request_.show) hidden = hidden_atoms(*request_.show, molecule.structure);
  computer_.restart_clock();
  molecule.objects = surface_objects(molecule.structure, division_, computer_);
  for (std::size_t n = 0; n < molecule.objects.size(); ++n) {
    SurfaceObject& object = molecule.objects[n];
    object.coloring = color_object(molecule.structure, object.atom, molecule.color, n);
  }
  if (!hidden.empty()) hide(hidden, molecule.objects);
  if (request_.patches && request_.surface.planes == ClipPlanes::listed) {
    const std::vector<bool> selected = patch_atoms(*request_.patches, molecule.structure);
    for (SurfaceObject& object : molecule.objects) {
      std::vector<bool> chosen;
      for (const std::uint32_t atom : object.atom) chosen.push_back(selected[atom]);
      object.coloring.in_patch = atoms_of_patches(object.surface, std::move(chosen), request_.least_patch);
    }
  }
  if (color_.volume) molecule.beyond_map = checked_share_beyond(*color_.volume, request_.volume_file, molecule);
  most_beyond_map_ = std::max(most_beyond_map_, molecule.beyond_map);
  molecule.device = computer_.device();
  molecule.stages = computer_.stages();
  return molecule;
}

namespace {

/// The number of sampled points of a patch, and the number of them beyond the map.
struct Tally {
  std::size_t points = 0, beyond = 0;
};

/// The measurement of one copy of an object.
class Coverage {
 public:
  Coverage(const VolumePaint& map, const SurfaceObject& object, const RigidMotion& motion)
      : map_(map), object_(object), surface_(object.surface), motion_(motion) {}

  /// True if the whole surface lies in the map, because a closing of balls lies in their convex hull, and a map's grid
  /// is convex.
  bool holds_all() const {
    Box box;
    for (const Ball& ball : surface_.atoms) {
      const double reach = ball.radius + std::abs(map_.offset);
      const glm::dvec3 center = motion_(ball.center);
      box.include(center - reach);
      box.include(center + reach);
    }
    for (int corner = 0; corner < 8; ++corner)
      if (!holds({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                  corner & 4 ? box.high.z : box.low.z}))
        return false;
    return true;
  }

  /// The area with the map's colours, and the part of it where the map has no values, Å².
  struct Areas {
    double shown = 0.0, beyond = 0.0;
  };
  Areas areas() const {
    Areas sum;
    const auto add = [&](const Tally& tally, double area) {
      if (tally.points == 0) return;
      sum.shown += area;
      sum.beyond += area * static_cast<double>(tally.beyond) / static_cast<double>(tally.points);
    };
    for (const ConvexPatch& patch : surface_.convex)
      if (shows(patch.atom)) add(on_sphere(patch), area_of(patch));
    for (const ToroidalPatch& patch : surface_.toroidal)
      if (shows(patch.atom[0]) || shows(patch.atom[1])) add(on_borders(patch), area_of(patch));
    for (const ConcavePatch& patch : surface_.concave) {
      const auto first = surface_.contacts.begin() + patch.first_contact;
      if (std::any_of(first, first + patch.contact_count, [&](std::uint32_t a) { return shows(a); }))
        add(on_borders(patch), area_of(patch));
    }
    return sum;
  }

 private:
  bool shows(std::uint32_t a) const { return object_.coloring.by_volume(a) && object_.coloring.shows(a); }
  bool holds(const glm::dvec3& point) const { return !std::isnan(map_.grid.sample(point)); }

  void count(const glm::dvec3& point, const glm::dvec3& normal, Tally& tally) const {
    ++tally.points;
    tally.beyond += std::isnan(map_.value(motion_(point), motion_.rotation * normal));
  }

  double area_of(const auto& patch) const {
    double area = 0.0;
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f)
      area += surface_.faces[f].area;
    return area;
  }

  /// Counts points on the sphere of a patch; for a patch too small to contain any, points on its borders.
  Tally on_sphere(const ConvexPatch& patch) const {
    constexpr std::size_t kPoints = 100;
    const Ball& ball = surface_.atoms[patch.atom];
    const std::span planes(surface_.planes.data() + patch.first_plane, patch.plane_count);
    Tally tally;
    for (std::size_t n = 0; n < kPoints; ++n) {
      const glm::dvec3 normal = spiral_direction(n, kPoints), point = ball.center + ball.radius * normal;
      if (std::ranges::all_of(planes, [&](const Plane& p) { return glm::dot(p.normal, point) <= p.offset; }))
        count(point, normal, tally);
    }
    return tally.points > 0 ? tally : on_borders(patch);
  }

  Tally on_borders(const auto& patch) const {
    constexpr double kTurn = std::numbers::pi / 8.0;  // radians between points of a border
    Tally tally;
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f)
      for (std::uint32_t l = 0; l < surface_.faces[f].loop_count; ++l) {
        const Loop& loop = surface_.loops[surface_.faces[f].first_loop + l];
        for (std::uint32_t h = 0; h < loop.half_border_count; ++h) {
          const Border& border = surface_.borders[surface_.half_borders[loop.first_half_border + h] / 2];
          const int points = 1 + static_cast<int>(border.sweep / kTurn);
          for (int n = 0; n < points; ++n) {
            const double turn = border.sweep * (n + 0.5) / points;
            const glm::dvec3 point =
                border.center + border.radius * (std::cos(turn) * border.start +
                                                 std::sin(turn) * glm::cross(border.axis, border.start));
            count(point, normal_of(patch, point), tally);
          }
        }
      }
    return tally;
  }

  glm::dvec3 normal_of(const ConvexPatch& patch, const glm::dvec3& point) const {
    return glm::normalize(point - surface_.atoms[patch.atom].center);
  }
  glm::dvec3 normal_of(const ConcavePatch& patch, const glm::dvec3& point) const {
    return glm::normalize(patch.center - point);
  }
  glm::dvec3 normal_of(const ToroidalPatch& patch, const glm::dvec3& point) const {
    const glm::dvec3 from = point - patch.center;
    const glm::dvec3 probe =
        patch.center + patch.radius * glm::normalize(from - patch.axis * glm::dot(patch.axis, from));
    return glm::normalize(probe - point);
  }

  const VolumePaint& map_;
  const SurfaceObject& object_;
  const Surface& surface_;
  const RigidMotion& motion_;
};

}  // namespace

double share_beyond(const VolumePaint& map, std::span<const SurfaceObject> objects) {
  const auto holds = [&](const SurfaceObject& object) {
    return std::ranges::all_of(object.copies,
                               [&](const RigidMotion& copy) { return Coverage(map, object, copy).holds_all(); });
  };
  if (std::ranges::all_of(objects, holds)) return 0.0;
  double shown = 0.0, beyond = 0.0;
  for (const SurfaceObject& object : objects)
    for (const RigidMotion& copy : object.copies) {
      const Coverage::Areas areas = Coverage(map, object, copy).areas();
      shown += areas.shown;
      beyond += areas.beyond;
    }
  return shown > 0.0 ? beyond / shown : 0.0;
}

namespace {

void check(const MoleculeRequest& request) {
  if (!request.reading.selection)
    throw RequestError(message("@context@ needs @select@: the atoms whose area is measured in the presence of others"));
  if (request.file == "-")
    throw RequestError(message("@context@ reads the file twice; standard input can be read only once"));
  if (!request.reading.assembly.empty()) throw RequestError(message("@context@ and @assembly@ cannot be combined"));
}

}  // namespace

MoleculeRequest with_context(const MoleculeRequest& request, const Selection& context) {
  check(request);
  MoleculeRequest together = request;
  together.reading.selection = either(*request.reading.selection, context);
  return together;
}

ContextAreas context_areas(const MoleculeRequest& request, const Structure& structure, const Molecule& molecule,
                           const std::vector<AreaColumn>& alone, SurfaceComputer& computer) {
  const std::vector<SurfaceObject> objects =
      surface_objects(structure, {.groups = {}, .components = false, .cavities = request.division.cavities}, computer);
  const std::vector<AreaColumn> all = area_columns(structure, objects, request.surface.kind);

  std::unordered_map<std::uint32_t, std::size_t> row;  // row by place in the file
  for (std::size_t a = 0; a < structure.atoms.size(); ++a) row[structure.atoms[a].index] = a;
  ContextAreas result;
  result.atoms = structure.atoms.size() - molecule.structure.atoms.size();
  for (std::size_t c = 0; c < alone.size(); ++c) {
    AreaColumn in_context{alone[c].name + "_in_context", {}, 0.0};
    AreaColumn buried{alone[c].name + "_buried", {}, 0.0};
    for (std::size_t a = 0; a < molecule.structure.atoms.size(); ++a) {
      in_context.values.push_back(all[c].values[row.at(molecule.structure.atoms[a].index)]);
      buried.values.push_back(alone[c].values[a] - in_context.values.back());
      in_context.total += in_context.values.back();
      buried.total += buried.values.back();
    }
    result.columns.push_back(std::move(in_context));
    result.columns.push_back(std::move(buried));
  }
  return result;
}

}  // namespace meniscus
