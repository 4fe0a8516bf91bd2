// SPDX-License-Identifier: BSD-3-Clause
// Carries out what the common options say.
#include "app/molecule.h"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/show_only.h"
#include "app/surface_objects.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/trajectory/formats/formats.h"

namespace meniscus {
namespace {

void refuse_trajectory(const std::string& path) {
  const std::string_view format = binary_trajectory_format(path);
  if (format.empty()) return;
  throw InputError(path, 0,
                   fmt::format("is a trajectory ({}) and holds no atoms; give their structure or topology as FILE, and "
                               "this one with --trajectory",
                               format));
}

}  // namespace

Structure read_molecule(const MoleculeOptions& options) {
  refuse_trajectory(options.file);
  if (options.reading.assembly == "list") {
    ReadOptions listing = options.reading;
    listing.assembly.clear();
    listing.list_assemblies = true;
    print_assemblies(read_structure(options.file, listing));
    throw CLI::Success();
  }
  ReadOptions reading = options.reading;
  if (options.division.instances != InstanceMode::none) reading.copy_mode = CopyMode::instances;
  Structure structure = read_structure(options.file, reading);
  say(options, fmt::format("{}: {}", structure.file, structure.report.sentence()));
  say_warnings(options, structure);
  return structure;
}

ColorScheme color_of(const MoleculeOptions& options) {
  ColorScheme color = options.color;
  if (color.by == ColorScheme::By::file) color.file = read_number_file(options.color_file);
  return color;
}

ColorKey key_of(const Molecule& molecule) {
  std::vector<std::string> names;
  for (const SurfaceObject& object : molecule.objects) names.push_back(object.name);
  return color_key(molecule.structure, molecule.color, names);
}

std::string colors_json(const Molecule& molecule) { return colors_json(key_of(molecule)); }

std::string colors_json(const ColorKey& key) {
  using Json = nlohmann::ordered_json;
  const auto triple = [](const glm::vec3& c) { return Json{c.x, c.y, c.z}; };
  Json json{{"title", key.title}};
  if (key.scale) {
    const ColorScale& scale = *key.scale;
    json = {{"title", scale.title}, {"unit", scale.unit},       {"map", map_name(scale.map)},
            {"range", scale.range}, {"missing", scale.missing}, {"missing_color", triple(scale.missing_color)}};
  }
  if (!key.classes.empty()) json["classes"] = Json::array();
  for (const ColorClass& entry : key.classes)
    json["classes"].push_back({{"name", escaped(entry.name)}, {"color", triple(entry.color)}});
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

MoleculeBuilder::MoleculeBuilder(const MoleculeOptions& options, const EglContext* context)
    : options_(options), color_(color_of(options)), division_(options.division), computer_(options.computing, context) {
  if (color_.by == ColorScheme::By::component && !division_.groups) division_.components = true;
}

Molecule MoleculeBuilder::build(Structure structure) {
  if (color_.by == ColorScheme::By::copy && !structure.instances.empty())
    throw RequestError("--color copy needs copies with colours of their own; leave --instances away");
  Molecule molecule;
  molecule.structure = std::move(structure);
  molecule.color = color_;
  // What the options ask for that the molecule has not is said before the surfaces are computed.
  if (color_.has_scale()) color_scale(molecule.structure, color_);
  std::vector<bool> hidden;
  if (options_.show) hidden = hidden_atoms(*options_.show, molecule.structure);
  computer_.restart_clock();
  molecule.objects = surface_objects(molecule.structure, division_, computer_);
  for (std::size_t n = 0; n < molecule.objects.size(); ++n) {
    SurfaceObject& object = molecule.objects[n];
    object.coloring = color_object(molecule.structure, object.atom, molecule.color, n);
  }
  if (!hidden.empty()) hide(hidden, molecule.objects);
  molecule.device = computer_.device();
  molecule.stages = computer_.stages();
  return molecule;
}

Molecule load_molecule(const MoleculeOptions& options) {
  Structure structure = read_molecule(options);
  Molecule molecule = MoleculeBuilder(options).build(std::move(structure));
  say(options, fmt::format("surface on {} in {:.1f} ms", molecule.device, total_ms(molecule.stages)));
  if (const double grown_by = largest_growth(molecule.objects); grown_by > 0)
    say(options,
        fmt::format("spheres that meet in one point were told apart by radii grown by up to {:.2g} Å", grown_by));
  return molecule;
}

}  // namespace meniscus
