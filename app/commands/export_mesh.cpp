// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export mesh`: writes the closed mesh in any format; `meniscus export ply` is its older form.
#include <iostream>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/commands/figure_meshes.h"
#include "app/options/named_files.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/render/look.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus {
namespace {

/// Returns the format of the output. Throws UsageError if neither its name nor an option decides.
const MeshFormat& format_of(const Scene& scene) {
  const std::string& word = scene.mesh.format;
  if (const std::filesystem::path path(scene.output); word == "usdc" || (word.empty() && path.extension() == ".usdc")) {
    const std::string text = std::filesystem::path(path).replace_extension(".usda").string();
    throw UsageError("{}: only USD as text is written; write that, then: usdcat {} -o {}", in_quotes(scene.output),
                     shell_word(text), shell_word(scene.output));
  }
  const MeshFormat* const found = word.empty() ? mesh_format_of_path(scene.output) : mesh_format(word);
  if (found) return *found;
  if (!word.empty()) throw UsageError("--format: {} is not one of {}", in_quotes(word), mesh_format_words());
  throw UsageError("{} does not end like a mesh file; choose its format by --format: {}", in_quotes(scene.output),
                   mesh_format_words());
}

std::string scale_sentence(const MeshFormat& format, double scale) {
  if (format.word == "dms") return "lengths are Å";
  return fmt::format("1 Å is {:g} {}", scale, format.unit.empty() ? "in the file" : format.unit);
}

void refuse_what_does_not_fit(const MeshFormat& format, const Figure& figure, const MeshFineness& fineness) {
  const Molecule& molecule = figure.molecule;
  const bool hides = std::ranges::any_of(molecule.objects, [](const auto& o) { return o.coloring.hides_some(); });
  refuse_even_parts(fineness, hides, false);
  if (!format.solid) return;
  const bool whole = std::ranges::all_of(molecule.objects, &SurfaceObject::whole);
  if (molecule.objects.size() > 1 || !whole || hides || !figure.extras.shapes.empty())
    throw RequestError("{} holds one complete closed surface; leave --by, --cavities, --show and shapes out",
                       format.word);
}

void log_report(const SceneCommand& command, const MeshFormat& format, const MeshFileMaker& maker,
                const MeshFineness& fineness) {
  log_line(command,
           fmt::format("{} triangles{} {}; {}", with_thousands(maker.triangle_count()),
                       maker.further_places() > 0
                           ? fmt::format(", shared with {} more copies,", with_thousands(maker.further_places()))
                           : "",
                       fineness_words(command.scene.mesh, fineness), scale_sentence(format, command.scene.mesh.scale)));
  if (maker.joined_edges() + maker.flipped_edges() > 0)
    log_line(command,
             fmt::format("welded: {} edges shorter than {} Å, {}{} triangles without area",
                         with_thousands(maker.joined_edges()), kFileStep,
                         maker.fins() > 0 ? fmt::format("{} fins no thicker, ", with_thousands(maker.fins())) : "",
                         with_thousands(maker.flipped_edges())));
  if (maker.flat_triangles() > 0)
    log_line(command,
             fmt::format("warning: {} triangles have no area when rounded to thousandths of an Å, and could not be "
                         "welded; try another --tolerance",
                         with_thousands(maker.flat_triangles())));
}

// Writes objects to separate files, all or none of them.
void write_numbered(const MeshFormat& format, const NumberedPath& path, Existing existing, MeshFile whole) {
  std::vector<FileObject> objects = std::exchange(whole.objects, {});
  const std::filesystem::path folder = std::filesystem::path(path.at(1)).parent_path();
  OutputFolder files(folder.empty() ? "." : folder, existing);
  std::vector<std::string> names;
  for (FileObject& object : objects) {
    names.push_back(path.at(names.size() + 1));
    whole.objects.clear();
    whole.objects.push_back(std::move(object));
    format.write(files.file(std::filesystem::path(names.back()).filename().string()), whole);
  }
  files.commit();
  for (const std::string& name : names) std::cout << escaped(name) << "\n";
}

/// Returns the microfacet material whose highlight is as wide as that of the picture's Phong material (B. Walter et
/// al., Proc. EGSR 2007, 195), and as strong at normal incidence (Fresnel).
FileMaterial material_of(const Scene& scene) {
  constexpr float kMost = 0.95f;
  const Material material = look_of(scene.look, scene.picture.size(), std::nullopt, Hues::free).material;
  const float amplitude = std::min(std::sqrt(material.specular), kMost);
  return {std::sqrt(std::sqrt(2.0f / (material.shininess + 2.0f))), (1.0f + amplitude) / (1.0f - amplitude)};
}

/// Makes the mesh of one figure.
MeshFile mesh_of(const SceneCommand& command, const MeshFormat& format, FigureFrame frame, bool is_logged) {
  const Scene& scene = command.scene;
  Molecule& molecule = frame.figure.molecule;
  const ColoredShapes& extras = frame.figure.extras.shapes;
  std::vector<std::string> names;
  if (format.numbers) names = parse_vertex_numbers(scene.mesh.attributes);
  const MeshFineness fineness = fineness_of(scene.mesh, scene.mesh.even, scene.mesh.density, scene.picture.size(),
                                            frame.camera, frame.figure.balls());
  refuse_what_does_not_fit(format, frame.figure, fineness);
  if (is_logged)
    warn_of_many(command, expected_triangles(molecule.objects, fineness,
                                             format.places ? CopiesOfMesh::shared : CopiesOfMesh::own));
  const std::vector<Atom> atoms = shown_atoms(molecule.structure);
  const std::vector<double> buried =
      buried_by_chains(scene.molecule, molecule.structure, names, scene.mesh.attributes == "all");
  MeshFileMaker maker({fineness, names, scene.mesh.scale, atoms, buried, format.solid, frame.velocities, format.places,
                       material_of(scene)},
                      about_line(kind_word(scene.molecule.surface.kind), scene.mesh.scale, fineness));
  for (SurfaceObject& object : molecule.objects) maker.add(std::exchange(object, {}));
  if (!extras.empty()) maker.add(shape_object(atoms, extras, fineness.tolerance));
  if (is_logged) log_report(command, format, maker, fineness);
  return maker.take();
}

/// A run in one file, in the order of its frames.
struct OneFile {
  std::vector<MeshFile> frames;
  RunTimes times;
};

// Checks the output before anything is computed.
void check_one_file(const MeshFormat& format, const Scene& scene) {
  if (!format.write_run)
    throw UsageError("-o {}: each frame needs a file of its own; put # where its number goes, as in {}",
                     in_quotes(scene.output), in_quotes(numbered_name(scene.output)));
  if (!scene.frames.only.empty())
    throw UsageError("--only: one file holds all frames; put # where their numbers go, as in {}",
                     in_quotes(numbered_name(scene.output)));
}

void export_to_mesh(const SceneCommand& requested) {
  const MeshFormat& format = format_of(requested.scene);
  if (format.numbers) parse_vertex_numbers(requested.scene.mesh.attributes);
  const auto numbered = NumberedPath::parse(requested.scene.output);
  const bool one_file = requested.scene.frames.is_requested() && !numbered;
  if (one_file) check_one_file(format, requested.scene);
  const auto is_partial = [](const OpacityRule& rule) { return rule.opacity > 0.0f && rule.opacity < 1.0f; };
  if (!format.opacity && std::ranges::any_of(requested.scene.molecule.color.opacities, is_partial))
    log_line(requested, fmt::format("note: --opacity: {} files store no opacity, so transparent parts are opaque there",
                                    format.title));
  SceneCommand bare = requested;
  bare.scene.figure.bare = true;  // a mesh contains only the surface
  FigureRun run(bare, one_file ? Velocities::central : Velocities::none);
  run.aim(requested.scene.picture, false);
  const SceneCommand& command = run.command();
  OneFile whole{{}, {{}, command.scene.film.frames_per_second}};
  const auto make = [&](FigureFrame frame) -> FinishFrame {
    const std::uint64_t number = frame.number, place = frame.place + 1;
    MeshFile mesh = mesh_of(command, format, std::move(frame), !run.is_run());
    if (numbered && !run.is_run()) {
      write_numbered(format, *numbered, command.existing(), std::move(mesh));
      return [] { return MadeFrame{}; };
    }
    if (one_file)
      return [&whole, place, mesh = std::make_shared<MeshFile>(std::move(mesh))] {
        whole.frames.push_back(std::move(*mesh));
        whole.times.places.push_back(place);
        return MadeFrame{};
      };
    const std::string path = numbered ? numbered->at(number) : command.scene.output;
    write_mesh_file(format, path, command.existing(), std::move(mesh));
    return [path] {
      std::cout << escaped(path) << "\n";
      return MadeFrame{{path}};
    };
  };
  run.make({kMeshBytesPerAtom}, [&]() -> FigureRun::Sink { return make; });
  if (!one_file) return;
  write_mesh_run(format, command.scene.output, command.existing(), whole.frames, whole.times);
  if (std::ranges::any_of(whole.frames.front().objects, [](const FileObject& o) { return o.velocities.empty(); }))
    log_line(command, "note: no velocities are written: they need the same atoms in all frames, without copies");
  std::cout << escaped(command.scene.output) << "\n";
}

bool is_usd(const Scene& scene) {
  return scene.mesh.format.starts_with("usd") || scene.output.ends_with(".usd") || scene.output.ends_with(".usda") ||
         scene.output.ends_with(".usdz");
}

TakenProperties mesh_export_properties() {
  return figure_properties().with(
      {"-Figure", "surface.opacity", "-figure.object", "-figure.hydrogen_bonds", "-figure.distance",
       "-camera.look_into", "-camera.path", "-camera.turntable", "-camera.follow", "-camera.save", "look.preset",
       "look.specular", "look.shininess", "frames.fps", "Mesh"},
      {{{"frames.fps"},
        [](const GivenScene& given) { return given.scene.frames.is_requested() && is_usd(given.scene); },
        "of meshes USD alone has times; name a file of a run, such as -o a.usda"},
       {{"look.preset", "look.specular", "look.shininess"},
        [](const GivenScene& given) {
          return is_usd(given.scene) || given.scene.mesh.format == "glb" || given.scene.output.ends_with(".glb");
        },
        "of meshes USD and GLB alone have materials; name a file of one of them, such as -o a.usda"},
       {{"image.size", "image.width", "image.height", "camera.projection", "camera.view", "camera.turn",
         "camera.zoom_to", "camera.from"},
        [](const GivenScene& given) {
          return given.any({"mesh.tolerance_pixels"}) ||
                 (given.any({"camera.from"}) && !given.any({"mesh.tolerance", "mesh.density"}));
        },
        "a mesh has no picture; they matter for --tolerance-pixels alone"}});
}

void declare(CLI::App& command, const std::string& format) {
  auto declared = std::make_shared<DeclaredCommand<>>(command, mesh_export_properties());
  declared->options.describe_output(
      format.empty() ? "File to write; its ending chooses the format; for frames with # for the number"
                     : "PLY file to write");
  declared->options.option("mesh.format")
      ->description(help_of(property_of("mesh.format")) + ": " + mesh_format_words());
  command.callback([declared, format] {
    SceneOptions& options = declared->options;
    Scene& scene = declared->state.scene;
    options.take();
    if (scene.mesh.format.empty()) scene.mesh.format = format;
    if (!has_fineness(options) && !scene.picture.camera_file.empty()) scene.mesh.tolerance_pixels = kPixelsOfACamera;
    run_and_save_scene(declared->state, [&] { export_to_mesh(declared->state); });
  });
}

void declare_mesh(CLI::App& command) {
  describe(
      command,
      "  meniscus export mesh 1tii.pdb -o 1tii.glb --color chain --density 2\n"
      "  meniscus export mesh 1tii.pdb -o 1tii.3mf --even --tolerance 0.1\n"
      "  meniscus export mesh 1tii.pdb -o 1tii.vtp --attributes mean_curvature,hydrophobicity\n"
      "  meniscus export mesh 1tii.pdb -o part_#.stl --by component\n"
      "  meniscus export mesh adk.psf adk.dcd --frames 0-90 -o adk_###.ply   one file per frame\n"
      "  meniscus export mesh adk.psf adk.dcd --frames 0-90 -o adk.usda      one file that moves",
      "Each part of --by is an object of its own in 3MF, OBJ, GLB and USD; with a # in the name of the output it is a "
      "file "
      "of\nits own, in any format. The default tolerance is half a pixel of --camera; without a camera it is 0.01 Å.");
  declare(command, "");
}

void declare_ply(CLI::App& command) {
  describe(command,
           "  meniscus export ply 1tii.pdb -o 1tii.ply\n"
           "  meniscus export ply 1tii.pdb -o fine.ply --tolerance 0.002 --color chain");
  declare(command, "ply");
}

const ExportCommand kMesh("mesh", "Write a closed triangle mesh: STL, 3MF, OBJ, OFF, GLB, VTP, TetGen, DMS, PLY or USD",
                          declare_mesh);
const ExportCommand kPly("ply", "Write a closed triangle mesh as binary PLY: the same as export mesh --format ply",
                         declare_ply);

}  // namespace
}  // namespace meniscus
