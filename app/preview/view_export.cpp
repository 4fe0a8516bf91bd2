// SPDX-License-Identifier: BSD-3-Clause
// Exports a view on a separate thread, which reports its progress and can be cancelled.
#include "app/preview/view_export.h"

#include <new>

#include "app/preview/command_json.h"
#include "core/queries/copies.h"
#include "core/render/picture_file.h"
#include "core/surface/compute_surface.h"
#include "exporters/blender/mns_file.h"
#include "exporters/blender/surface_file.h"
#include "exporters/mesh_files/writers.h"
#include "exporters/povray/povray_scene.h"

namespace meniscus {
namespace {

/// An exception that ends an export that was cancelled.
struct ExportCancelled {};

}  // namespace

struct ExportJob::Shared {
  using Clock = std::chrono::steady_clock;

  const std::string path;
  std::mutex mutex{};  // guards all members below
  std::condition_variable ended_now{};
  bool cancelled = false, ended = false;
  std::string stage{"begin"};
  double share = 0.0;
  nlohmann::json reply{};
  std::exception_ptr failure{};
  Clock::time_point begin = Clock::now(), end{};

  void watch(const char* at, double how_far) {
    const std::scoped_lock lock(mutex);
    if (cancelled) throw ExportCancelled();
    stage = at;
    share = how_far;
  }

  void finish(nlohmann::json made, std::exception_ptr thrown) {
    const std::scoped_lock lock(mutex);
    reply = std::move(made);
    failure = std::move(thrown);
    ended = true;
    end = Clock::now();
    ended_now.notify_all();
  }
};

ExportJob::ExportJob(std::string path, Work work) : shared_(new Shared{std::move(path)}) {
  thread_ = std::thread([shared = shared_, work = std::move(work)] {
    nlohmann::json reply;
    std::exception_ptr failure;
    try {
      reply = work([&shared](const char* stage, double share) { shared->watch(stage, share); });
    } catch (...) {
      failure = std::current_exception();
    }
    shared->finish(std::move(reply), std::move(failure));
  });
}

ExportJob::~ExportJob() {
  cancel();
  thread_.join();
}

void ExportJob::cancel() {
  const std::scoped_lock lock(shared_->mutex);
  shared_->cancelled = true;
}

bool ExportJob::running() const {
  const std::scoped_lock lock(shared_->mutex);
  return !shared_->ended;
}

bool ExportJob::done() const {
  const std::scoped_lock lock(shared_->mutex);
  return shared_->ended && !shared_->failure;
}

nlohmann::json ExportJob::result() {
  std::unique_lock lock(shared_->mutex);
  shared_->ended_now.wait(lock, [&] { return shared_->ended; });
  if (!shared_->failure) return shared_->reply;
  try {
    std::rethrow_exception(shared_->failure);
  } catch (const ExportCancelled&) {
    throw RequestError(shared_->path + " was cancelled; nothing was written");
  } catch (const GpuError& error) {
    throw RequestError(std::string("export: ") + error.what());
  }
}

nlohmann::json ExportJob::state() {
  nlohmann::json state{{"path", shared_->path}};
  if (running()) {
    const std::scoped_lock lock(shared_->mutex);
    state.update({{"running", true}, {"stage", shared_->stage}, {"share", shared_->share}});
  } else {
    try {
      state.update(result());
    } catch (const Error& error) {
      state["error"] = escaped(error.what());
    } catch (const std::bad_alloc&) {
      state["error"] = "not enough memory";
    }
    state["running"] = false;
  }
  const auto end = state["running"].get<bool>() ? Shared::Clock::now() : shared_->end;
  state["seconds"] = std::chrono::duration<double>(end - shared_->begin).count();
  return state;
}

namespace {

/// Returns the complete surfaces, one for each group of copied atoms, and the name of the device that computed them.
std::pair<std::vector<SurfaceObject>, std::string> complete_surfaces(const ExportedView& view,
                                                                     const ExportWatch& watch) {
  SurfaceRequest request;
  request.probe_radius = view.figure.rolling_radius();  // the balls are grown already
  request.cpu = true;
  SurfaceComputer computer(request);
  computer.before_stages([&watch] { watch("surface", 0.0); });
  std::vector<SurfaceObject> objects;
  const auto add = [&](std::span<const Ball> balls) -> SurfaceObject& {
    SurfaceObject& object = objects.emplace_back();
    object.name = "surface";
    object.surface = computer.compute(balls);
    require_closed(object.surface);
    return object;
  };
  for (const Instances& group : view.structure.instances) {
    std::vector<Ball> balls;
    for (const std::uint32_t atom : group.atoms) balls.push_back(view.balls[atom]);
    SurfaceObject& object = add(balls);
    object.coloring = coloring_of(view.coloring, group.atoms);
    object.atom = group.atoms;
    object.copies = group.motions;
  }
  if (objects.empty()) {
    SurfaceObject& object = add(view.balls);
    object.coloring = view.coloring;
    object.atom = view.atoms;
  }
  return {std::move(objects), computer.device()};
}

}  // namespace

void export_picture(const ExportedView& view, const MakePictureDevice& make_device, const ExportTarget& target,
                    const ExportWatch& watch) {
  check_image_path(target.path);
  check_output(target.path, target.existing);  // before the work begins, so that it is not done in vain
  const PreviewFigure& figure = view.figure;
  std::optional<glm::vec3> background = figure.shown_background();
  if (view.transparent) background.reset();
  std::optional<Legend> legend;
  if (figure.legend.within && !view.colors.empty())
    legend.emplace(view.colors, view.size, legend_style(figure.legend.style, figure.annotations.letters));
  Figure whole;
  whole.molecule.objects = complete_surfaces(view, watch).first;
  if (view.extras) whole.extras = *view.extras;
  RenderSettings settings;
  settings.size = legend ? legend->molecule_size() : view.size;
  const Strips strips = strips_for(strip_contents(view.annotations), view.annotations.letters, settings.size);
  settings.size.y -= strips.top + strips.bottom;
  settings.samples = view.samples;
  settings.adaptive = Unevenness::pays_off(view.size);
  settings.look = look_of(figure.look, view.size, background, figure.hues(), figure.molecule.patches.has_value());
  settings.progress = [&watch](double share) { watch("picture", share); };
  SurfaceRequest on_cpu;
  on_cpu.cpu = true;
  const std::unique_ptr<PictureDevice> device = make_device ? make_device() : std::make_unique<PictureDevice>(on_cpu);
  ImageSettings settings_of_file{background, target.existing, figure.look.has_linear_alpha()};
  settings_of_file.scene = view.scene;
  settings_of_file.dots_per_inch = figure.picture.dots_per_inch;
  PictureFile picture(target.path, {view.annotations, legend, strips}, figure.camera, settings_of_file, settings);
  draw(device->renderer(), std::move(whole), figure.figure, figure.camera, settings);
  watch("writing", 0.0);
  picture.commit();
}

std::string export_povray(const ExportedView& view, const ExportTarget& target, const std::filesystem::path& archive,
                          const ExportWatch& watch) {
  if (!archive.empty()) check_output(archive, target.existing);
  const FigureRequest& figure = view.figure.figure;
  if (figure.hides_surface || !figure.objects.empty())
    throw RequestError(
        "export: a POV-Ray scene shows the molecule's surface and sticks, balls, spheres and tubes of its "
        "colours; remove the other objects, or write a picture");
  povray::SceneOptions options;
  options.width = view.size.x;
  options.height = view.size.y;
  options.background = view.figure.shown_background();
  options.existing = target.existing;
  options.shadows = view.figure.look.shadows.value_or(0.0f);
  options.shadow_softness = look_of(view.figure.look, view.size, std::nullopt, Hues::free).shadow_softness;
  options.colors = view.colors;
  std::vector<povray::SceneObject> companions;
  if (view.extras) {
    options.shapes = &view.extras->shapes;
    for (const FigureObject& object : view.extras->objects)
      if (!object.shapes.empty()) companions.emplace_back().shapes = &object.shapes;
  }
  options.objects = companions;
  options.film = figure.thickens;
  options.cut.style = figure.cap;
  const std::vector<SurfaceObject> surfaces = complete_surfaces(view, watch).first;
  options.cut.planes =
      surface_planes(figure, view.extras ? view.extras->cut_atoms : CutAtoms(), view.figure.camera, surfaces);
  watch("writing", 0.0);
  const povray::SceneReport scene = write_scene(surfaces, view.figure.camera, options, target.path);
  if (archive.empty()) return scene.command;
  ZipArchive zip;
  for (const std::filesystem::path& file : scene.files)
    zip.add_deflated((target.path.filename() / file.filename()).generic_string(), read_file_bytes(file.string()));
  OutputFile output(archive, target.existing);
  output.write(zip.finish());
  output.commit();
  return scene.command;
}

void export_blender(const ExportedView& view, const ExportTarget& target, const ExportWatch& watch) {
  check_output(target.path, target.existing);
  const auto [surfaces, device] = complete_surfaces(view, watch);
  watch("mesh", 0.0);
  std::vector<TriangleMesh> meshes = mesh_objects(surfaces, blender::kTolerance);
  std::vector<blender::MeshedObject> objects;
  for (std::size_t n = 0; n < surfaces.size(); ++n)
    objects.push_back(
        {surfaces[n], std::move(meshes[n]), blender::atom_attributes(view.structure, surfaces[n].atom), {}});
  watch("writing", 0.0);
  const blender::Provenance provenance{std::filesystem::path(view.structure.file).filename().string(),
                                       view.structure.radii_set, device, view.colors};
  write_objects(target.path.string(), target.existing, objects,
                blender::Shot{view.figure.camera, view.size.x, view.size.y, view.figure.look.shadows.value_or(0.0f),
                              look_of(view.figure.look, view.size, std::nullopt, Hues::free).shadow_softness},
                provenance);
}

std::filesystem::path export_path(const std::filesystem::path& folder, const std::string& name) {
  if (!is_plain_name(name)) {
    throw RequestError(
        "export: \"path\" is {}; it must be a plain file name of letters, digits, '.', '_' and '-', such as view.png",
        in_quotes(name));
  }
  return folder / name;
}

}  // namespace meniscus
