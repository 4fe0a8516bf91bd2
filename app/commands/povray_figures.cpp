// SPDX-License-Identifier: BSD-3-Clause
// Writes figures and films of scenes for POV-Ray.
#include "app/commands/povray_figures.h"

#include <iostream>

#include <fmt/ranges.h>

#include "app/commands/storyboard.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/queries/copies.h"
#include "exporters/povray/povray_scene.h"

namespace meniscus {

TakenProperties povray_properties() {
  return figure_properties().with({"look.shadows", "look.shadow_softness", "look.material", "look.comments"});
}

povray::SceneOptions povray_options(const Scene& scene, Existing existing) {
  using enum povray::Material;
  povray::SceneOptions options;
  options.width = scene.picture.width;
  options.height = scene.picture.height;
  options.material = meaning_of(scene.renderer.material, "povray.material", {opaque, ghost, glass, wax, flat});
  options.shadows = scene.look.shadows.value_or(0.0f);
  options.shadow_softness = look_of(scene.look, glm::ivec2(1), std::nullopt, Hues::free).shadow_softness;
  options.existing = existing;
  options.cut.style = scene.figure.cap;
  options.film = scene.figure.thickens;
  return options;
}

void check_povray(const Scene& scene) {
  if (scene.figure.thickens && scene.molecule.volume_offset != 0.0)
    throw UsageError("--map-offset: scenes for POV-Ray cannot combine it with --film-opacity; leave one of them out");
}

std::vector<povray::SceneObject> povray_objects(const Figure& figure, const FigureRequest& request,
                                                const Camera& camera, bool keeps_empty) {
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  std::vector<povray::SceneObject> more;
  for (std::size_t n = 0; n < figure.extras.objects.size(); ++n) {
    const FigureObject& object = figure.extras.objects[n];
    if (!keeps_empty && !object.surface && object.shapes.empty()) continue;
    const PictureObject shown = picture_object(object, request_of(request.objects, n), camera, balls);
    povray::SceneObject& made = more.emplace_back();
    if (object.surface)
      made.surface = &*object.surface;
    else
      made.shapes = &object.shapes;
    made.cut = {shown.clip, shown.cap};
    made.film = shown.thickens;
    made.material = shown.material;
  }
  return more;
}

povray::SurfaceCut povray_cut(const Figure& figure, const FigureRequest& request, const Camera& camera) {
  return {surface_planes(request, figure.extras.cut_atoms, camera, figure.molecule.objects), request.cap};
}

std::vector<std::string> comment_names(const Scene& scene, const Structure& structure) {
  std::vector<std::string> names;
  if (!scene.renderer.comments) return names;
  for (const Atom& atom : shown_atoms(structure)) {
    if (atom.residue_name.empty()) {  // numbered like --csv and selections
      names.push_back(fmt::format("{} index {}", atom.name, atom.index));
      names.back().erase(0, names.back().find_first_not_of(' '));
      continue;
    }
    const std::string code = atom.insertion_code == ' ' ? std::string() : std::string(1, atom.insertion_code);
    names.push_back(fmt::format("{} {} {}{} {}", atom.chain, atom.residue_name, atom.residue_number, code, atom.name));
    names.back().erase(0, names.back().find_first_not_of(' '));
  }
  return names;
}

namespace {

std::shared_ptr<const VolumePaint> map_of(FilmScene& scene) {
  if (scene.run.is_run()) return color_of(scene.run.scene().molecule).volume;
  for (const SurfaceObject& object : scene.run.figure().molecule.objects)
    if (object.coloring.volume) return object.coloring.volume;
  return {};
}

Box extent_of(FilmScene& scene) {
  if (scene.run.is_run()) return scene.run.framing().extent.shown;
  Box box;
  for (const Ball& ball : scene.run.figure().balls()) {
    box.include(ball.center - ball.radius);
    box.include(ball.center + ball.radius);
  }
  return box;
}

bool sees_through(std::span<const OpacityRule> rules) {
  return std::ranges::any_of(rules, [](const OpacityRule& rule) { return rule.opacity > 0.0f && rule.opacity < 1.0f; });
}

/// Returns the common settings of all frames. Throws UsageError if scenes differ where they must not.
povray::Run shared_by(Storyboard& storyboard) {
  povray::Run all;
  all.surface = false;
  for (std::size_t n = 0; n < storyboard.size(); ++n) {
    FilmScene& scene = storyboard.scene(n);
    const Scene& requested = scene.run.scene();
    check_povray(requested);
    if (scene.run.is_run() && requested.molecule.color.by == ColorScheme::By::lipophilicity) all.maps_change = true;
    if (auto map = map_of(scene)) {
      if (all.map) all.maps_change = true;
      all.map = std::move(map);
    }
    const Box box = extent_of(scene);
    all.extent.include(box.low);
    all.extent.include(box.high);
    all.surface = all.surface || !requested.figure.hides_surface;
    all.caps = all.caps || (!requested.figure.hides_surface && !requested.figure.cuts.empty());
    all.shapes = all.shapes || !requested.figure.representations.empty();
    all.translucent = all.translucent || sees_through(requested.molecule.color.opacities);
    for (const FigureObjectRequest& object : all_requests(requested.figure.objects, scene.run.structure())) {
      all.objects.push_back({!object.shapes, false});
      if (!object.material.empty()) all.materials.push_back(object.material);
      all.translucent = all.translucent || sees_through(object.opacities);
    }
  }
  if (all.maps_change) all.map.reset();
  return all;
}

/// Returns options whose numbers change during transitions, but not in POV-Ray, which has its own light.
std::string changes_left_out(Storyboard& storyboard) {
  std::set<std::string> names;
  const auto look = [&](std::size_t n) {
    FilmScene& scene = storyboard.scene(n);
    return render_settings(scene.run.scene(), *scene.layout).look;
  };
  Look first = look(0);
  for (std::size_t n = 1; n < storyboard.size(); ++n) {
    Look other = look(n);
    for (const LookNumber& number : look_numbers())
      if (number.in && &number.in(first) != &first.shadows && &number.in(first) != &first.shadow_softness &&
          number.in(first) != number.in(other))
        names.insert(std::string(property_of(number.key).option));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<std::string> left_out_of_povray(Storyboard& storyboard) {
  std::vector<std::string> sentences;
  const std::string& material = storyboard.scene(0).run.scene().renderer.material;
  if (storyboard.leaves_writing_out())
    sentences.emplace_back("titles, labels and legends are left out: scenes for POV-Ray hold only the molecule");
  if (storyboard.any([](const Scene& scene) { return scene.image.motion_blur > 1; }))
    sentences.emplace_back("--motion-blur is left out");
  if (storyboard.any([&](const Scene& scene) { return scene.renderer.material != material; }))
    sentences.emplace_back("all scenes have the --material of the first one");
  if (const std::string names = changes_left_out(storyboard); !names.empty())
    sentences.push_back("POV-Ray has its own light, so these differences between the scenes have no effect: " + names);
  return sentences;
}

/// Returns the objects next to the surface in all scenes; objects of scenes other than `figure`'s are empty.
std::vector<povray::SceneObject> objects_of(Storyboard& storyboard, std::size_t scene, const MoleculeShot& shot) {
  std::vector<povray::SceneObject> objects;
  for (std::size_t n = 0; n < storyboard.size(); ++n) {
    if (n == scene) {
      const std::vector<povray::SceneObject> own = povray_objects(shot.figure, shot.scene.figure, shot.camera, true);
      objects.insert(objects.end(), own.begin(), own.end());
      continue;
    }
    const FigureRun& run = storyboard.scene(n).run;
    for (const FigureObjectRequest& object : all_requests(run.scene().figure.objects, run.structure()))
      objects.emplace_back().material = object.material;
  }
  return objects;
}

class PovrayFilm : public FilmMaker {
 public:
  explicit PovrayFilm(Storyboard& storyboard)
      : storyboard_(storyboard),
        sequence_(povray::SequenceScene::Film{}, shared_by(storyboard),
                  povray_options(storyboard.scene(0).run.scene(), storyboard.command().existing()),
                  storyboard.command().scene.output),
        progress_(progress_on_stderr(storyboard.command()), "film", storyboard.pictures()) {}

  void make() {
    const FilmCommand& command = storyboard_.command();
    storyboard_.log_left_out(left_out_of_povray(storyboard_));
    storyboard_.play(*this, nullptr, 0);
    film_.rate = command.scene.film.frames_per_second;
    const povray::SceneReport report = sequence_.write_shared(&film_);
    log_line(command,
             fmt::format("{} pictures, {:.1f} s, of {} that POV-Ray renders", with_thousands(film_.pictures.size()),
                         static_cast<double>(film_.pictures.size()) / film_.rate, with_thousands(frames_)));
    std::cout << escaped(report.command) << "\n";
  }

 private:
  void begin(std::size_t n) override { scene_ = n; }

  void show(const Shot& shot, std::uint64_t, std::uint64_t times) override {
    const std::uint64_t number = write({shot.scene, shot.figure, shot.camera, settings_of(shot)}, scene_);
    for (std::uint64_t n = 0; n < times; ++n) film_.pictures.push_back({number});
    progress_.advance(times);
  }

  void show(Transition& transition, double share) override {
    const std::vector<MoleculeShot> shots = transition.shots(share);
    povray::StoryPicture& picture = film_.pictures.emplace_back();
    picture.first = write(shots.front(), scene_ - 1);
    if (shots.size() > 1) {
      picture.second = write(shots.back(), scene_);
      picture.share = share;
    }
    progress_.advance(1);
  }

  /// Returns the number of the frame. scene: the scene of the shot.
  std::uint64_t write(const MoleculeShot& shot, std::size_t scene) {
    const Look& look = shot.settings.look;
    const FigureRequest& requested = shot.scene.figure;
    // POV-Ray casts the shadows of a scene. Shadows of a preset are left out.
    const float shadows = shot.scene.look.shadows ? look.shadows : 0.0f;
    const std::size_t place = sequence_.add_frame(shot.camera, {look.background, shadows, look.shadow_softness});
    const std::vector<povray::SceneObject> objects = objects_of(storyboard_, scene, shot);
    const std::vector<std::string> names = comment_names(shot.scene, shot.figure.molecule.structure);
    std::span<const SurfaceObject> surface = shot.figure.molecule.objects;
    if (requested.hides_surface) surface = {};
    const povray::SceneReport report =
        sequence_.write_frame(place, {surface, povray_cut(shot.figure, requested, shot.camera),
                                      &shot.figure.extras.shapes, objects, names, requested.thickens});
    if (frames_++ == 0)
      for (const std::string& note : report.notes) log_line(storyboard_.command(), "note: " + note);
    return place + 1;
  }

  Storyboard& storyboard_;
  povray::SequenceScene sequence_;
  povray::Story film_;
  Progress progress_;
  std::size_t scene_ = 0;
  std::uint64_t frames_ = 0;
};

}  // namespace

void write_povray_film(Storyboard& storyboard) { PovrayFilm(storyboard).make(); }

}  // namespace meniscus
